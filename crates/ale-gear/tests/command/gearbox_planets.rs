//! Planetary stages as a user meets them.

use crate::util::{Scratch, repository};

/// A carrier whose turn nothing holds is named with what would, not the pins that it takes along.
#[test]
fn a_carrier_that_turns_off_is_named() {
    let text = std::fs::read_to_string(repository().join("scenes/gearbox/planetary_stage.toml")).unwrap();
    let loose = text.replace("turn_stiffness_nm_per_rad = 1e7\n", "");
    assert_ne!(loose, text);
    let run = Scratch::new().file("stage.toml", loose).ale_gear(["run", "stage.toml", "--out", "o"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("nothing holds shaft carrier about its own axis"), "{}", run.stderr);
    assert!(
        run.stderr.contains("hint: give a bearing between it and the ground `turn_stiffness_nm_per_rad`"),
        "{}",
        run.stderr
    );
}

/// A stage seen from its carrier vibrates; what stands in it turns with no order.
#[test]
fn a_planetary_stage_vibrates() {
    let text = std::fs::read_to_string(repository().join("scenes/gearbox/planetary_stage.toml")).unwrap();
    let vibration = "[vibration]\nfrom_rpm = 500.0\nto_rpm = 2000.0\nspeeds = 4\norders = 2\n";
    let scratch = Scratch::new().file("stage.toml", text + vibration);
    let run = scratch.ale_gear(["run", "stage.toml", "--out", "o", "--set", "analysis.positions_per_cycle=8"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let campbell = scratch.read("o/campbell.csv");
    assert!(campbell.contains("shaft_4") && !campbell.contains("shaft_5"), "{campbell}");
}
