//! Sweeps over a key as a user runs them: seeds' scenes shortened.

use crate::util::{Scratch, chart_rows, column, repository, tiny_at_rest};
use serde_json::Value;

fn seed(number: &str) -> String {
    std::fs::read_to_string(repository().join(format!("scenes/seeds/{number}.toml"))).unwrap()
}

/// Runs a sweep into `o`; its folder and summary.
fn sweep(scene: String, words: &[&str]) -> (Scratch, Value) {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.command(&[&["vary", "a.toml", "--out", "o", "--start", "carry"], words].concat());
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{words:?}: {}", run.stdout);
    let summary = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    (scratch, summary)
}

/// Rows of one way of a file that begins with a column of ways.
fn of_way(csv: &str, way: &str) -> String {
    let (header, rows) = csv.split_once('\n').unwrap();
    let own = rows.lines().filter_map(|l| l.strip_prefix(&format!("{way},"))).map(|l| l.to_owned() + "\n");
    header.strip_prefix("way,").unwrap().to_owned() + "\n" + &own.collect::<String>()
}

/// A mesh without clearance has one answer at every speed, whichever way it is come to, and every disturbance dies out:
/// sections of one point, exponents below zero. Files hold the same bytes for one thread and for two.
#[test]
fn a_linear_mesh_has_one_answer_everywhere() {
    let words = [
        "--vary",
        "operation.speed_rpm=700:1300:3",
        "--ways",
        "up,down,apart",
        "--cycles",
        "6",
        "--lyapunov",
        "20",
        "--set",
        "mesh.half_backlash_um=0",
        "--set",
        "contact.friction=0",
        "--set",
        "motion.steps_per_resonance=0",
    ];
    let (one, summary) = sweep(seed("004"), &[&words[..], &["-j", "1"]].concat());
    let (two, _) = sweep(seed("004"), &[&words[..], &["-j", "2"]].concat());
    for file in ["sweep.csv", "bifurcation.csv", "bifurcation.svg"] {
        assert!(one.read(&format!("o/{file}")) == two.read(&format!("o/{file}")), "{file} changes with the threads");
    }
    let csv = one.read("o/sweep.csv");
    let ways = ["up", "down", "apart"].map(|way| column(&of_way(&csv, way), "peak_to_peak_dte_um"));
    for k in 0..3 {
        for way in &ways[1..] {
            assert!((way[k] / ways[0][k] - 1.0).abs() < 1e-2, "value {k}: {ways:?}");
        }
    }
    let exponents = column(&of_way(&csv, "apart"), "lyapunov_per_s");
    assert!(exponents.iter().all(|l| *l < -1.0), "{exponents:?} 1/s: a disturbance does not die out");
    let headline = &summary["headline"];
    assert_eq!(headline["period_one"], 9, "{headline}");
    assert_eq!(headline["hysteresis"].as_array().map(Vec::len), Some(0), "{headline}");
    assert_eq!(headline["chaotic"].as_array().map(Vec::len), Some(0), "{headline}");
    assert_eq!(one.read("o/bifurcation.csv").lines().count(), 1 + 9 * 6);
}

/// Shafts that turn freely: the turn that nothing holds is no growth. Without clearance every disturbance dies out, at
/// any speed.
#[test]
fn a_free_turn_is_no_chaos() {
    let words = [
        "--vary",
        "operation.speed_rpm=2000:5000:2",
        "--ways",
        "apart",
        "--cycles",
        "4",
        "--settle",
        "60",
        "--lyapunov",
        "100",
        "--set",
        "mesh.half_backlash_um=0",
        "--set",
        "motion.steps_per_resonance=0",
        "--set",
        "shaft18.mass_damping_per_s=400",
    ];
    let (scratch, summary) = sweep(seed("002"), &words);
    let exponents = column(&of_way(&scratch.read("o/sweep.csv"), "apart"), "lyapunov_per_s");
    assert!(exponents.iter().all(|l| *l < 0.0), "{exponents:?} 1/s");
    assert_eq!(summary["headline"]["chaotic"].as_array().map(Vec::len), Some(0));
}

