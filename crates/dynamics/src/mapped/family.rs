//! The mapped pair over speed, for what searches for periodic motions.

use std::convert::Infallible;

use integrate::{Forces, Mechanism};
use nalgebra::{DMatrix, DVector};
use periodic::PeriodicFamily;

use super::MappedPair;
use crate::{PairMotionError, Speed};

/// A mapped pair whose driver turns at a constant speed (rad/s), the parameter of the family; its motions come back after
/// a number of mesh cycles.
#[derive(Debug)]
pub struct SpeedFamily {
    pair: MappedPair,
    cycles: u32,
    scale: DVector<f64>,
}

impl SpeedFamily {
    /// Motions that come back after so many mesh cycles; `lag` (mm) is the size of the driven gear's lag.
    ///
    /// # Errors
    /// [`PairMotionError::FreeDriver`] where a torque drives: the speed is no parameter then.
    pub fn new(pair: MappedPair, cycles: u32, lag: f64) -> Result<Self, PairMotionError> {
        let system = pair.system();
        if system.coordinates().driver_turn().is_some() {
            return Err(PairMotionError::FreeDriver);
        }
        let scale = system.coordinates().scales(lag, system.pair().pinion.base_radius());
        Ok(Self { pair, cycles: cycles.max(1), scale })
    }

    /// The pair, at the speed that was set last.
    pub fn pair(&self) -> &MappedPair {
        &self.pair
    }
}

impl PeriodicFamily for SpeedFamily {
    fn set_parameter(&mut self, value: f64) -> Result<(), Infallible> {
        self.pair.system.set_speed(Speed::Constant(value));
        Ok(())
    }

    fn period(&self) -> f64 {
        f64::from(self.cycles) / self.pair.system.cycles_per_second(0.0)
    }

    fn scale(&self) -> DVector<f64> {
        self.scale.clone()
    }
}

impl Mechanism for SpeedFamily {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        self.pair.mass()
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        self.pair.forces(t, q, v, out)
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        self.pair.potential(t, q)
    }
}
