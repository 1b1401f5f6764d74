//! Interface of a model with few coordinates to the runs and their evaluation.

use std::{
    convert::Infallible,
    ops::{Deref, DerefMut},
};

use gearbox::{GearboxError, motion::GearboxMemory};
use integrate::{Forces, Mechanism, Resumable, State};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::LumpedRow;
use crate::{AnalysisError, certificate::Check};

/// The loaded pair at one phase in the limit of zero speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticPoint {
    /// Transmission error, mm.
    pub error: f64,
    /// Length of the contact lines, mm; `None` for a model without contact lines.
    pub line_length: Option<f64>,
}

/// A mechanism that is one of its fields.
macro_rules! mechanism_of_field {
    ([$($parameters:tt)*] $model:ty, $field:tt) => {
        impl<$($parameters)*> Mechanism for $model {
            type Error = GearboxError;

            fn mass(&self) -> &DMatrix<f64> {
                self.$field.mass()
            }

            fn forces(
                &mut self,
                t: f64,
                q: &DVector<f64>,
                v: &DVector<f64>,
                out: &mut Forces,
            ) -> Result<(), GearboxError> {
                self.$field.forces(t, q, v, out).map_err(GearboxError::from)
            }

            fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, GearboxError> {
                self.$field.potential(t, q).map_err(GearboxError::from)
            }

            fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, GearboxError> {
                self.$field.potential_off_path(t, q).map_err(GearboxError::from)
            }

            fn events(&self) -> usize {
                self.$field.events()
            }

            fn event_values(
                &mut self,
                t: f64,
                q: &DVector<f64>,
                v: &DVector<f64>,
                out: &mut [f64],
            ) -> Result<(), GearboxError> {
                self.$field.event_values(t, q, v, out).map_err(GearboxError::from)
            }

            fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), GearboxError> {
                self.$field.accepted(t, q, v).map_err(GearboxError::from)
            }

            fn forget(&mut self) {
                self.$field.forget();
            }

            fn end_cycle(&mut self, begin: f64, end: f64) {
                self.$field.end_cycle(begin, end);
            }
        }
    };
}

pub(super) use mechanism_of_field;

/// A model that can be run and read. Only contact that is solved can fail on the way.
pub(crate) trait LumpedMechanism: Mechanism<Error = GearboxError> + Send {
    /// State in which a run begins: at rest under the load as for speed to zero, moving with the nominal rotation.
    ///
    /// # Errors
    /// [`AnalysisError`] where there is nothing to stand on.
    fn start(&mut self) -> Result<State, AnalysisError>;

    /// What counts as a large motion of each coordinate, for the integrators' tolerances.
    fn scale(&self) -> DVector<f64>;

    /// A row at a state.
    ///
    /// # Errors
    /// [`GearboxError`].
    fn row(&mut self, state: &State) -> Result<LumpedRow, GearboxError>;

    /// Transmission error of a state alone, um.
    ///
    /// # Errors
    /// [`GearboxError`].
    fn transmission_error_um(&mut self, state: &State) -> Result<f64, GearboxError> {
        Ok(self.row(state)?.transmission_error_um)
    }

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

    /// Takes another value of a parameter without being built anew; `false` where it cannot.
    fn set(&mut self, _: ParameterChange) -> bool {
        false
    }

    /// Mesh cycles after which all that excites it comes back; `None` where that takes more than 100,000.
    fn common_period(&self) -> Option<u64> {
        Some(1)
    }

    /// Whether a state tells all of it, and its motion is smooth in its start.
    fn shoots(&self) -> bool {
        true
    }

    /// What the law remembers beside coordinates and velocities.
    fn memory(&self) -> LumpedMemory {
        LumpedMemory::Formulas
    }

    /// Becomes what it was.
    ///
    /// # Errors
    /// [`GearboxError`].
    fn take_up(&mut self, _: &LumpedMemory) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Goes back to where the run begins, for forces at one time after the other from there on.
    ///
    /// # Errors
    /// [`GearboxError`].
    fn rewind(&mut self) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Follows the gears to a time at which forces were asked for, so that later ones may be: a tooth change.
    ///
    /// # Errors
    /// [`GearboxError`].
    fn follow(&mut self, _t: f64, _q: &DVector<f64>, _v: &DVector<f64>) -> Result<(), GearboxError> {
        Ok(())
    }
}

/// State of a model in addition to coordinates and velocities, as stored in a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum LumpedMemory {
    /// None: its forces are formulas.
    Formulas,
    /// Teeth in the windows, extremes, and the largest excursion beyond the map.
    Machine(GearboxMemory),
}

/// Another value of what a pair of reduced gears is driven by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ParameterChange {
    /// Speed of the driver, rad/s.
    Speed(f64),
    /// On the driven gear against its turn, N mm.
    Load(f64),
    /// Damping ratio of the mesh.
    Damping(f64),
}

/// A model whose forces are formulas: nothing can fail.
pub(super) struct Formulas<M>(pub M);

impl<M> Deref for Formulas<M> {
    type Target = M;

    fn deref(&self) -> &M {
        &self.0
    }
}

impl<M> DerefMut for Formulas<M> {
    fn deref_mut(&mut self) -> &mut M {
        &mut self.0
    }
}

mechanism_of_field!([M: Mechanism<Error = Infallible>] Formulas<M>, 0);

/// Standing still at t = 0.
pub(super) fn at_rest(q: DVector<f64>) -> State {
    let n = q.len();
    State::new(0.0, q, DVector::zeros(n))
}

/// A mechanism of any of the lumped models.
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

mechanism_of_field!([] BoxedMechanism, 0);

impl Resumable for BoxedMechanism {
    type Memory = LumpedMemory;

    fn memory(&self) -> LumpedMemory {
        self.0.memory()
    }

    fn restore(&mut self, memory: &LumpedMemory) -> Result<(), GearboxError> {
        self.0.take_up(memory)
    }
}
