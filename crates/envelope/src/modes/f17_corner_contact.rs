//! F17: tip edges that press off the line of action.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{Bench, errors_um, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 17,
    name: "corner contact missed",
    file: "F17-corner-contact",
    scene: scene_text!("F17-corner-contact"),
    fails: "Bent teeth meet at their tip edges before the path of contact begins; without that the transmission error steps.",
    does: "Tip edges press off the line of action with their own compliance and normal: the transmission error is continuous.",
    naive: &["contact.corner_contact=false"],
    look,
};

/// Largest difference between neighbouring positions of a whole cycle, um.
fn largest_step(errors: &[f64]) -> f64 {
    let next = errors.iter().cycle().skip(1);
    largest(errors.iter().zip(next).map(|(a, b)| (b - a).abs()))
}

/// Four times as many positions make steps of a continuous curve four times smaller, and leave a jump as it is.
fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let shrink = |naive: bool| {
        let step = |positions: &str| {
            let settings = if naive { bench.naive(&[positions]) } else { vec![positions.to_owned()] };
            Ok::<_, EnvelopeError>(largest_step(&errors_um(&bench.at_rest(&settings)?)))
        };
        Ok::<_, EnvelopeError>(step("analysis.positions_per_cycle=128")? / step("analysis.positions_per_cycle=32")?)
    };
    let (robust, naive) = (shrink(false)?, shrink(true)?);
    Ok(vec![
        Figure::new("largest step of the transmission error, 128 positions over 32", Shown::at_most(robust, 0.4))
            .beside(Shown::at_least(naive, 0.6)),
    ])
}
