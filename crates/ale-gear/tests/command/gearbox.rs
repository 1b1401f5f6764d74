//! `ale-gear gearbox` as a user meets it.

use std::path::Path;

use crate::util::{Scratch, repository};

/// The two stages of the scenes, beside their pairs.
fn two_stages() -> Scratch {
    let folder = repository().join("scenes/gearbox");
    let copy = |scratch: Scratch, name: &str| scratch.file(name, std::fs::read(folder.join(name)).unwrap());
    ["two_stages.toml", "first_stage.toml", "second_stage.toml"].into_iter().fold(Scratch::new(), copy)
}

/// Column of a file with commas.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

/// Files, table and numbers are there, agree with each other, and are the same bits for one thread and two.
#[test]
fn a_gearbox_is_solved_into_its_folder() {
    let scratch = two_stages();
    let run = scratch.ale_gear(["gearbox", "two_stages.toml", "--out", "o", "--no-cache"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for word in ["first", "second", "slow, loose", "K_Hbeta", "output 1 lags", "results: o"] {
        assert!(run.stdout.contains(word), "{word} is not in\n{}", run.stdout);
    }
    let positions = scratch.read("o/positions.csv");
    let ste = column(&positions, "mesh_2_ste_um");
    assert_eq!(ste.len(), 8);
    assert!(column(&positions, "body_balance").iter().all(|b| *b < 1e-9));
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let mean = ste.iter().sum::<f64>() / 8.0;
    let told = summary["meshes"][1]["mean_ste_um"].as_f64().unwrap();
    assert!((told / mean - 1.0).abs() < 1e-12, "{told} beside {mean} um");
    assert_eq!(summary["files"], serde_json::json!(["line_load.csv", "motion.csv", "positions.csv", "shafts.csv"]));
    assert!(scratch.path().join("o/shafts.csv").exists() && scratch.path().join("o/line_load.csv").exists());
    let motion = scratch.read("o/motion.csv");
    let rows = column(&motion, "mesh_1_dte_um").len();
    assert_eq!((rows, summary["motion"]["rows"].as_u64()), (20 * 40 / 2 + 1, Some(rows as u64)));
    let told = &summary["motion"];
    let left = told["energy"]["relative_residual"].as_f64().unwrap();
    assert!(left.abs() < 1e-9, "{left}");
    // No mode with held seats is below twice 2000 Hz: 2 %, and 3 % is what the command lets pass.
    assert!(told["reduction"]["frequency_error"].as_f64().unwrap() < 0.03, "{told}");
    // The driver's and the load's torque, by the teeth: 17/53 and 19/47.
    let torque = column(&motion, "input_torque_nm")[0];
    assert!((torque / (-740.0 * 17.0 * 19.0 / 53.0 / 47.0) - 1.0).abs() < 1e-9, "{torque} N m");
    let hertz = |mesh: usize| told["meshes"][mesh]["mesh_hz"].as_f64().unwrap();
    assert!((hertz(0) - 17.0 * 25.0).abs() < 1e-6 && (hertz(1) - 17.0 * 25.0 * 19.0 / 53.0).abs() < 1e-6);
    // Again into the same folder, quietly, on one thread.
    let again = scratch.ale_gear(["gearbox", "two_stages.toml", "--out", "o", "--no-cache", "-q", "-j", "1"]);
    assert_eq!((again.code, again.stdout.as_str()), (Some(0), ""), "{}", again.stderr);
    assert!(scratch.read("o/positions.csv") == positions, "bits go with the number of threads");
    assert!(scratch.read("o/motion.csv") == motion, "bits of the motion go with the number of threads");
}

/// A mistake ends with status 2, line and hint, and leaves no folder.
#[test]
fn mistakes_in_a_gearbox_are_told_with_their_line() {
    let scratch = two_stages();
    let text = scratch.read("two_stages.toml").replace("pinion = \"3\"", "pinion = \"33\"");
    let scratch = scratch.file("wrong.toml", text);
    let run = scratch.ale_gear(["gearbox", "wrong.toml", "--out", "o"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("wrong.toml:") && run.stderr.contains("pinion"), "{}", run.stderr);
    let far = scratch.read("two_stages.toml").replace("[91.0, 118.5, 0.0]", "[91.0, 119.5, 0.0]");
    let scratch = scratch.file("far.toml", far);
    let run = scratch.ale_gear(["gearbox", "far.toml", "--out", "o", "--no-cache"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("mesh second") && run.stderr.contains("hint: "), "{}", run.stderr);
    let run = scratch.ale_gear(["gearbox", "none.toml", "--out", "o"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(!Path::new(&scratch.path().join("o")).exists());
}
