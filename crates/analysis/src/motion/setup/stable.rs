//! Refusal of steps that are too long for an explicit method.

use integrate::StepLimit;
use scene::Scene;

use crate::{
    AnalysisError,
    unstable_steps::{Steps, UnstableSteps},
};

/// Refuses steps beyond the stability limit of the scene's method.
///
/// # Errors
/// [`AnalysisError::UnstableSteps`] with the limit, the step, and the number of steps that would do.
pub fn refuse_unstable(scene: &Scene, limit: &StepLimit, steps: &Steps) -> Result<(), AnalysisError> {
    if steps.step <= limit.step {
        return Ok(());
    }
    Err(AnalysisError::UnstableSteps(Box::new(UnstableSteps::of(scene, limit, steps))))
}
