//! What must hold of a result of a scene before its numbers count.

pub use answer::{Check, Checks};
use scene::Scene;

use crate::AnalysisError;

/// Whether every check holds.
///
/// # Errors
/// [`AnalysisError::Certificate`]: the first check that is missed with its value and its bound, and how many there are
/// beside it.
pub fn verdict(checks: &Checks, scene: &Scene) -> Result<(), AnalysisError> {
    let Some(failed) = checks.failed() else { return Ok(()) };
    Err(AnalysisError::Certificate(failed).in_file(&scene.file))
}
