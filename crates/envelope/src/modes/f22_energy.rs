//! F22: energy over long runs with separation.

use integrate::Scheme;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
    pieces::clearance::drift_of,
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 22,
    name: "energy drift",
    file: "F22-energy",
    scene: scene_text!("F22-energy"),
    fails: "Methods that keep energy of linear systems make it, or lose it, wherever flanks lose contact and meet again, and where the stiffness follows the mesh.",
    does: "An energy-conserving step (discrete gradient) with a ledger of work: what is not accounted for is in every result, and a certificate.",
    naive: &["motion.method=newmark"],
    look,
};

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let drift = |r: &analysis::motion::MotionResult| r.headline.certificate.ledger_residual_over_turnover.abs();
    let robust = bench.in_motion(&AS_IT_IS)?;
    let naive = bench.unchecked_motion(&bench.naive(&[]))?;
    let [keeps, loses] = [drift_of(Scheme::Energy)?, drift_of(Scheme::Newmark)?];
    let steps = robust.headline.certificate.steps;
    Ok(vec![
        Figure::new(
            "oscillator with clearance, 10^6 free steps: energy lost or made, parts",
            Shown::at_most(keeps, 1e-6),
        )
        .beside(Shown::at_least(loses, 1e-4)),
        Figure::new(
            format!("undamped, {steps} steps with separation: energy not accounted for over what was turned over"),
            Shown::at_most(drift(&robust), 1e-8),
        )
        .beside(Shown::at_least(drift(&naive), 1e-5)),
        Figure::new(
            "losses of contact",
            Shown::at_least(robust.headline.certificate.flanks.contact_losses as f64, 10.0),
        ),
    ])
}
