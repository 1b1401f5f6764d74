//! The plane of initial states.

use gearbox::GearboxError;
use integrate::{Mechanism, State};
use nalgebra::{Cholesky, DVector};

use super::super::mechanism::BoxedMechanism;
use crate::AnalysisError;

/// States about that of rest under the load: a displacement and a rate of the gears along the line of action.
///
/// ```text
/// q = q_0 + x d,   v = v_0 + x' d,   d = M^-1 g / (g' M^-1 g),   g = d DTE / dq
/// ```
/// An impulse in the mesh moves the gears along d, each by its inertia, and x is what it adds to the transmission error:
/// momentum and the motion of everything else stay what they are.
pub(super) struct StatePlane {
    origin: State,
    /// d, coordinates for a mm of transmission error.
    direction: DVector<f64>,
}

impl StatePlane {
    /// Plane about the state in which a run of the model begins.
    ///
    /// # Errors
    /// [`AnalysisError`] if there is no equilibrium.
    pub fn new(model: &mut BoxedMechanism) -> Result<Self, AnalysisError> {
        let origin = model.start()?;
        let mut error_um = |state: &State| model.transmission_error_um(state).map_err(GearboxError::at(state.time));
        let here = error_um(&origin)?;
        let scale = origin.q.len();
        let mut gradient = DVector::zeros(scale);
        for i in 0..scale {
            // The transmission error is linear in the coordinates: any step is as good.
            let mut moved = origin.clone();
            moved.q[i] += STEP;
            gradient[i] = 1e-3 * (error_um(&moved)? - here) / STEP;
        }
        let along = Cholesky::new(model.mass().clone()).map_or_else(|| gradient.clone(), |mass| mass.solve(&gradient));
        let direction = &along / gradient.dot(&along);
        Ok(Self { origin, direction })
    }

    /// The state that differs from equilibrium by a transmission error (um) and its rate (mm/s).
    pub fn state(&self, error_um: f64, rate_mm_s: f64) -> State {
        let Self { origin, direction } = self;
        State::new(origin.time, &origin.q + 1e-3 * error_um * direction, &origin.v + rate_mm_s * direction)
    }
}

/// Step of a coordinate, mm or rad.
const STEP: f64 = 1e-3;
