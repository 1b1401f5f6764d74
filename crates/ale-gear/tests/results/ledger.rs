//! Energy of every shipped scene in time: the ledger closes within a millionth of the work that is done, and no force
//! pulls.

use crate::util::{Scratch, repository};
use serde_json::Value;

/// A shipped scene with some words changed, its meshes where they are.
fn shipped(name: &str, changes: &[(&str, &str)]) -> String {
    let path = repository().join("scenes").join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let text = text.replace("\"../meshes/", &format!("\"{}/meshes/", repository().display()));
    changes.iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "{name}: no `{from}`");
        text.replace(from, to)
    })
}

/// Up to a word, without what follows.
fn until<'a>(text: &'a str, word: &str) -> &'a str {
    text.split_once(word).map_or(text, |(before, _)| before)
}

fn headline(name: &str, scene: &str) -> Value {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{name}: {}", run.stdout);
    let summary: Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    summary["headline"].clone()
}

fn closes(name: &str, scene: &str) {
    let found = headline(name, scene);
    let certificate = &found["certificate"];
    let number = |of: &Value, key: &str| of[key].as_f64();
    let open = number(certificate, "ledger_residual_over_turnover").unwrap_or(f64::NAN);
    assert!(open.abs() < 1e-6, "{name}: energy open by {open:e} of the work done");
    let least = number(certificate, "least_contact_force_n").or(number(&found, "least_slice_force_n"));
    assert!(least.is_none_or(|f| f >= 0.0), "{name}: a flank pulls by {least:?} N");
}

#[test]
fn energy_of_the_shipped_motion_closes() {
    closes("motion", &shipped("motion.toml", &[("kind = \"dynamic\"", "kind = \"dynamic\"\ncycles = 2")]));
}

/// At one speed of the sweep, in its resonance, from the quasi-static start on.
#[test]
fn energy_of_the_shipped_resonance_closes() {
    let changes = [("run = \"sweep\"", "run = \"span\""), ("periodic_tolerance = 1e-4\nwarm_up_cycles = 400\n", "")];
    let text = shipped("resonance.toml", &changes);
    let text = until(&text, "[motion.sweep]").replace("torque_nm = 150.0", "torque_nm = 150.0\nspeed_rpm = 8500.0");
    closes("resonance", &text.replace("cycles = 2", "cycles = 10"));
}

/// Rigid gears on their true flanks, at constant speed.
#[test]
fn energy_of_seed_001_closes() {
    let text = shipped("seeds/001.toml", &[("slices = 33", "slices = 9"), ("run = \"ramp\"", "run = \"span\"")]);
    closes("seed 001", &until(&text, "[motion.ramp]").replace("model = \"impact\"", "model = \"impact\"\ncycles = 20"));
}

#[test]
fn energy_of_seed_002_closes() {
    closes("seed 002", &shipped("seeds/002.toml", &[("cycles = 30", "cycles = 4"), ("1.0e-5", "1.0e-2")]));
}

#[test]
fn energy_of_seed_003_closes() {
    closes("seed 003", &shipped("seeds/003.toml", &[("cycles = 16", "cycles = 4"), ("1.0e-6", "1.0e-2")]));
}

#[test]
fn energy_of_seed_004_closes() {
    closes("seed 004", &shipped("seeds/004.toml", &[("cycles = 30", "cycles = 4"), ("1.0e-5", "1.0e-2")]));
}
