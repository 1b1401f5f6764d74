//! F18: contact that is none, and teeth that pass through each other.

use super::FailureMode;
use crate::{EnvelopeError, Figure, Shown, bench::Bench};

pub(super) const MODE: FailureMode = FailureMode {
    number: 18,
    name: "false contact and tunnelling",
    file: "F18-false-contact",
    scene: scene_text!("F18-false-contact"),
    fails: "A tip deep in a fillet, a back flank taken for the working one, a tooth that a long step carries through the next.",
    does: "Jamming is refused by the geometry; flanks know their tooth, side and range; a motion that steps over a tooth ends there.",
    naive: &["pair.centre_distance_mm=94.87"],
    look,
};

/// Both gears free under a torque of the driver alone, with far too few steps.
const OVER_SPEED: [&str; 7] = [
    "analysis.kind=dynamic",
    "analysis.cycles=200",
    "operation.speed_rpm=30",
    "operation.torque_nm=1",
    "motion.run=span",
    "motion.steps_per_resonance=0",
    "motion.steps_per_mesh_cycle=8",
];

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let jammed = bench.at_rest(&bench.naive(&[]));
    let both = bench.at_rest(&["contact.flanks=both"])?;
    let driving = bench.at_rest(&["contact.flanks=driving"])?;
    let te = |r: &analysis::StaticResult| r.history.positions[0].transmission_error;
    let over = |torque| bench.in_motion(&[&OVER_SPEED[..], &[torque]].concat());
    let (past, far) = (over("drive.torque_nm=20"), over("drive.torque_nm=4000"));
    Ok(vec![
        Figure::new("centre distance 0.3 m_n too small", Shown::refused(&jammed, "teeth jam")),
        Figure::new(
            "back flanks kept and free: transmission error, parts off",
            Shown::at_most((te(&both) / te(&driving) - 1.0).abs(), 1e-9),
        ),
        Figure::new("a torque that carries teeth past each other", Shown::refused(&past, "passed through each other")),
        Figure::new(
            "a torque that turns both gears by hundreds of teeth in a step",
            Shown::refused(&far, "teeth in one step"),
        ),
    ])
}
