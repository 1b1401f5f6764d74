//! Scenes that were drawn at random and went wrong once.

use std::fs;

use verification::program::ale_gear;

use crate::program;

/// Status and messages of a run.
fn run(text: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let words = ["run", "scene.toml", "--out", "o", "--no-cache"];
    let output = ale_gear(program(), folder.path(), &words).output().unwrap();
    let said = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8_lossy(&said).into_owned())
}

/// A window that is too narrow for teeth as soft as these drops a force at a tooth change: the motion is begun again
/// with a wider one, and says so.
#[test]
fn a_window_that_drops_forces_grows() {
    let (status, said) = run(include_str!("../../data/found/dropped_force.toml"));
    assert_eq!(status, Some(0), "{said}");
    assert!(said.contains("drop forces of up to") && said.contains("was widened to 4 teeth"), "{said}");
}

/// Newton's steps go to and fro over the edge of a tip; between them there is a pose that balances the load.
#[test]
fn a_pose_at_an_edge_is_found() {
    let (status, said) = run(include_str!("../../data/found/over_an_edge.toml"));
    assert_eq!(status, Some(0), "{said}");
}

/// Teeth that approach each other by less than places are known to have no stiffness that could be told: refused before the
/// work, and the torque of the hint has digits.
#[test]
fn a_load_without_digits_is_refused() {
    let scene = include_str!("../../data/found/light_load.toml");
    let (status, said) = run(scene);
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("is too small for this pair") && said.contains("round_off_share"), "{said}");
    let enough = said.split("`torque_nm = ").nth(1).and_then(|rest| rest.split('`').next()).unwrap();
    let (status, said) = run(&scene.replace("torque_nm = 0.000000001", &format!("torque_nm = {enough}")));
    assert_eq!(status, Some(0), "{enough} N m: {said}");
}

/// Teeth so soft that no flank presses any more in between are told what they would bend by.
#[test]
fn a_position_where_nothing_presses_is_told() {
    let (status, said) = run(include_str!("../../data/found/nothing_presses.toml"));
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("would bend the teeth by"), "{said}");
}

/// The least gap of the unloaded flanks is found where axes are tilted far for the width.
#[test]
fn tilted_flanks_are_seen_to_touch() {
    let (status, said) = run(include_str!("../../data/found/tilted_short_teeth.toml"));
    assert_eq!(status, Some(0), "{said}");
}

/// Two places on the profile of a slice have the same gap and not the same curvature: its force jumps where the nearer
/// one changes, and the load is balanced by no pose. The pose between the two is taken, and says what it is off by.
#[test]
fn a_force_that_jumps_is_balanced_between() {
    let folder = tempfile::tempdir().unwrap();
    let scene = testing::meshes_folder().parent().unwrap().join("scenes/default.toml");
    let set =
        |gear: &str, key: &str, value: &str| ["--set".to_owned(), format!("{gear}.modification.drive.{key}={value}")];
    let mut words: Vec<String> = ["run", scene.to_str().unwrap(), "--out", "o", "--no-cache"].map(String::from).into();
    for gear in ["pinion", "wheel"] {
        words.extend(set(gear, "tip_relief_um", "24.2108471423535"));
        words.extend(set(gear, "tip_relief_start_diameter_mm", "98"));
    }
    words.extend(set("pinion", "lead_crowning_um", "5.1569202168851564"));
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let output = ale_gear(program(), folder.path(), &words).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let summary = fs::read_to_string(folder.path().join("o/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let residual = summary["certificate_checks"]["pose_residual"]["value"].as_f64().unwrap();
    assert!(residual <= 2e-3, "{residual:e}");
}
