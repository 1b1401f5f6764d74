//! F32: a solver that stops without a solution and says nothing.

use super::FailureMode;
use crate::{EnvelopeError, Figure, Shown, bench::Bench};

pub(super) const MODE: FailureMode = FailureMode {
    number: 32,
    name: "silent failure",
    file: "F32-silent-failure",
    scene: scene_text!("F32-silent-failure"),
    fails: "A solver runs out of iterations, prints a plausible number and ends with status 0.",
    does: "Every result bears its residuals with their bounds; one missed is an error with exit status 1, its files marked.",
    naive: &["operation.torque_nm=1e7"],
    look,
};

/// Scenes that must not be solved, and a word of the reason.
const MUST_FAIL: [(&[&str], &str); 6] = [
    (&["operation.torque_nm=1e7"], "would bend the teeth"),
    (&["contact.method=nodal", "contact.penalty_mpa_per_mm=1", "operation.torque_nm=1e4"], "would bend the teeth"),
    (&["analysis.window_teeth=1"], "outside the window of 1 teeth"),
    (
        &["pair.face_width_mm=1.0", "pinion.profile_shift=0.6", "pair.centre_distance_mm=99.5"],
        "the teeth lose each other",
    ),
    (
        &[
            "analysis.kind=dynamic",
            "motion.method=rk4",
            "motion.steps_per_mesh_cycle=8",
            "motion.steps_per_resonance=0",
        ],
        "is too long for the explicit method",
    ),
    (&["pair.centre_distance_mm=91"], "teeth jam"),
];

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let mut silent = Vec::new();
    for (settings, word) in MUST_FAIL {
        let dynamic = settings.contains(&"analysis.kind=dynamic");
        let said = if dynamic {
            bench.in_motion(settings).map(|_| ()).map_err(|e| e.to_string())
        } else {
            bench.at_rest(settings).map(|_| ()).map_err(|e| e.to_string())
        };
        if !said.as_ref().is_err_and(|e| e.contains(word)) {
            silent.push(format!("{settings:?}: {said:?}"));
        }
    }
    let first = bench.at_rest(&bench.naive(&[]));
    let count = silent.len() as f64;
    let mut figures = vec![
        Figure::new(
            "scenes without a solution, of six, that are solved or fail for another reason",
            Shown::at_most(count, 0.0),
        ),
        Figure::new("what is said under 10 MN m", Shown::refused(&first, "torque")),
    ];
    if !silent.is_empty() {
        figures.push(Figure::new("which", Shown::says(silent.join("; "), "none")));
    }
    Ok(figures)
}
