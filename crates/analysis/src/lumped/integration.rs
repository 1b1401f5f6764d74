//! Steps of a run: their length, and the integrator.

use gearbox::GearboxError;
use integrate::{Forces, Integrator, Mechanism, Method, StepControl, StepLimit, Stiffest};
use scene::MotionScene;

use super::mechanism::BoxedMechanism;
use crate::{AnalysisError, motion::scheme};

/// Phases of a mesh cycle at which the longest stable step is looked for.
const PHASES: u32 = 32;

/// Frequencies by which steps are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeshFrequencies {
    /// Mesh frequency, Hz.
    pub mesh_hz: f64,
    /// Resonance of the gears' inertias on the mean mesh stiffness, Hz; 0: none.
    pub resonance_hz: f64,
}

impl MeshFrequencies {
    /// Number of steps between rows so that a period of the mesh resonance has the requested number of steps.
    pub fn steps_per_row(self, motion: &MotionScene) -> u32 {
        let per_cycle = f64::from(motion.steps_per_resonance) * self.resonance_hz / self.mesh_hz;
        let needed = (per_cycle / f64::from(motion.steps_per_mesh_cycle)).ceil();
        if needed.is_finite() { needed.clamp(1.0, 1e6) as u32 } else { 1 }
    }

    /// Length of a step, s.
    pub fn step(self, motion: &MotionScene) -> f64 {
        let rows = f64::from(motion.steps_per_mesh_cycle) * self.mesh_hz;
        1.0 / rows / f64::from(self.steps_per_row(motion))
    }
}

/// How a scene asks for a model to be integrated.
pub(super) fn method(model: &BoxedMechanism, motion: &MotionScene) -> Method {
    let (scheme, scale) = (scheme(motion), model.scale());
    Method { scheme, scale, stop_at_events: motion.stop_at_events, keep_stable: true }
}

/// An integrator of that method for searches of their own, steps as long as this at the most.
pub(super) fn integrator(model: &BoxedMechanism, motion: &MotionScene, step: f64) -> Integrator {
    method(model, motion).integrator(StepControl::new(motion.error_tolerance, step))
}

/// Longest stable step of an explicit method with steps of given length: the stiffest state of a mesh cycle from the
/// start on, its coordinates held. `None` where any step is stable.
///
/// # Errors
/// [`AnalysisError`] where there is nothing to start from.
pub(super) fn stable_step(
    model: &mut BoxedMechanism,
    motion: &MotionScene,
    mesh_hz: f64,
) -> Result<Option<StepLimit>, AnalysisError> {
    let stiffest = Stiffest::new(scheme(motion), model.mass()).filter(|_| motion.error_tolerance.is_none());
    let Some(mut stiffest) = stiffest else { return Ok(None) };
    let start = model.start()?;
    let mut forces = Forces::zeros(start.q.len());
    for phase in 0..PHASES {
        forces.clear();
        let time = start.time + f64::from(phase) / (f64::from(PHASES) * mesh_hz);
        model.forces(time, &start.q, &start.v, &mut forces).map_err(GearboxError::at(time))?;
        stiffest.include(&forces);
    }
    Ok(stiffest.limit())
}
