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

/// So does one whose ring is fixed, in the frame of its carrier that turns, and it moves: the lowest mode is elastic, for the
/// train turns freely, and what a motion stores and takes is accounted for. What stands beside the axis of the stage in space,
/// which turns against the carrier, is refused.
#[test]
fn a_stage_with_a_fixed_ring_vibrates_and_moves() {
    let text = std::fs::read_to_string(repository().join("scenes/gearbox/planetary_stage_ring_fixed.toml")).unwrap();
    let vibration = "[vibration]\nfrom_rpm = 500.0\nto_rpm = 6000.0\nspeeds = 3\norders = 2\n";
    let motion = "[motion]\nspeed_rpm = 3000.0\nmesh = \"spring\"\ncycles = 4\nsteps_per_cycle = 80\n";
    let beside = "[[shaft]]\nname = \"beside\"\norigin_mm = [300.0, 0.0, 0.0]\n[[shaft.section]]\nlength_mm = 50.0\n\
                  outer_diameter_mm = 30.0\n[[bearing]]\nname = \"of beside\"\nshaft = \"beside\"\nposition_mm = 10.0\n\
                  stiffness_n_per_mm = [1e5, 1e5, 1e5]\n";
    let scratch = Scratch::new()
        .file("vibration.toml", text.clone() + vibration)
        .file("motion.toml", text.clone() + motion)
        .file("beside.toml", text + beside);
    let set = "analysis.positions_per_cycle=4";
    let run = scratch.ale_gear(["run", "vibration.toml", "--out", "v", "--set", set]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let campbell = scratch.read("v/campbell.csv");
    let lowest: Vec<f64> =
        campbell.lines().skip(1).map(|row| row.split(',').nth(1).unwrap().parse().unwrap()).collect();
    assert!(lowest.len() == 3 && lowest.iter().all(|hz| *hz > 100.0), "{campbell}");
    // Two modes of the ring's bearings part as the frame turns.
    assert!(lowest[2] < 0.98 * lowest[0], "{lowest:?}");
    let run = scratch.ale_gear(["run", "motion.toml", "--out", "m"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let run = scratch.ale_gear(["run", "beside.toml", "--out", "b"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("seen from the carrier that place turns"), "{}", run.stderr);
}

/// Torques that no teeth can carry are refused before any work, whichever member of a stage is held.
#[test]
fn torques_beyond_all_teeth_are_refused() {
    for file in ["planetary_stage", "planetary_stage_ring_fixed"] {
        let stage = repository().join(format!("scenes/gearbox/{file}.toml"));
        let set = "torque.0.torque_nm=1e7";
        let run = Scratch::new().ale_gear(["run", stage.to_str().unwrap(), "--out", "o", "--set", set]);
        assert_eq!(run.code, Some(2), "{file}: {}", run.stderr);
        assert!(run.stderr.contains("would bend the teeth by"), "{file}: {}", run.stderr);
    }
}

/// Three numbers of teeth make a stage that runs as it is, with the torques of its teeth.
#[test]
fn stages_begin_with_three_numbers_of_teeth() {
    let scratch = Scratch::new();
    for (held, torque) in [("ring", "205.88 N·m"), ("carrier", "259.26 N·m")] {
        let file = format!("{held}.toml");
        let written = scratch.ale_gear(["init", &file, "--teeth", "21,30,-81", "--held", held]);
        assert_eq!(written.code, Some(0), "{}", written.stderr);
        let set = "analysis.positions_per_cycle=1";
        let run = scratch.ale_gear(["run", &file, "--out", held, "--set", set]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(run.stdout.contains(torque), "{}", run.stdout);
    }
    for (words, said) in [
        (&["--teeth", "21,30,-81", "--planets", "1"][..], "hint: 2 to 4 have room"),
        (&["--teeth", "21,30,-60"], "hint: a ring of -81 teeth"),
        (&["--teeth", "21,30,81"], "hint: a ring has its teeth inside"),
        (&["--planets", "3"], "hint: give the teeth of sun, planet and ring"),
    ] {
        let refused = scratch.command(&[&["init", "no.toml"][..], words].concat());
        assert_eq!(refused.code, Some(2), "{words:?}: {}", refused.stderr);
        assert!(refused.stderr.contains(said), "{words:?}: {}", refused.stderr);
        assert!(!refused.stderr.contains("stage.toml"), "{words:?}: {}", refused.stderr);
    }
}
