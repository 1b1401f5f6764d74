//! F27: dampers that pull.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
    pieces::rebound::{Damper, rebound},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 27,
    name: "impact damping that pulls",
    file: "F27-impact-damping",
    scene: scene_text!("F27-impact-damping"),
    fails: "A damper beside the contact spring (Kelvin-Voigt) starts with a jump and pulls flanks together as they part.",
    does: "Damping sets in with the overlap and takes away what the spring has at the most: no force is ever below zero.",
    naive: &[],
    look,
};

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let naive = rebound(Damper::KelvinVoigt)?;
    let robust = rebound(Damper::Impact)?;
    let result = bench.lumped(&AS_IT_IS)?;
    let least = result.headline.least_slice_force_n.unwrap_or(f64::NAN);
    let lost = result.headline.certificate.rows_without_contact;
    Ok(vec![
        Figure::new(
            "a mass thrown at a contact: least force over the largest",
            Shown::at_least(robust.least_over_largest, 0.0),
        )
        .beside(Shown::at_most(naive.least_over_largest, -0.02)),
        Figure::new("force at first touch over the largest", Shown::at_most(robust.first_over_largest, 0.05))
            .beside(Shown::at_least(naive.first_over_largest, 0.1)),
        Figure::new(
            "restitution against the energy that the damper took, parts off",
            Shown::at_most(robust.energy_off, 1e-4),
        ),
        Figure::new("pair: least force of a slice, N", Shown::at_least(least, 0.0)),
        Figure::new("pair: rows without contact", Shown::at_least(lost as f64, 1.0)),
    ])
}
