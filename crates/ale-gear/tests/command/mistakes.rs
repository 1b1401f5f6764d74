//! Numbers in another unit, files of another kind, words of another keyboard: the whole text, and that the hint cures.

use crate::util::{ISO_SCENE, Run, Scratch, repository};

/// An ordinary pair of teeth of 2.5 mm without meshes.
const SCENE: &str = "[pinion]\nteeth = 23\nhelix_angle_deg = 15.0\n[wheel]\nteeth = 41\n[pair]\nnormal_module_mm = 2.5\n\
     face_width_mm = 18.0\n[operation]\ntorque_nm = 80.0\n[analysis]\nmodel = \"iso\"\n";

/// The scene with one line replaced.
fn with(old: &str, new: &str) -> String {
    assert!(SCENE.contains(old), "{old}");
    SCENE.replacen(old, new, 1)
}

fn run(scene: &str) -> (Run, Vec<String>) {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    (run, scratch.names())
}

/// The whole complaint, status 2, nothing written; and the scene with the line that the hint asks for has a result.
fn refused(scene: &str, text: &str, [wrong, right]: [&str; 2]) {
    let (run_of, names) = run(scene);
    assert_eq!(run_of.complaint(), text, "for\n{scene}");
    assert_eq!((run_of.code, run_of.stdout.as_str(), names.len()), (Some(2), "", 1), "for\n{scene}");
    assert!(text.contains(right), "the hint does not say `{right}`");
    let (cured, _) = run(&scene.replacen(wrong, right, 1));
    assert_eq!(cured.code, Some(0), "{right}: {}", cured.stderr);
}

/// What a load bends by a module or more is told before any work, with the unit that was meant.
#[test]
fn loads_in_another_unit_are_refused_with_the_unit_that_was_meant() {
    refused(
        &with("torque_nm = 80.0", "torque_nm = 80000.0"),
        "ale-gear: a.toml:10: 80000 N·m would bend the teeth by 4.9 mm, 1.96 modules, and press them with 0.168 times their \
         modulus (ISO 6336-1 and Hertz)\nhint: 80000 N·mm are 80 N·m: write `torque_nm = 80`\n",
        ["torque_nm = 80000.0", "torque_nm = 80"],
    );
    refused(
        &with("[analysis]", "[material]\nyoung_mpa = 206.0\n[analysis]"),
        "ale-gear: a.toml:12: 80 N·m would bend the teeth by 5.12 mm, 2.05 modules, and press them with 0.168 times their \
         modulus (ISO 6336-1 and Hertz)\nhint: 206 GPa are 206000 MPa: write `young_mpa = 206000`\n",
        ["young_mpa = 206.0", "young_mpa = 206000"],
    );
    refused(
        &with("face_width_mm = 18.0", "face_width_mm = 0.018"),
        "ale-gear: a.toml:8: 80 N·m would bend the teeth by 4.9 mm, 1.96 modules, and press them with 0.191 times their modulus \
         (ISO 6336-1 and Hertz)\nhint: 0.018 m are 18 mm: write `face_width_mm = 18`\n",
        ["face_width_mm = 0.018", "face_width_mm = 18"],
    );
}

/// What takes the whole tip away is no relief.
#[test]
fn a_relief_of_a_millimetre_is_refused() {
    let relief = "modification = { tip_relief_um = 1000.0, tip_relief_start_diameter_mm = 60.0 }\n[wheel]";
    let scene = with("[wheel]", relief).replace("model = \"iso\"", "positions_per_cycle = 1");
    let (run, names) = run(&scene);
    assert_eq!(
        run.complaint(),
        "ale-gear: a.toml:4: 1000 µm off both flanks of the pinion leave nothing of its tips\n\
         hint: amounts are in µm; some 50 µm are usual at this module\n"
    );
    assert_eq!((run.code, names.len()), (Some(2), 1));
}

