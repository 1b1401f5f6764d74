//! The cheaper models as a user runs them: the seeds' scenes shortened, a fed one, and what is refused.

mod util;

use ale_gear::scene::Scene;
use serde_json::Value;
use util::{ISO_SCENE, Scratch, repository};

/// A seed's scene with some words changed.
fn seed(number: &str, changes: &[(&str, &str)]) -> String {
    let path = repository().join(format!("scenes/seeds/{number}.toml"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    changes.iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "{number}: no `{from}`");
        text.replace(from, to)
    })
}

/// Runs a scene; its folder and its summary.
fn run(scene: String) -> (Scratch, Value) {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let summary = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    (scratch, summary)
}

fn headline(summary: &Value, key: &str) -> f64 {
    summary["headline"][key].as_f64().unwrap_or_else(|| panic!("no {key}: {}", summary["headline"]))
}

fn certificate(summary: &Value, key: &str) -> f64 {
    summary["headline"]["certificate"][key].as_f64().unwrap_or_else(|| panic!("no {key}: {}", summary["headline"]))
}

/// Seed 004 without friction: mean normal force T / (r_b cos b_b) = 7094.5 N (validation notes; 1e-4: the settled motion repeats itself to 1e-6), all files, the ledger closes.
#[test]
fn seed_004_has_its_normal_force() {
    let changes = [("friction = 0.05", "friction = 0.0"), ("cycles = 30", "cycles = 4"), ("1.0e-5", "1.0e-6")];
    let (scratch, summary) = run(seed("004", &changes));
    let mean = headline(&summary, "mean_normal_force_n");
    assert!((mean / 7094.5 - 1.0).abs() < 1e-4, "mean normal force {mean} N");
    let open = certificate(&summary, "ledger_residual_over_turnover");
    assert!(open.abs() < 1e-3, "energy open by {open:e}");
    let mut names: Vec<String> = std::fs::read_dir(scratch.path().join("o"))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let all =
        ["energy.csv", "history.csv", "report.html", "report.json.gz", "section.csv", "spectrum.csv", "summary.json"];
    assert_eq!(names, all);
    assert_eq!(scratch.read("o/history.csv").lines().count(), 1 + 4 * 64);
    assert_eq!(scratch.read("o/section.csv").lines().count(), 1 + 4);
    assert!(scratch.read("o/report.html").contains("Phase portrait of the wheel along the line of action"));
}

/// Seed 003: mean total length of the contact lines 62.05 .. 62.08 mm (validation notes), seen in every row.
#[test]
fn seed_003_has_its_contact_lines() {
    let (scratch, summary) = run(seed("003", &[("cycles = 16", "cycles = 2"), ("1.0e-6", "1.0e-3")]));
    let mean = headline(&summary, "mean_contact_line_length_mm");
    assert!((62.05..=62.08).contains(&mean), "{mean} mm");
    let history = scratch.read("o/history.csv");
    let mut lines = history.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == "contact_line_length_mm").unwrap();
    for line in lines {
        let length: f64 = line.split(',').nth(at).unwrap().parse().unwrap();
        assert!((62.045..=62.085).contains(&length), "{length} mm");
    }
}

/// Seed 001 shortened (constant speed, 9 slices): mean normal force within 1 % of 7.378e5 N and output 22.78 Hz (validation notes), and no flank pulls.
#[test]
fn seed_001_has_its_normal_force_and_speed() {
    let text = seed("001", &[("slices = 33", "slices = 9"), ("run = \"ramp\"", "run = \"span\"")]);
    let (before, _) = text.split_once("[motion.ramp]").unwrap();
    let (_, summary) = run(before.replace("model = \"impact\"", "model = \"impact\"\ncycles = 60"));
    let mean = headline(&summary, "mean_normal_force_n");
    assert!((mean / 7.378e5 - 1.0).abs() < 0.01, "mean normal force {mean} N");
    let turning = headline(&summary, "mean_pinion_speed_rpm").abs() / 60.0;
    assert!((turning - 22.78).abs() < 0.01, "output {turning} Hz");
    assert!(headline(&summary, "least_slice_force_n") >= 0.0, "a flank pulls");
}

/// Seed 002: torques balance, so the mean force on the line of action is the load's; 18 coordinates; the gears' turn against nothing is the one frequency at 0.
#[test]
fn seed_002_carries_its_load() {
    let (_, summary) = run(seed("002", &[("cycles = 30", "cycles = 4"), ("1.0e-5", "1.0e-4")]));
    assert_eq!(headline(&summary, "coordinates"), 18.0);
    let (mean, wanted) = (headline(&summary, "mean_normal_force_n"), headline(&summary, "static_normal_force_n"));
    assert!((mean / wanted - 1.0).abs() < 1e-3, "{mean} N, the load asks for {wanted} N");
    let all: Vec<f64> = summary["natural_frequencies_hz"]
        .as_array()
        .or(summary["model"]["natural_frequencies_hz"].as_array())
        .unwrap()
        .iter()
        .map(|f| f.as_f64().unwrap())
        .collect();
    assert!(all.len() == 18 && all[0] < 1.0 && all[1] > 10.0, "{all:?}");
}

