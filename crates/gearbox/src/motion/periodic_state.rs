//! The periodic state of a gearbox that nearly repeats itself, by Newton's method. Theory (49), (71).

use std::f64::consts::TAU;

use integrate::{Follower, Periodicity, Row, State, Timetable};
use nalgebra::DMatrix;
use periodic::Shooting;

use super::{GearboxMechanism, GearboxTimes};
use crate::GearboxError;

impl GearboxMechanism {
    /// The stable periodic state near `state` of a motion by `times`, at the same time; `None` where none is near, or the
    /// search leads out of what the meshes hold.
    ///
    /// # Errors
    /// [`GearboxError`] where the mechanism cannot be put back; [`GearboxError::ModesWithoutPeriod`].
    pub fn nearer(&mut self, state: &State, times: &GearboxTimes) -> Result<Option<State>, GearboxError> {
        let Some(period) = self.common_period().filter(|_| self.free.turn.is_none()) else {
            return Ok(None);
        };
        let (begin, times) = (state.time, times.beginning(state.time));
        let Some(cycles) = Shooting::cycles(&times, &&mut *self, begin, period) else { return Ok(None) };
        let search = Shooting {
            method: times.method(&&mut *self),
            cycles,
            tolerance: times.plan().settle.map_or(0.0, |settle| settle.tolerance),
            frequency: TAU * self.mesh_frequencies().into_iter().fold(0.0, f64::max),
            free: None,
            back: self.back_over(period)?,
        };
        search.near(self, state)
    }

    /// Map of the coordinates at the end of so many cycles of the fastest mesh to those at their beginning which are the same
    /// motion; `None` where no gear has modes, so that they repeat themselves. Theory (93b).
    ///
    /// # Errors
    /// [`GearboxError::ModesWithoutPeriod`] for a gear whose teeth are not known to be alike.
    pub(super) fn back_over(&self, cycles: u64) -> Result<Option<DMatrix<f64>>, GearboxError> {
        if self.gears.is_empty() {
            return Ok(None);
        }
        let fastest = self.live.iter().map(|m| m.cycles_per_turn.abs()).fold(0.0, f64::max);
        let turned = self.operation.sense.sign() as f64 * cycles as f64 / fastest;
        Ok(Some(self.gears.turned(-turned, self.count(), &self.assembly)?))
    }
}

/// Reads rows off a motion, and takes it to its periodic state where it nearly repeats itself.
pub(super) struct Settling<F> {
    pub rows: F,
    pub times: GearboxTimes,
}

impl<F> Follower<&mut GearboxMechanism> for Settling<F>
where
    F: FnMut(Row<'_, &mut GearboxMechanism>) -> Result<(), GearboxError>,
{
    type Error = GearboxError;

    fn row(&mut self, row: Row<'_, &mut GearboxMechanism>) -> Result<(), GearboxError> {
        (self.rows)(row)
    }

    fn seeks(&self, _: &&mut GearboxMechanism, found: Periodicity) -> bool {
        self.times.plan().seeks(found)
    }

    fn nearer(
        &mut self,
        system: &mut &mut GearboxMechanism,
        state: &State,
        _: Periodicity,
    ) -> Result<Option<State>, GearboxError> {
        system.nearer(state, &self.times)
    }
}