/// A value out of its range is told what it is in the unit that has it in range.
#[test]
fn a_value_out_of_range_is_told_in_the_unit_of_the_key() {
    let says = |scene: &str, wrong: &str, hint: &str| {
        let (run, names) = run(scene);
        assert!(run.stderr.ends_with(&format!("\nhint: {hint}\n")), "{hint}\n{}", run.stderr);
        assert_eq!((run.code, names.len()), (Some(2), 1), "{}", run.stderr);
        let right = hint.split('`').nth(1).unwrap();
        let (cured, _) = self::run(&scene.replacen(wrong, right, 1));
        assert_eq!(cured.code, Some(0), "{right}: {}", cured.stderr);
    };
    let pair = |line: &str| with("[pair]\n", &format!("[pair]\n{line}\n"));
    let material = |line: &str| with("[analysis]", &format!("[material]\n{line}\n[analysis]"));
    says(
        &pair("normal_pressure_angle_deg = 0.349"),
        "normal_pressure_angle_deg = 0.349",
        "0.349 rad are 20 degrees: write `normal_pressure_angle_deg = 20`",
    );
    says(
        &material("young_mpa = 2.06e11"),
        "young_mpa = 2.06e11",
        "2.06e11 Pa are 206000 MPa: write `young_mpa = 206000`",
    );
    says(
        &material("density_kg_m3 = 7.85e-9"),
        "density_kg_m3 = 7.85e-9",
        "7.85e-9 t/mm^3 are 7850 kg/m^3: write `density_kg_m3 = 7850`",
    );
    says(&material("poisson = 30.0"), "poisson = 30.0", "30 % are 0.3: write `poisson = 0.3`");
    says(
        &with("normal_module_mm = 2.5", "normal_module_mm = 0.0025"),
        "normal_module_mm = 0.0025",
        "0.0025 m are 2.5 mm: write `normal_module_mm = 2.5`",
    );
    says(
        &with("[wheel]", "thickness_allowance_mm = 50.0\n[wheel]"),
        "thickness_allowance_mm = 50.0",
        "50 µm are 0.05 mm: write `thickness_allowance_mm = 0.05`",
    );
}

/// What is possible and unlikely is a remark: before the work, and among the remarks.
#[test]
fn unlikely_values_are_remarked() {
    let remarked = |scene: &str, text: &str| {
        let (run, _) = run(scene);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert_eq!(run.stderr, format!("ale-gear: {text}\n"), "for\n{scene}");
        assert!(run.stdout.contains(&format!("\nwarning: {text}\n")), "{}", run.stdout);
    };
    remarked(
        &with("helix_angle_deg = 15.0", "helix_angle_deg = 0.2618"),
        "`helix_angle_deg` is 0.2618, nearly a spur gear; 0.2618 rad are 15 degrees",
    );
    let light = with("torque_nm = 80.0", "torque_nm = 0.5");
    remarked(
        &light.replacen("[analysis]", "[material]\nyoung_mpa = 206.0\n[analysis]", 1),
        "`young_mpa` of the gears is 206, softer than plastics; 206 GPa are 206000 MPa",
    );
    remarked(
        &with("torque_nm = 80.0", "torque_nm = 0.01").replacen("face_width_mm = 18.0", "face_width_mm = 0.1", 1),
        "`face_width_mm` is 0.1, 0.04 times the module of 2.5 mm; 0.1 m are 100 mm",
    );
    remarked(
        &with("[wheel]", "bore_diameter_mm = 0.03\n[wheel]"),
        "the bore of the pinion is 0.03 mm in a gear of 59.5 mm; 0.03 m are 30 mm",
    );
    remarked(
        &with("[wheel]", "thickness_allowance_mm = 0.00005\n[wheel]"),
        "`thickness_allowance_mm` of the pinion is 5.00e-5, less than can be measured; 5e-5 m are 0.05 mm",
    );
}

/// Plastic gears, those of rolling mills and of watches are gears.
#[test]
fn sound_gears_pass_without_a_word() {
    let silent = |scene: &str| {
        let (run, _) = run(scene);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "for\n{scene}");
    };
    let material =
        |scene: &str, lines: &str| scene.replacen("[analysis]", &format!("[material]\n{lines}\n[analysis]"), 1);
    silent(SCENE);
    silent(ISO_SCENE);
    for young in ["2000.0", "3000.0"] {
        silent(&material(
            &with("torque_nm = 80.0", "torque_nm = 8.0"),
            &format!("young_mpa = {young}\npoisson = 0.38"),
        ));
    }
    let mill = with("normal_module_mm = 2.5", "normal_module_mm = 25.0");
    let mill = mill.replacen("face_width_mm = 18.0", "face_width_mm = 600.0", 1);
    silent(&mill.replacen("torque_nm = 80.0", "torque_nm = 500000.0", 1));
    let watch = with("normal_module_mm = 2.5", "normal_module_mm = 0.2");
    let watch = watch.replacen("face_width_mm = 18.0", "face_width_mm = 2.0", 1);
    silent(&watch.replacen("torque_nm = 80.0", "torque_nm = 0.02", 1));
    silent(&with("helix_angle_deg = 15.0", "helix_angle_deg = 0.0"));
}

