//! What a model with few coordinates must answer to be run and read, whatever it is made of.

use std::{
    convert::Infallible,
    ops::{Deref, DerefMut},
};

use ::lumped::LumpedError;
use integrate::{Forces, Mechanism, State};
use nalgebra::{DMatrix, DVector};

use super::LumpedRow;
use crate::certificate::Check;

/// The loaded pair at one phase as speed goes to zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticPoint {
    /// Transmission error, mm.
    pub error: f64,
    /// Length of the contact lines, mm; `None` where the model has none.
    pub line_length: Option<f64>,
}

/// A model that can be run and read.
pub(crate) trait LumpedMechanism: Mechanism<Error = Infallible> + Send {
    /// State in which a run begins: at rest under the load as for speed to zero, moving with the nominal rotation.
    ///
    /// # Errors
    /// [`LumpedError`] where there is nothing to stand on.
    fn start(&mut self) -> Result<State, LumpedError>;

    /// What counts as a large motion of each coordinate, for the integrators' tolerances.
    fn scale(&self) -> DVector<f64>;

    /// A row at a state.
    fn row(&mut self, state: &State) -> LumpedRow;

    /// The pair under the mean load at `phases` evenly spaced phases as speed goes to zero; `None` where it finds
    /// nothing to rest on.
    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>>;

    /// Undamped natural frequencies at `share` of the scene's speed, Hz, ascending, the free turn among them; nothing
    /// where the model is not linear.
    fn natural_frequencies_hz(&self, share: f64) -> Vec<f64>;

    /// What must hold of the run so far, beside its energy.
    fn checks(&self) -> Vec<Check> {
        Vec::new()
    }
}

/// Standing still at t = 0.
pub(super) fn at_rest(q: DVector<f64>) -> State {
    let n = q.len();
    State::new(0.0, q, DVector::zeros(n))
}

/// Any of them.
pub(crate) struct BoxedMechanism(Box<dyn LumpedMechanism>);

impl std::fmt::Debug for BoxedMechanism {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BoxedMechanism").field("coordinates", &self.mass().nrows()).finish()
    }
}

impl BoxedMechanism {
    pub(super) fn new(model: impl LumpedMechanism + 'static) -> Self {
        Self(Box::new(model))
    }
}

impl Deref for BoxedMechanism {
    type Target = dyn LumpedMechanism;

    fn deref(&self) -> &Self::Target {
        &*self.0
    }
}

impl DerefMut for BoxedMechanism {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut *self.0
    }
}

impl Mechanism for BoxedMechanism {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        self.0.mass()
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        self.0.forces(t, q, v, out)
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        self.0.potential(t, q)
    }

    fn events(&self) -> usize {
        self.0.events()
    }

    fn event_values(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        self.0.event_values(t, q, v, out)
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), Infallible> {
        self.0.accepted(t, q, v)
    }
}