/// Without a word on its stiffness a model is fed by the reduced one: run slowly (a thousandth of the resonance and less), its DTE is the STE of the reduced model of the same scene,
/// within 1 % of the mean (the lumped driven gear turns freely at the driver's balancing torque).
#[test]
fn a_fed_model_follows_the_reduced_one() {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let meshed = ISO_SCENE.replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"));
    let fine = "positions_per_cycle = 8\n";
    let (_, of_reduced) = run(meshed.replace("model = \"iso\"\n", fine));
    let stiff = |g: &str| {
        format!(
            "[{g}.bearing]\nstiffness_x_n_per_mm = 1e9\nstiffness_y_n_per_mm = 1e9\nstiffness_z_n_per_mm = 1e9\nstiffness_rz_nmm_per_rad = {}\n",
            if g == "pinion" { "1e14" } else { "1e-6" }
        )
    };
    let scene = meshed.replace("torque_nm = 150.0\n", "torque_nm = 150.0\nspeed_rpm = 20.0\n").replace(
        "model = \"iso\"\n",
        &format!("model = \"lumped8\"\ncycles = 1\n{fine}[motion]\nmethod = \"generalised-alpha\"\nspectral_radius = 0.0\nsteps_per_mesh_cycle = 16\nsteps_per_resonance = 0\nwarm_up_cycles = 4\nmesh_damping_ratio = 0.5\n"),
    ) + &stiff("pinion")
        + &stiff("wheel");
    let (_, of_lumped) = run(scene);
    let (ste, own) = (headline(&of_reduced, "mean_ste_um"), headline(&of_lumped, "mean_ste_um"));
    assert!((own / ste - 1.0).abs() < 0.01, "STE {own} um, {ste} um of the reduced model");
    let dte = headline(&of_lumped, "mean_dte_um");
    assert!((dte / ste - 1.0).abs() < 0.01, "DTE {dte} um, {ste} um of the reduced model");
}

/// Words that mean nothing to a model are refused with their line, and so are tables of another.
#[test]
fn what_means_nothing_is_refused() {
    let cases = [
        ("004", ("[lumped8]\nlaw = \"normal\"\n", "[lumped12]\n"), "[lumped12] belongs to `model = \"lumped12\"`"),
        ("004", ("law = \"normal\"", "low = \"normal\""), "unknown key `low`"),
        ("004", ("half_backlash_um = 100.0", "half_backlash_um = -1.0"), "`half_backlash_um` is -1"),
        (
            "004",
            ("model = \"lumped8\"", "model = \"lumped8\"\nkind = \"static\""),
            "the model \"lumped8\" is one of motion",
        ),
        ("004", ("friction = 0.05", "friction = 0.05\nslices = 20"), "`slices` means nothing to the model \"lumped8\""),
        ("004", ("stiffness_y_n_per_mm = 5.0e5\n", ""), "\"y\" of the pinion is free, but no bearing holds it"),
        (
            "003",
            ("line_sharing", "half_backlash_um = 5.0\nline_sharing"),
            "`half_backlash_um` means nothing to the model \"lumped12\"",
        ),
        (
            "003",
            ("method = \"newmark\"", "method = \"newmark\"\nmesh_damping_ratio = 0.1"),
            "`mesh_damping_ratio` means nothing",
        ),
        ("001", ("slices = 33", "friction = 0.1"), "`friction` means nothing to the model \"impact\""),
        ("002", ("gear_at_mm = 113.8", ""), "a shaft without `gear_at_mm`"),
        ("002", ("[shaft18]", "[impact]\n[shaft18]"), "[impact] belongs to `model = \"impact\"`"),
    ];
    for (number, change, wanted) in cases {
        let scratch = Scratch::new().file("a.toml", seed(number, &[change]));
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        assert_eq!(run.code, Some(2), "{wanted}: {}", run.stderr);
        assert!(run.stderr.contains(wanted) && run.stderr.starts_with("ale-gear: a.toml:"), "{wanted}: {}", run.stderr);
    }
}

/// A scene with every default written out is the same scene.
#[test]
fn written_out_a_scene_is_itself() {
    for number in ["001", "002", "003", "004"] {
        let path = repository().join(format!("scenes/seeds/{number}.toml"));
        let scene = Scene::read(&path).unwrap_or_else(|e| panic!("{e}"));
        let again = Scene::parse(&scene.to_toml(), &path).unwrap_or_else(|e| panic!("{e}\n{}", scene.to_toml()));
        assert_eq!(scene, again, "{number}");
    }
}
