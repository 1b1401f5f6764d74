//! Steps that are too long for an explicit method, and what would do.

use std::f64::consts::TAU;

use integrate::StepLimit;

use crate::{error::CommandError, scene::Scene};

/// Most steps that the scene's keys take.
const MOST: f64 = 100_000.0;
/// Share of the limit that the advice makes use of: tangents grow a little on the way.
const WITHIN: f64 = 0.9;

/// Steps of a run where they are longest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Steps {
    /// Length, s.
    pub step: f64,
    /// Mesh frequency there, Hz.
    pub mesh_hz: f64,
    /// Mesh resonance that `steps_per_resonance` counts by, Hz; 0: none.
    pub resonance_hz: f64,
}

/// Refuses steps beyond the stability limit of the scene's method.
///
/// # Errors
/// Exit status 1 with the limit, the step, and the number of steps that would do.
pub(crate) fn refuse_unstable(scene: &Scene, limit: &StepLimit, steps: &Steps) -> Result<(), CommandError> {
    if steps.step <= limit.step {
        return Ok(());
    }
    let place = scene.place_of(&["motion.steps_per_resonance", "motion.steps_per_mesh_cycle", "motion.method"]);
    let at = place.as_ref().map_or_else(|| scene.file.display().to_string(), ToString::to_string);
    let message = format!(
        "{at}: a step of {:.3e} s is too long for the explicit method: with the fastest motion of this system ({:.4e} Hz) it is stable up to {:.3e} s",
        steps.step,
        limit.rate / TAU,
        limit.step
    );
    Err(CommandError::failed(message, Some(hint(limit, steps))).about(place.as_ref().and_then(|p| p.excerpt())))
}

/// Keys with the numbers that would do, as far as they take them.
fn hint(limit: &StepLimit, steps: &Steps) -> String {
    let needed = |hz: f64| (1.0 / (WITHIN * limit.step * hz)).ceil();
    let keys = [("steps_per_resonance", steps.resonance_hz), ("steps_per_mesh_cycle", steps.mesh_hz)];
    let would_do: Vec<String> = keys
        .iter()
        .filter(|(_, hz)| *hz > 0.0 && needed(*hz) <= MOST)
        .map(|(key, hz)| format!("`{key} = {:.0}`", needed(*hz)))
        .collect();
    let others = "an `error_tolerance`, or an implicit `method`";
    if would_do.is_empty() {
        format!("take {others}")
    } else {
        format!("{} would do, or {others}", would_do.join(" or "))
    }
}