/// A result that bends the teeth out of linear elasticity is a failed one: its files are there, and status 1.
#[test]
fn a_deflection_of_a_third_of_a_module_is_no_result() {
    let scratch = Scratch::new().file("a.toml", with("torque_nm = 80.0", "torque_nm = 18000.0"));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("check failed: deflection_over_module 0.56"), "{}", run.stderr);
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    assert_eq!(summary["certificate"], "failed");
    assert_eq!(summary["certificate_checks"]["pressure_over_modulus"]["bound"], 0.3);
}

/// Signs and units of text processors.
#[test]
fn signs_and_units_of_other_programs_are_told() {
    let toml = "string values must be quoted, expected literal string";
    refused(
        &with("helix_angle_deg = 15.0", "helix_angle_deg = \u{2212}15.0"),
        &format!(
            "ale-gear: a.toml:3: {toml}\nhint: its minus sign is not the one of a keyboard: write `helix_angle_deg = -15.0`\n"
        ),
        ["helix_angle_deg = \u{2212}15.0", "helix_angle_deg = -15.0"],
    );
    refused(
        &with("helix_angle_deg = 15.0", "helix_angle_deg = 15\u{b0}"),
        &format!("ale-gear: a.toml:3: {toml}\nhint: the unit is in the key: write `helix_angle_deg = 15`\n"),
        ["helix_angle_deg = 15\u{b0}", "helix_angle_deg = 15"],
    );
    refused(
        &with("normal_module_mm = 2.5", "normal_module_mm = \"2.5 mm\""),
        "ale-gear: a.toml:7: `normal_module_mm` must be a number, found string \"2.5 mm\"\n\
         hint: the unit is in the key: write `normal_module_mm = 2.5`\n",
        ["normal_module_mm = \"2.5 mm\"", "normal_module_mm = 2.5"],
    );
    refused(
        &with("normal_module_mm = 2.5", "normal_module_mm = \"0.25 cm\""),
        "ale-gear: a.toml:7: `normal_module_mm` must be a number, found string \"0.25 cm\"\n\
         hint: 0.25 cm are 2.5 mm: write `normal_module_mm = 2.5`\n",
        ["normal_module_mm = \"0.25 cm\"", "normal_module_mm = 2.5"],
    );
    refused(
        &with("normal_module_mm = 2.5", "module = 2.5"),
        "ale-gear: a.toml:7: unknown key `module`\nhint: did you mean `normal_module_mm`?\n",
        ["module = 2.5", "normal_module_mm"].map(|w| if w == "module = 2.5" { "module" } else { w }),
    );
    let scratch = Scratch::new().file("a.toml", SCENE);
    let set = |word: &str| scratch.ale_gear(["run", "a.toml", "--out", "o", "--set", word]).stderr;
    assert_eq!(
        set("pinion.helix_angle_deg=\u{2212}15"),
        "ale-gear: --set pinion.helix_angle_deg: `pinion.helix_angle_deg` must be a number, found string \"\u{2212}15\"\n\
         hint: its minus sign is not the one of a keyboard: write `pinion.helix_angle_deg = -15`\n"
    );
    assert_eq!(
        set("module=3"),
        "ale-gear: --set module: unknown key `module`\nhint: did you mean `normal_module_mm` in [pair]?\n"
    );
}

/// A file of another kind names the subcommand that takes it, and a key varied twice is told.
#[test]
fn files_of_another_kind_name_their_subcommand() {
    let folder = repository().join("scenes/gearbox");
    let copy = |scratch: Scratch, name: &str| scratch.file(name, std::fs::read(folder.join(name)).unwrap());
    let files = ["two_stages.toml", "first_stage.toml", "second_stage.toml"];
    let scratch = files.into_iter().fold(Scratch::new().file("a.toml", SCENE), copy);
    let scratch = scratch.file("plan.toml", "scene = \"a.toml\"\n[vary]\nkeys = [\"operation.torque_nm=50.0\"]\n");
    for (words, text) in [
        (
            &["geometry", "two_stages.toml"][..],
            "two_stages.toml: this is a gearbox file, and a scene is wanted\nhint: `ale-gear run two_stages.toml --out DIR` takes it\n",
        ),
        (
            &["geometry", "plan.toml"],
            "plan.toml: this is a plan, and a scene is wanted\nhint: `ale-gear run plan.toml --out DIR` takes it\n",
        ),
        (
            &["gearbox", "two_stages.toml", "--out", "o"],
            "the subcommand `gearbox` is gone\nhint: `ale-gear run two_stages.toml --out DIR` takes it\n",
        ),
        (&["-q", "gearbox"], "the subcommand `gearbox` is gone\nhint: `ale-gear run FILE.toml --out DIR` takes it\n"),
        (
            &["study", "plan.toml", "--out", "o"],
            "the subcommand `study` is gone\nhint: `ale-gear run plan.toml --out DIR` takes it\n",
        ),
        (
            &["sweep", "a.toml", "--key", "operation.speed_rpm"],
            "the subcommand `sweep` is gone\n\
             hint: `ale-gear vary a.toml --out DIR --vary 'KEY=FROM:TO:COUNT' --start carry` takes it\n",
        ),
        (
            &[
                "vary",
                "a.toml",
                "--out",
                "o",
                "--output",
                "mean_ste_um",
                "--vary",
                "operation.torque_nm=50,100",
                "--vary",
                "operation.torque_nm=200",
            ],
            "a.toml: `operation.torque_nm` is varied twice\n\
             hint: name each key once, with all its values: `--vary operation.torque_nm=50,100,200`\n",
        ),
    ] {
        let run = scratch.command(words);
        assert_eq!(run.stderr, format!("ale-gear: {text}"), "{words:?}");
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{words:?}");
    }
    assert_eq!(scratch.names().len(), 5, "something was left behind");
}

