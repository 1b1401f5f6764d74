//! The periodic state of a gearbox that nearly repeats itself, by Newton's method. Theory (49), (71).

use std::f64::consts::TAU;

use integrate::{Follower, Method, Periodicity, Resumable, Row, State, StepControl};
use nalgebra::{DMatrix, DVector};
use periodic::Shooting;

use super::{GearboxMechanism, MotionPlan};
use crate::GearboxError;

impl GearboxMechanism {
    /// The stable periodic state near `state` by `plan`, at the same time; `None` where none is near, or the search leads out
    /// of what the meshes hold. `scale`: sizes of the coordinates ([`GearboxMechanism::scale`]).
    ///
    /// # Errors
    /// [`GearboxError`] where the mechanism cannot be put back; [`GearboxError::ModesWithoutPeriod`].
    pub fn nearer(
        &mut self,
        state: &State,
        plan: &MotionPlan,
        scale: &DVector<f64>,
    ) -> Result<Option<State>, GearboxError> {
        let Some(cycles) = self.common_period().filter(|_| self.free.turn.is_none()) else {
            return Ok(None);
        };
        let (memory, back) = (self.memory(), self.back_over(cycles)?);
        let search = Shooting {
            period: plan.step * plan.steps_per_cycle.saturating_mul(cycles) as f64,
            tolerance: plan.settle.map_or(0.0, |settle| settle.tolerance),
            scale: scale.clone(),
            frequency: TAU * self.mesh_frequencies().into_iter().fold(0.0, f64::max),
            free: None,
            back,
        };
        let MotionPlan { scheme, stop_at_events, tolerance, step, .. } = *plan;
        let method = Method { scheme, scale: scale.clone(), stop_at_events, keep_stable: true };
        let found = search.near(self, state, |own| {
            own.restore(&memory)?;
            Ok(method.clone().integrator(StepControl::new(tolerance, step)))
        });
        // What was used of the meshes on the way is not the motion's.
        self.restore(&memory)?;
        integrate::Mechanism::forget(self);
        Ok(found.unwrap_or(None))
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
    pub plan: MotionPlan,
    pub scale: DVector<f64>,
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
        self.plan.seeks(found)
    }

    fn nearer(
        &mut self,
        system: &mut &mut GearboxMechanism,
        state: &State,
        _: Periodicity,
    ) -> Result<Option<State>, GearboxError> {
        system.nearer(state, &self.plan, &self.scale)
    }
}
