//! F16: no load, next to none, and one that changes its sign.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{Bench, errors_um},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 16,
    name: "no load",
    file: "F16-no-load",
    scene: scene_text!("F16-no-load"),
    fails: "Without a load the position is free within the backlash, and the equations of the contact are singular.",
    does: "The torque is a condition beside the contact's; at rest without load the flanks just touch. In motion both flanks may touch, and flight between them is a state of its own.",
    naive: &[],
    look,
};

const TORQUES: [&str; 5] = ["0", "1e-9", "1e-6", "1e-3", "1"];
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
    let mut largest = Vec::new();
    for torque in TORQUES {
        let result = bench.at_rest(&[format!("operation.torque_nm={torque}")])?;
        largest.push(errors_um(&result).into_iter().map(f64::abs).fold(0.0, f64::max));
    }
    let falls = largest.windows(2).all(|w| w[0] <= w[1]);
    let reversal = bench.in_motion(&REVERSAL)?;
    let certificate = &reversal.headline.certificate;
    Ok(vec![
        Figure::new("largest transmission error without load, um", Shown::at_most(largest[0], 1e-9)),
        Figure::new(
            "torques of 0 to 1 N m in which the transmission error does not grow",
            Shown::at_most(f64::from(u8::from(!falls)), 0.0),
        ),
        Figure::new(
            "load that reverses through the backlash: steps in which no flank touches",
            Shown::at_least(certificate.steps_without_contact as f64, 1.0),
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
