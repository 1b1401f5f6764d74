//! What the command wants of a model of the ladder, whatever it is made of.

use std::convert::Infallible;

use dynamics::motion::{Mechanism, State};
use lumped::LumpedError;
use nalgebra::DVector;

/// A model that can be run and read.
pub(super) trait LadderModel: Mechanism<Error = Infallible> {
    /// State in which a run begins: at rest under the load as for speed to zero, moving with the nominal rotation.
    fn start(&mut self) -> Result<State, LumpedError>;

    /// What counts as a large motion of each coordinate, for the integrators' tolerances.
    fn scale(&self) -> DVector<f64>;

    /// Names of the columns of a row; those that the reduced model has too bear its names.
    fn columns(&self) -> Vec<String>;

    /// A row at a state.
    fn row(&mut self, state: &State) -> Vec<f64>;

    /// Transmission error under the mean load at `phases` evenly spaced phases as speed goes to zero, mm; `None` where the model does not tell.
    fn static_errors(&self, phases: usize) -> Option<Vec<f64>>;

    /// Undamped natural frequencies at rest, Hz, ascending; nothing where the model is not linear.
    fn natural_frequencies_hz(&self) -> Vec<f64> {
        Vec::new()
    }
}