/// Five teeth leave 55 % of the reference diameter no rim; their default bore does.
#[test]
fn few_teeth_have_a_bore_that_leaves_a_rim() {
    let scene = with("teeth = 23", "teeth = 5");
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let summary: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    let bore = summary["inputs"]["pinion"]["bore_diameter_mm"].as_f64().unwrap();
    // The root circle of 6.69 mm lies within the 7.12 mm of the usual bore.
    let wanted = 0.5 * (2.5 * 5.0 / 15f64.to_radians().cos() - 2.5 * 2.5);
    assert!((bore / wanted - 1.0).abs() < 1e-12, "{bore} mm for {wanted} mm");
}

/// More threads than a machine can use is a remark, and the result is the same.
#[test]
fn far_more_threads_than_cores_are_remarked() {
    let scratch = Scratch::new().file("a.toml", SCENE);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--threads", "1000"]);
    let cores = std::thread::available_parallelism().unwrap();
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(
        run.stderr,
        format!(
            "ale-gear: 1000 threads on {cores} cores: most of them only wait and take memory; leave `--threads` out to use all cores\n"
        )
    );
}

/// Meshes that memory cannot hold are refused with the keys that ask for them.
#[test]
fn meshes_beyond_all_memory_are_refused_at_once() {
    let mesher = "mesher = { elements_profile = 500, elements_face = 2000 }\n[wheel]";
    let scene = with("[wheel]", mesher).replacen("model = \"iso\"", "model = \"reduced\"", 1);
    let (run, names) = run(&scene);
    assert!(
        run.stderr.starts_with(
            "ale-gear: a.toml:4: 1.0e12 pairs of flank elements (`elements_profile` 500 x `elements_face` 2000 x \
             `elements_profile` 500 x `elements_face` 2000) take about 1.7e7 GB; "
        ),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("hint: lower `elements_face` or `elements_profile`: about "), "{}", run.stderr);
    assert_eq!((run.code, names.len()), (Some(2), 1));
}

/// A curve is one of motions, whatever the scene was written for; one that ends within its range is a failed result.
#[test]
fn a_curve_of_a_scene_at_rest_covers_its_range_or_fails() {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let scene = ISO_SCENE
        .replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"))
        .replace("[analysis]\nmodel = \"iso\"\n", "");
    let scratch = Scratch::new().file("a.toml", scene);
    let curve = |motions: &str| {
        let words = [
            "vary",
            "a.toml",
            "--out",
            "o",
            "--vary",
            "operation.speed_rpm=1500:2000",
            "--start",
            "branch",
            "--set",
            "analysis.model=mapped",
        ];
        let set =
            ["--set", "motion.mesh_damping_ratio=0.2", "--set", "motion.continuation.time_points=0", "--set", motions];
        scratch.command(&[&words[..], &set].concat())
    };
    let cut = curve("motion.continuation.motions=3");
    assert_eq!(cut.code, Some(1), "{}", cut.stderr);
    assert!(cut.stderr.contains("check failed: range_left_out "), "{}", cut.stderr);
    assert!(cut.stderr.contains("\nhint: give more `motions`"), "{}", cut.stderr);
    let whole = curve("motion.continuation.motions=1000");
    assert_eq!((whole.code, whole.stderr.as_str()), (Some(0), ""), "the hint cures");
}
