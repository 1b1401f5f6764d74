//! F16: no load, next to none, and one that changes its sign.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{Bench, errors_um, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 16,
    name: "no load",
    file: "F16-no-load",
    scene: scene_text!("F16-no-load"),
    fails: "Without a load the position is free within the backlash, and the equations of the contact are singular.",
    does: "The torque is a condition beside the contact's; at rest without load the flanks just touch, and a load that round-off hides is told. In motion both flanks may touch, and flight between them is a state of its own.",
    naive: &[],
    look,
};

/// None, and loads from which on the approach of the flanks stands above the round-off of their places.
const TORQUES: [&str; 4] = ["0", "1e-6", "1e-3", "1"];
/// A load whose approach is below that round-off, N m.
const LOST: &str = "operation.torque_nm=1e-9";
/// A load that turns back and forth through the backlash.
const REVERSAL: [&str; 7] = [
    "analysis.kind=dynamic",
    "analysis.cycles=4",
    "operation.torque_nm=2",
    "load.amplitude_nm=10",
    "load.frequency_hz=250",
    "drive.by=speed",
    "motion.run=span",
];

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let mut sizes = Vec::new();
    for torque in TORQUES {
        let result = bench.at_rest(&[format!("operation.torque_nm={torque}")])?;
        sizes.push(largest(errors_um(&result).into_iter().map(f64::abs)));
    }
    let falls = sizes.windows(2).filter(|w| w[0] < w[1]).count();
    let lost = bench.at_rest(&[LOST]);
    let reversal = bench.in_motion(&REVERSAL)?;
    let certificate = &reversal.headline.certificate;
    Ok(vec![
        Figure::new("largest transmission error without load, um", Shown::at_most(sizes[0], 1e-9)),
        Figure::new(
            "steps from 0 over 1e-6 and 1e-3 to 1 N m in which the transmission error grows, of three",
            Shown::at_least(falls as f64, 3.0),
        ),
        Figure::new("transmission error at 1e-6 N m over that at 1 N m", Shown::at_most(sizes[1] / sizes[3], 1e-4)),
        Figure::new("what is said of 1e-9 N m, which round-off hides", Shown::refused(&lost, "round_off_share")),
        Figure::new(
            "load that reverses through the backlash: steps in which no flank touches",
            Shown::at_least(certificate.flanks.steps_without_contact as f64, 1.0),
        ),
        Figure::new(
            "load that reverses: largest force on the coast flanks, N",
            Shown::at_least(reversal.headline.max_coast_normal_force_n, 1.0),
        ),
        Figure::new(
            "load that reverses: energy not accounted for, over what was turned over",
            Shown::at_most(certificate.ledger_residual_over_turnover.abs(), 1e-6),
        ),
    ])
}