/// Lightly loaded shafts with a backlash of 40 um and a transmission error of 5 um (the diagram of
/// `crates/lumped/tests/lumped_laws/shaft18_backlash.rs`): order at 500 rad/s with an exponent below zero, chaos at 600
/// rad/s with one above.
#[test]
fn backlash_brings_chaos_between_windows() {
    let words = [
        "--vary",
        "operation.speed_rpm=4774.648:5729.578:2",
        "--ways",
        "apart",
        "--cycles",
        "40",
        "--settle",
        "240",
        "--lyapunov",
        "120",
        "--of",
        "compression_um",
        "--set",
        "operation.torque_nm=30.66667",
        "--set",
        "mesh.stiffness_cos_n_per_um=[90.0]",
        "--set",
        "mesh.stiffness_sin_n_per_um=[]",
        "--set",
        "mesh.error_cos_um=[5.0]",
        "--set",
        "mesh.half_backlash_um=20",
        "--set",
        "motion.mesh_damping_ratio=0.03",
        "--set",
        "motion.steps_per_resonance=0",
        "--set",
        "pinion.shaft.supports.0.stiffness_rz_nmm_per_rad=1e7",
        "--set",
        "pinion.shaft.supports.0.damping_rz_nmms_per_rad=2e3",
    ];
    let (scratch, summary) = sweep(seed("002"), &words);
    let csv = of_way(&scratch.read("o/sweep.csv"), "apart");
    let exponents = column(&csv, "lyapunov_per_s");
    let periods = column(&csv, "section_period");
    assert!(exponents[0] < 0.0 && periods[0].is_finite(), "500 rad/s: {exponents:?} 1/s, {periods:?}");
    assert!(exponents[1] > 50.0 && periods[1].is_nan(), "600 rad/s: {exponents:?} 1/s, {periods:?}");
    let chaotic = summary["headline"]["chaotic"].as_array().map(Vec::len);
    assert_eq!(chaotic, Some(1), "{}", summary["headline"]);
}

/// Any numeric key, in the logarithm, and its section once a turn: softer meshes lag more.
#[test]
fn any_key_may_change() {
    let words = [
        "--vary",
        "mesh.stiffness_n_per_um=2500:10000:3:log",
        "--ways",
        "apart",
        "--cycles",
        "2",
        "--once",
        "pinion-turn",
        "--settle",
        "60",
        "--lyapunov",
        "0",
        "--of",
        "mesh_deflection_um",
        "--set",
        "motion.steps_per_resonance=0",
    ];
    let (scratch, _) = sweep(seed("004"), &words);
    let csv = of_way(&scratch.read("o/sweep.csv"), "apart");
    assert_eq!(column(&csv, "mesh.stiffness_n_per_um"), [2500.0, 5000.0, 10000.0]);
    let mean = column(&csv, "mean_mesh_deflection_um");
    assert!(mean[0] > mean[1] && mean[1] > mean[2], "{mean:?} um at twice the stiffness each");
    // Normal force over stiffness, half the backlash beyond the middle.
    assert!(scratch.read("o/bifurcation.csv").lines().count() == 1 + 3 * 2);
}

/// The scene's own sweep over speed is the same analysis.
#[test]
fn a_scene_may_ask_for_its_sweep() {
    let lines = "run = \"sweep\"\nsweep = { from_rpm = 900.0, to_rpm = 1100.0, speeds = 3, ways = [\"up\"] }\nsteps_per_resonance = 0\n";
    let scene = seed("004").replace("[motion]\n", &format!("[motion]\n{lines}")).replace("cycles = 30", "cycles = 4");
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let speeds = column(&of_way(&scratch.read("o/sweep.csv"), "up"), "operation.speed_rpm");
    assert_eq!(speeds, [900.0, 1000.0, 1100.0]);
}

