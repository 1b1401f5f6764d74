//! A gearbox in motion is judged as its pair is: the same figures, checks and remarks, each where it has to speak.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::path::Path;

use analysis::{
    Context, Ending, NoObserver,
    gearbox::GearboxResult,
    motion::{MotionAnalysis, MotionResult},
    remark::Remark,
    solve,
};
use scene::{
    Scene, SceneBuilder,
    gearbox::{Gearbox, gearbox_of_moving_pair},
};

use crate::moving_pairs::small;

/// Name, what is said at the least, and what is changed of the small pair.
type Case<'a> = (&'a str, &'a [&'a str], &'a dyn Fn(SceneBuilder) -> SceneBuilder);

/// Remarks that a pair in motion and its gearbox have in common.
const COMMON: [&str; 8] = [
    "coarse_steps",
    "few_rows",
    "few_steps",
    "no_backlash",
    "both_flanks_press",
    "quasi_static_elasticity",
    "fast_rotation",
    "work_open",
];

fn run(text: &str) -> GearboxResult {
    let folder = tempfile::tempdir().unwrap();
    let file = Gearbox::parse(text, &folder.path().join("held.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"));
    solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap_or_else(|e| panic!("{e}"))
}

/// Codes of what is said, those in common alone, in their order.
fn common(said: &[Remark]) -> Vec<&'static str> {
    let mut codes: Vec<_> = said.iter().map(Remark::code).filter(|code| COMMON.contains(code)).collect();
    codes.sort_unstable();
    codes
}

/// Numbers of the remark of a code.
fn numbers(said: &[Remark], code: &str) -> Vec<f64> {
    let own = said.iter().find(|remark| remark.code() == code).unwrap_or_else(|| panic!("no {code}"));
    let number = |value: &_| serde_json::to_value(value).unwrap().as_f64();
    own.values().filter_map(|(_, value)| number(value)).collect()
}

fn near(name: &str, what: &str, found: f64, wanted: f64) {
    let off = (found - wanted).abs();
    assert!(off <= 1e-6 * wanted.abs().max(1e-9), "{name}: {what} is {found}, of the pair {wanted}");
}

/// Figures, checks and remarks of both.
fn alike(name: &str, pair: &MotionResult, found: &GearboxResult) {
    let (headline, moved) = (&pair.headline, found.motion.as_ref().unwrap());
    let reached = moved.reached.meshes[0];
    let c = &headline.certificate.flanks;
    let own = &moved.flanks[0];
    let all = [
        ("peak to peak", reached.peak_to_peak_dte_um, headline.peak_to_peak_dte_um),
        ("least force", reached.normal_force.least, headline.min_normal_force_n),
        ("largest force", reached.normal_force.largest, headline.max_normal_force_n),
        ("force of the coast flanks", reached.coast_normal_force, headline.max_coast_normal_force_n),
        ("bound of the coupling", own.flank_coupling_bound_um, c.flank_coupling_bound_um),
        ("gap", own.largest_gap_um, c.largest_gap_um),
        (
            "lowest elastic frequency",
            moved.elasticity[0].lowest_elastic_frequency_hz[0],
            headline.elasticity.lowest_elastic_frequency_hz[0],
        ),
        (
            "change by the inertia of elasticity",
            moved.elasticity[0].change_over_peak_to_peak,
            headline.elasticity.change_over_peak_to_peak,
        ),
        ("mesh resonance", moved.resonances[0].hz, headline.mesh_resonance_hz),
    ];
    all.into_iter().for_each(|(what, found, wanted)| near(name, what, found, wanted));
    let counts = |own: &analysis::in_motion::FlankCertificate| {
        (own.contact_losses, own.coast_contacts, own.steps_without_contact, own.rows_on_both_flanks)
    };
    assert_eq!(counts(own), counts(c), "{name}");
    let checks = found.checks();
    for what in ["pulling_force", "force_jump", "dynamic_pressure_over_modulus"] {
        let of = |checks: &analysis::certificate::Checks, name: &str| {
            let check = checks.iter().find(|check| check.name == name).unwrap_or_else(|| panic!("no {name}"));
            [check.value, check.bound]
        };
        let [[a, bound], [b, wanted]] = [of(&checks, &format!("mesh_1_{what}")), of(&pair.facts.certificate, what)];
        assert!(bound == wanted && (a - b).abs() <= 1e-6 * b.max(1e-3), "{name}: {what} is {a}, of the pair {b}");
    }
    let codes = common(&pair.remarks);
    println!("{name}: {codes:?}");
    assert_eq!(common(&found.remarks), codes, "{name}");
    for code in codes {
        let both = [&found.remarks, &pair.remarks].map(|said| numbers(said, code));
        assert_eq!(both[0].len(), both[1].len(), "{name}: {code}");
        both[0].iter().zip(&both[1]).for_each(|(found, wanted)| near(name, code, *found, *wanted));
    }
}

