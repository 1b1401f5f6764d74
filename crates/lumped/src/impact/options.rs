//! Options of an impact model.

use dynamics::{Bearing, COORDINATES, Drive, RigidBody, Speed, Torque};
use geometry::{Driver, Sense};
use serde::{Deserialize, Serialize};

use super::{ImpactLaw, StickSlip};
use crate::{
    LumpedError,
    error::{finite, not_negative, positive},
};

/// Bodies, bearings, drive and contact of a pair of rigid gears.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImpactOptions {
    /// Driving gear.
    pub driver: Driver,
    /// Sense in which the pinion turns.
    pub sense: Sense,
    /// Pinion and wheel.
    pub bodies: [RigidBody; 2],
    /// Bearings of both gears.
    pub bearings: [Bearing; 2],
    /// Which rigid coordinates of each gear are free; the driver's turn is when a torque drives, the driven gear's
    /// always.
    pub free: [[bool; COORDINATES]; 2],
    /// Driver.
    pub drive: Drive,
    /// Load torque on the driven gear against its turn, N mm.
    pub load: Torque,
    /// Force by overlap.
    pub law: ImpactLaw,
    /// Friction; none without.
    pub friction: Option<StickSlip>,
    /// Slices over the face width, 1 to 1000.
    pub slices: usize,
    /// Mesh cycles, whole and part, at t = 0.
    pub start_cycles: f64,
}

impl ImpactOptions {
    pub(super) fn check(&self) -> Result<(), LumpedError> {
        for body in &self.bodies {
            positive("mass of a gear, t", body.mass)?;
            positive("polar inertia of a gear, t mm^2", body.polar_inertia)?;
            positive("transverse inertia of a gear, t mm^2", body.transverse_inertia)?;
        }
        for bearing in &self.bearings {
            for i in 0..COORDINATES {
                not_negative("stiffness of a bearing", bearing.stiffness[(i, i)])?;
                not_negative("damping of a bearing", bearing.damping[(i, i)])?;
            }
            let all = bearing.stiffness.iter().chain(&bearing.damping);
            all.copied().try_for_each(|x| finite("entry of a bearing's matrices", x))?;
        }
        match &self.drive {
            Drive::Speed(speed) => check_speed(speed)?,
            Drive::Balanced(_) => {
                return Err(LumpedError::BalancedDrive);
            }
            Drive::Torque { start, torque } => {
                finite("speed at the start, rad/s", *start)?;
                check_torque("driving torque, N mm", torque)?;
            }
        }
        check_torque("load torque, N mm", &self.load)?;
        self.law.check()?;
        self.friction.iter().try_for_each(StickSlip::check)?;
        finite("mesh cycles at the start", self.start_cycles)?;
        if (1..=1000).contains(&self.slices) {
            return Ok(());
        }
        Err(LumpedError::OutOfRange {
            quantity: "number of slices",
            value: self.slices as f64,
            method: "the search for contact",
            allowed: "1 to 1000",
        })
    }
}

fn check_speed(speed: &Speed) -> Result<(), LumpedError> {
    match *speed {
        Speed::Constant(omega) => finite("speed, rad/s", omega),
        Speed::Ramp { from, to, start, duration } => {
            [from, to].into_iter().try_for_each(|omega| finite("speed, rad/s", omega))?;
            finite("begin of the ramp, s", start)?;
            positive("duration of the ramp, s", duration)
        }
    }
}

fn check_torque(quantity: &'static str, torque: &Torque) -> Result<(), LumpedError> {
    match torque {
        Torque::Constant(value) => finite(quantity, *value),
        Torque::Harmonic { mean, amplitude, frequency_hz, phase } => {
            [mean, amplitude, frequency_hz, phase].into_iter().try_for_each(|x| finite(quantity, *x))
        }
        Torque::Table { times, values } => {
            if times.is_empty() {
                return Err(LumpedError::Empty { quantity });
            }
            if times.len() != values.len() {
                return Err(LumpedError::Lengths { quantity, found: values.len(), wanted: times.len() });
            }
            times.iter().chain(values).try_for_each(|x| finite(quantity, *x))?;
            times.windows(2).try_for_each(|t| positive("time between entries of a torque's table, s", t[1] - t[0]))
        }
    }
}
