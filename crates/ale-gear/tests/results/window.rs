//! A window too narrow for its load grows by itself, and only when its width was left to the program.

use crate::util::{ISO_SCENE, Scratch};

/// The default pair bent far past its rating: teeth beside the least window of three would touch.
fn overloaded() -> String {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    ISO_SCENE
        .replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"))
        .replace("torque_nm = 150.0", "torque_nm = 10000.0")
        .replace("model = \"iso\"", "model = \"reduced\"\npositions_per_cycle = 4")
}

#[test]
fn a_starved_window_grows_with_a_warning() {
    let scratch = Scratch::new().file("a.toml", overloaded());
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let remarks = summary["remarks"].to_string();
    assert!(remarks.contains("the window was widened to "), "{remarks}");
    assert!(summary["window_teeth"].as_u64().unwrap() > 3, "{}", summary["window_teeth"]);
}

#[test]
fn a_fixed_window_that_starves_is_an_error() {
    let scratch = Scratch::new().file("a.toml", overloaded() + "window_teeth = 3\n");
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_ne!(run.code, Some(0));
    assert!(run.stderr.contains("outside the window of 3 teeth"), "{}", run.stderr);
}
