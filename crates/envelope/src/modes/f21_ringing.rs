//! F21: a boundary with mass rings when it is hit.

use integrate::Scheme;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
    pieces::bar::{Boundary, impact},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 21,
    name: "ringing of the contact force",
    file: "F21-ringing",
    scene: scene_text!("F21-ringing"),
    fails: "Nodes with mass bounce on the contact: the force rings about its true value, the more the finer the mesh.",
    does: "Flanks have no mass of their own (static constraint modes, or modes with a massless boundary): contact is with their stiffness alone.",
    naive: &["modes.boundary=consistent"],
    look,
};

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let massless = impact(Boundary::Massless, Scheme::Energy)?;
    let consistent = impact(Boundary::Consistent, Scheme::Newmark)?;
    let result = bench.in_motion(&AS_IT_IS)?;
    let certificate = &result.headline.certificate;
    Ok(vec![
        Figure::new(
            "bar against a wall: force about its exact value, root mean square; naive: consistent mass, Newmark",
            Shown::at_most(massless.ringing, 0.12),
        )
        .beside(Shown::at_least(consistent.ringing, 0.5)),
        Figure::new("bar: largest force over the exact one", Shown::at_most(massless.largest, 1.7))
            .beside(Shown::at_least(consistent.largest, 2.0)),
        Figure::new("bar: energy not accounted for", Shown::at_most(massless.energy, 1e-9)),
        Figure::new(
            "pair with modes: least force of a slice in contact, N",
            Shown::at_least(certificate.flanks.least_contact_force_n.unwrap_or(f64::NAN), 0.0),
        ),
    ])
}