/// Shafts held, a gearbox in motion is told what its pair is told, with the same numbers, and held to the same: few steps and
/// rows, steps that do not show the resonance, flanks without backlash, fast gears. A slow pair with many steps hears nothing.
#[test]
fn a_gearbox_in_motion_is_judged_as_its_pair() {
    let room = |s: SceneBuilder| s.set("pinion.thickness_allowance_mm", 0.03).set("wheel.thickness_allowance_mm", 0.03);
    let shooting = |s: SceneBuilder| s.set("motion.run", "shooting").set("motion.periodic_tolerance", 1e-11);
    let steps =
        |s: SceneBuilder, count: i64| s.set("motion.steps_per_mesh_cycle", count).set("motion.steps_per_resonance", 0);
    let all: [Case<'_>; 4] = [
        ("slow", &[], &|s| steps(shooting(room(s).set("operation.speed_rpm", 1500.0)), 256)),
        ("few steps", &["few_steps", "coarse_steps"], &|s| steps(room(s), 16)),
        ("fast", &["quasi_static_elasticity"], &|s| steps(room(s).set("operation.speed_rpm", 20_000.0), 64)),
        ("no backlash", &["no_backlash"], &|s| {
            let tight = s.set("pinion.thickness_allowance_mm", 0.0).set("wheel.thickness_allowance_mm", 0.0);
            tight.set("contact.flanks", "both").set("operation.speed_rpm", 12_000.0)
        }),
    ];
    for (name, wanted, change) in all {
        let scene: Scene = small(change);
        let pair = MotionAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{name}: {e}"));
        let per_row = 1;
        let found = run(&gearbox_of_moving_pair(&scene, per_row).unwrap().unwrap());
        alike(name, &pair, &found);
        let codes = common(&found.remarks);
        assert!(wanted.iter().all(|code| codes.contains(code)), "{name}: {codes:?}, not {wanted:?}");
        assert!(!wanted.is_empty() || codes.is_empty(), "{name}: {codes:?}");
    }
}

/// The gearbox of the small pair with another table of motion.
fn moved(motion: &str) -> GearboxResult {
    let scene = small(|s| s);
    let text = gearbox_of_moving_pair(&scene, 1).unwrap().unwrap();
    let (before, _) = text.split_once("\n[motion]").unwrap();
    run(&format!("{before}\n[motion]\n{motion}"))
}

fn says(found: &GearboxResult, code: &str) -> bool {
    found.remarks.iter().any(|remark| remark.code() == code)
}

