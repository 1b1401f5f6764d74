//! The periodic state of a gearbox by Newton's method. Theory (49), (71).

use integrate::{Ahead, Follower, MotionError, Periodicity, Row, State};
use nalgebra::DMatrix;
use periodic::{Shooting, Shot};

use super::{GearboxMechanism, MotionPlan, PairMotion};
use crate::GearboxError;

/// Brings a motion to its periodic solution over `period` mesh cycles, or as near to it as shooting gets; the residual
/// shows how near. The motion continues from there; energy and counts restart.
///
/// # Errors
/// [`GearboxError::FreeInput`] if a torque drives, because speed and position of the input are then free;
/// [`GearboxError::ModesWithoutPeriod`] with modes of a gear that is not condensed by sectors;
/// [`GearboxError::Motion`].
pub fn shoot(motion: &mut PairMotion, period: u64, tolerance: f64) -> Result<Shot, GearboxError> {
    if motion.system().free.turn.is_some() {
        return Err(GearboxError::FreeInput);
    }
    motion.begin()?;
    let cycle = motion.cycle();
    let period = motion.ahead(period).ok_or(MotionError::<GearboxError>::StandsStill { cycle })?;
    let search = motion.system().search(&period, tolerance)?;
    let shot = search.from_anywhere(motion.system_mut())?;
    motion.replace(shot.state.clone())?;
    Ok(shot)
}

impl GearboxMechanism {
    /// The stable periodic state near the start of a period, at the same time; `None` if none is near, or if the search
    /// leaves the valid range of the meshes.
    ///
    /// # Errors
    /// [`GearboxError`] if the mechanism cannot be restored; [`GearboxError::ModesWithoutPeriod`].
    pub fn nearer(&mut self, period: &Ahead, tolerance: f64) -> Result<Option<State>, GearboxError> {
        if self.free.turn.is_some() {
            return Ok(None);
        }
        self.search(period, tolerance)?.near(self)
    }

    fn search<'a>(&self, period: &'a Ahead, tolerance: f64) -> Result<Shooting<'a>, GearboxError> {
        Ok(Shooting { period, tolerance, free: None, back: self.back_over(period.cycles.len() as u64)? })
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
        let fastest = self.fastest();
        let turned = self.operation.sense.sign() as f64 * cycles as f64 / fastest;
        Ok(Some(self.gears.turned(-turned, self.count(), &self.assembly)?))
    }
}

/// Reads rows off a motion, and takes it to its periodic state where it nearly repeats itself.
pub(super) struct Settling<F> {
    pub rows: F,
    pub plan: MotionPlan,
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

    fn nearer(&mut self, system: &mut &mut GearboxMechanism, period: &Ahead) -> Result<Option<State>, GearboxError> {
        system.nearer(period, self.plan.periodic_tolerance())
    }
}
