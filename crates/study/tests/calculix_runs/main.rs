//! What CalculiX makes of a deck.

#[path = "../calculix_pair/mod.rs"]
mod calculix_pair;

use std::process::ExitCode;

use calculix_pair::{TORQUE, pair};
use study::calculix::{Calculix, Deck};
use testing::Suite;

fn main() -> ExitCode {
    let calculix = Calculix::find(1).map_err(|error| error.to_string());
    Suite::new(file!()).needing(&calculix, "calculix_balances_the_torque", balances_the_torque).run()
}

/// The forces of the pairs balance the torque, and the rotation does not depend on how far the gears were closed
/// beforehand.
fn balances_the_torque(calculix: Calculix) {
    let model = pair(2);
    let scratch = tempfile::tempdir().unwrap();
    let deck = model.deck();
    let run = calculix.run(&deck, scratch.path()).unwrap_or_else(|e| panic!("{e}"));
    let radius = model.pair.wheel.base_radius();
    let te = 1e3 * radius * run.result.rotation;
    let sizes: Vec<f64> = run.result.pairs.iter().map(|p| p.size()).collect();
    assert!((5.0..20.0).contains(&te), "TE {te} um");
    // About the wheel's axis: the moment about the origin less that of the force at the axis.
    let a = model.pair.centre_distance();
    let torque: f64 = run.result.pairs.iter().map(|p| p.moment[2] - a * p.force[1]).sum();
    assert!((torque.abs() / TORQUE - 1.0).abs() < 2e-3, "{torque} N mm about the wheel's axis");
    let normal = TORQUE / radius / model.pair.base_helix_angle().cos();
    let sum: f64 = sizes.iter().sum();
    assert!((sum / normal - 1.0).abs() < 0.01, "{sum} N on the flanks, {normal} N by the torque");
    let other = calculix.run(&Deck { closing: 2.0 * deck.closing, ..deck }, scratch.path()).unwrap();
    let off = other.result.rotation / run.result.rotation - 1.0;
    assert!(off.abs() < 1e-3, "closed twice as far: rotation {off:e} off");
}
