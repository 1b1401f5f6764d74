//! Rejects steps that are too long for an explicit method.

use integrate::StepLimit;
use scene::Scene;

use crate::{
    AnalysisError,
    error::place_in,
    unstable_steps::{Steps, UnstableSteps},
};

/// Rejects steps beyond the stability limit of the scene's method.
///
/// # Errors
/// [`AnalysisError::Refused`] with the limit, the step, and a sufficient number of steps.
pub fn refuse_unstable(scene: &Scene, limit: StepLimit, steps: Steps) -> Result<(), AnalysisError> {
    let Some(unstable) = UnstableSteps::of(steps, limit) else { return Ok(()) };
    let keys = ["motion.steps_per_resonance", "motion.steps_per_mesh_cycle", "motion.method"];
    Err(AnalysisError::from(unstable.refusal()).at(place_in(scene, &keys)))
}