/// Every complaint is made before any work, and nothing is written.
#[test]
fn words_of_a_sweep_are_checked_first() {
    for (scene, words, text) in [
        (seed("004"), ["--vary", "operation.speed=1:2:3"], "--vary operation.speed=1: unknown key `speed`"),
        (seed("004"), ["--vary", "pinion.teeth=30:31.5:3"], "--vary pinion.teeth="),
        (seed("004"), ["--vary", "operation.torque_nm=-1:2:3"], "--vary operation.torque_nm=-1: `torque_nm` is -1"),
        (seed("004"), ["--vary", "operation.torque_nm=3:2:3"], "--vary operation.torque_nm=3:2:3: 3 is not below 2.5"),
        (
            seed("004"),
            ["--vary", "operation.torque_nm=3:2"],
            "--vary operation.torque_nm=3:2: motions carry on from value to value",
        ),
    ] {
        let scratch = Scratch::new().file("a.toml", scene);
        let run = scratch.command(&[&["vary", "a.toml", "--out", "o", "--start", "carry"], &words[..]].concat());
        assert_eq!(run.code, Some(2), "{text}: {}", run.stderr);
        assert!(run.stderr.starts_with(&format!("ale-gear: {text}")), "{text}: {}", run.stderr);
        assert_eq!(scratch.names(), ["a.toml"]);
    }
}

