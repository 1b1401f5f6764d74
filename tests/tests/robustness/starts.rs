//! Where motions begin: in balance, found also where flanks are apart by many deflections; else the reason is named.

use std::{fs, process::Output};

use verification::program::ale_gear;

use crate::program;

fn run(text: &str) -> (Output, bool) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let words = ["run", "scene.toml", "--out", "o", "--no-cache", "--quiet"];
    let output = ale_gear(program(), folder.path(), &words).output().unwrap();
    let written = folder.path().join("o/summary.json").exists();
    (output, written)
}

/// Under a light load on flanks with slopes the gap from one phase to the next is many deflections wide: between a step
/// that does not reach the teeth and one that overlaps by far too much there is a balance all the same.
#[test]
fn a_balance_is_found_where_flanks_are_apart() {
    for (name, text) in [
        ("apart", include_str!("../../data/starts/apart.toml")),
        ("apart, with modes", include_str!("../../data/starts/apart_with_modes.toml")),
    ] {
        let (output, written) = run(text);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && written, "{name}: status {:?}, {said}", output.status.code());
    }
}

/// A load that is less than what round-off makes of the stiffness of teeth is called that, and no bearing is asked for: where no
/// equilibrium is found, and where one is found by the luck of last digits, by its certificate.
#[test]
fn a_load_below_round_off_is_named() {
    let text = include_str!("../../data/starts/lost_load.toml");
    for torque in ["1e-13", "3e-14", "1e-14"] {
        let (output, written) = run(&text.replace("torque_nm = 1e-13", &format!("torque_nm = {torque}")));
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{torque} N m: {said}");
        let wanted = match written {
            false => ["N on the flanks is too light: round-off of places", "\nhint: give a larger torque"],
            true => ["check failed: round_off_share", "is the torque in N·m"],
        };
        assert!(wanted.iter().all(|words| said.contains(words)), "{torque} N m: {said}");
    }
}