/// A torque that is more than the load changes the speed, and that is told beside the speed of the start; one that balances
/// the load does not.
#[test]
fn a_speed_that_changes_under_a_torque_is_told() {
    let own = "speed_rpm = 3000.0\ndrive = \"torque\"\nmesh = \"spring\"\ncycles = 8\nsteps_per_cycle = 64\n";
    let [balanced, driven] = ["", "input_torque_nm = 300.0\n"].map(|torque| moved(&format!("{own}{torque}")));
    assert!(!says(&balanced, "speed_has_changed"), "{:?}", balanced.remarks);
    let told = numbers(&driven.remarks, "speed_has_changed");
    assert!(told[0] > 3030.0 && told[1] == 3000.0, "{told:?}");
    near(
        "driven",
        "mean speed",
        told[0],
        driven.motion.unwrap().reached.mean_input_speed * 30.0 / std::f64::consts::PI,
    );
}

/// Rows that are too far apart, and rows that are not; a map has its error and what is used of it among the checks, and
/// springs what is used of them.
#[test]
fn rows_and_maps_of_a_gearbox_are_judged() {
    let of = |mesh: &str, per_row: u32, rpm: f64| {
        let steady = format!("run = \"shooting\"\nspeed_rpm = {rpm:?}\ncycles = 4\nsteps_per_cycle = 128\n");
        moved(&format!("{steady}mesh = \"{mesh}\"\nsteps_per_row = {per_row}\n"))
    };
    let fine = of("mapped", 1, 3000.0);
    // The second mesh order is loud at half of the speed at which the first is.
    let coarse = [1000.0, 1500.0, 2000.0, 2500.0].map(|rpm| of("mapped", 32, rpm));
    assert!(!says(&fine, "few_rows"), "{:?}", fine.remarks);
    assert!(coarse.iter().any(|found| says(found, "few_rows")), "four rows a cycle show all");
    let names = |found: &GearboxResult| -> Vec<String> {
        found
            .checks()
            .iter()
            .map(|check| check.name.to_string())
            .filter(|name| name.starts_with("mesh_1_map"))
            .collect()
    };
    assert_eq!(names(&fine), ["mesh_1_map_error", "mesh_1_map_excess"]);
    let error = fine.motion.as_ref().unwrap().map_errors[0].unwrap();
    assert!(error[0] > 0.0 && error[0] < error[1] && error[1] == 0.02, "{error:?}");
    assert!(fine.checks().failed().is_none(), "{:?}", fine.checks());
    assert_eq!(names(&of("spring", 1, 3000.0)), ["mesh_1_map_excess"]);
}

/// The shipped pair with elastic gears vibrates by more than its load at some speeds: that is told with the worst of them.
/// Below all of these it is not.
#[test]
fn a_vibration_beyond_the_load_is_told() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/elastic_pair.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let (before, _) = text.split_once("# The exact contact with these modes").unwrap();
    let of = |to_rpm: f64| {
        let text = before.replace("to_rpm = 9000.0", &format!("to_rpm = {to_rpm:?}"));
        // That is the damping of a motion.
        let text = text.replace("damping_ratio = 0.02\n", "");
        let found = Gearbox::parse(&text, &file).unwrap_or_else(|e| panic!("{e}"));
        solve(&found, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap_or_else(|e| panic!("{e}"))
    };
    let fast = of(9000.0);
    let vibration = fast.vibration.as_ref().unwrap();
    let said = fast.remarks.iter().find(|remark| remark.code() == "vibration_beyond_load").expect("it is told");
    println!("{said}");
    let told = numbers(&fast.remarks, "vibration_beyond_load");
    let rms = vibration.rms.iter().map(|rms| rms.mesh_forces[0]).fold(0.0, f64::max);
    let load = fast.meshes[0].normal_force;
    // One order alone falls by 2^(1/2) times its root mean square.
    assert!(told[0] > rms && told[0] > load && told[3] == load, "{told:?}, {rms} N rms under {load} N");
    assert!(told[4] >= 1.0 && told[4] < told[5] && told[5] == vibration.speeds.len() as f64, "{told:?}");
    let slow = of(2500.0);
    assert!(!says(&slow, "vibration_beyond_load"), "{:?}", slow.remarks);
}