/// A column over a key is a plan: a row a value with the numbers of that plan, a load that no tooth stands among them;
/// words of motions are refused.
#[test]
fn a_column_over_a_key_is_a_plan() {
    let scratch = Scratch::new().file("a.toml", tiny_at_rest(8));
    let key = ["--vary", "operation.torque_nm=100:1e7:2:log"];
    let run = scratch.command(&[&["vary", "a.toml", "--out", "o", "--of", "ste_um"], &key[..]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let rows = chart_rows(&scratch.read("o/cases.csv"));
    let statuses: Vec<&str> = rows.iter().map(|row| row["status"].as_str()).collect();
    assert_eq!(statuses, ["solved", "failed"]);
    assert!(rows[1]["reason"].contains("would bend the teeth"), "{:?}", rows[1]);
    let plan = "scene = \"a.toml\"\n[vary]\nkeys = [\"operation.torque_nm=100:1e7:2:log\"]\n\
                output = [\"mean(ste_um)\", \"peak_to_peak(ste_um)\", \"least(ste_um)\", \"largest(ste_um)\"]\n";
    let scratch = scratch.file("plan.toml", plan);
    assert_eq!(scratch.ale_gear(["vary", "plan.toml", "--out", "p"]).code, Some(0));
    assert_eq!(scratch.read("o/cases.csv"), scratch.read("p/cases.csv"));
    for (words, said) in [
        (&["--of", "ste_um", "--ways", "up"][..], "`--ways` does not go with cases that are run each alone"),
        (&["--of", "ste_um", "--lyapunov", "3"], "`--lyapunov` does not go with cases"),
        (&["--of", "ste_um", "--start", "carry"], "only a motion of one model carries on"),
        (&["--of", "ste_mm"], "`--of ste_mm` is not a column of history.csv\nhint: did you mean \"ste_um\"?"),
    ] {
        let run = scratch.command(&[&["vary", "a.toml", "--out", "q"], &key[..], words].concat());
        assert!(run.code == Some(2) && run.stderr.contains(said), "{words:?}: {}", run.stderr);
        assert!(!scratch.path().join("q").exists());
    }
}

/// A plan that says how its values start is the words of the command line: the same bytes, from a file of its own and from
/// the document itself; words take the place of what the document says.
#[test]
fn a_plan_of_motions_that_carry_on_is_its_words() {
    let words = ["--vary", "operation.speed_rpm=700:1300:3", "--ways", "down", "--cycles", "4", "--settle", "20"];
    let beside = ["--lyapunov", "0", "--set", "contact.friction=0"];
    let (by_words, _) = sweep(seed("004"), &[&words[..], &beside].concat());
    let table = "[vary]\nkeys = [\"operation.speed_rpm=700:1300:3\"]\nstart = \"carry\"\nways = [\"down\"]\n\
                 cycles = 4\nsettle = 20\nlyapunov = 0\n";
    let scratch = Scratch::new()
        .file("a.toml", seed("004"))
        .file("plan.toml", format!("scene = \"a.toml\"\nset = [\"contact.friction=0\"]\n{table}"))
        .file("own.toml", format!("{}\n{table}", seed("004")));
    let runs: [&[&str]; 3] = [
        &["run", "plan.toml", "--out", "p"],
        &["vary", "own.toml", "--out", "q", "--set", "contact.friction=0"],
        &[
            "vary",
            "own.toml",
            "--out",
            "w",
            "--start",
            "carry",
            "--vary",
            "operation.speed_rpm=800,900",
            "--ways",
            "up",
        ],
    ];
    for words in runs {
        let run = scratch.command(words);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{words:?}: {}", run.stdout);
    }
    for file in ["sweep.csv", "bifurcation.csv"] {
        let own = by_words.read(&format!("o/{file}"));
        assert_eq!(scratch.read(&format!("p/{file}")), own, "{file} of a plan");
        assert_eq!(scratch.read(&format!("q/{file}")), own, "{file} of the document");
    }
    assert_eq!(column(&scratch.read("w/sweep.csv"), "operation.speed_rpm"), [800.0, 900.0]);
    let cases = scratch.command(&["vary", "plan.toml", "--cases", "0..1", "--out", "part.csv"]);
    assert_eq!(cases.code, Some(2));
    assert!(cases.stderr.contains("plan.toml:5: values of this plan do not each start alone"), "{}", cases.stderr);
}

/// Branches and basins by a plan are those by words: from a file of its own, and from the document that `[vary]` stands in.
/// Words take the place of what the document says.
#[test]
fn branches_and_basins_of_a_plan_are_those_of_words() {
    let branch = ["--vary", "operation.speed_rpm=900:1000", "--start", "branch"];
    let basin = ["--vary", "start_um=-1:1:2", "--vary", "start_mm_s=-1:1:2", "--start", "basin"];
    let of_branch = "[vary]\nkeys = [\"operation.speed_rpm=900:1000\"]\nstart = \"branch\"\n";
    let of_basin = "[vary]\nkeys = [\"start_um=-1:1:2\", \"start_mm_s=-1:1:2\"]\nstart = \"basin\"\n";
    let set = ["--set", "motion.continuation.longest_step=1", "--set", "motion.continuation.time_points=1"];
    let scratch = Scratch::new()
        .file("a.toml", seed("004"))
        .file("branch.toml", format!("scene = \"a.toml\"\n{of_branch}"))
        .file("basin.toml", format!("scene = \"a.toml\"\n{of_basin}"))
        .file("own.toml", format!("{}\n{of_branch}", seed("004")));
    let run = |words: &[&str], set: &[&str]| {
        let run = scratch.command(&[words, set].concat());
        assert_eq!(run.code, Some(0), "{words:?}: {}", run.stderr);
    };
    run(&[&["vary", "a.toml", "--out", "words"], &branch[..]].concat(), &set);
    run(&["run", "branch.toml", "--out", "plan"], &set);
    run(&["run", "own.toml", "--out", "own"], &set);
    for out in ["plan", "own"] {
        assert!(scratch.read(&format!("{out}/branch.csv")) == scratch.read("words/branch.csv"), "branch of {out}");
    }
    run(&[&["vary", "a.toml", "--out", "basin-words"], &basin[..]].concat(), &[]);
    run(&["run", "basin.toml", "--out", "basin-plan"], &[]);
    run(&[&["vary", "own.toml", "--out", "basin-own"], &basin[..]].concat(), &[]);
    for out in ["basin-plan", "basin-own"] {
        assert!(
            scratch.read(&format!("{out}/basins.csv")) == scratch.read("basin-words/basins.csv"),
            "basins of {out}"
        );
    }
    let none = scratch.file("none.toml", "scene = \"a.toml\"\n[vary]\nkeys = []\nstart = \"branch\"\n");
    let refused = none.command(&["run", "none.toml", "--out", "none"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("none.toml: 0 words in `keys` of [vary]"), "{}", refused.stderr);
}
