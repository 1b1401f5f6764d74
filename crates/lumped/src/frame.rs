//! Directions at a mesh: line of action, across it, normal of the flanks.

use std::f64::consts::PI;

use geometry::{Driver, GearPair, Sense, Side, Vec3};
use serde::{Deserialize, Serialize};

use crate::{LumpedError, error::finite};

/// How driver (i) and driven gear (j) lie to each other and which way force flows, in the global axes of a pair.
///
/// ```text
/// psi = -a_wt + alpha_ij (counter-clockwise),  a_wt + alpha_ij - pi (clockwise)
/// e_y = (-sin psi, cos psi, 0)                  along the line of action, the way the driven gear is pushed
/// e_x = sgn (cos psi, sin psi, 0)               across it: from the driver's axis to where the line of action touches its base circle
/// n   = cos(b_b) e_y - sgn sin(b_b) e_z         normal of the flanks: the force on the driven gear is +F n
/// ```
/// psi is seed 003's orientation angle between the driver's y axis and the plane of action. b_b is the *driver's* base
/// helix angle, positive for a right hand (the seed counts a left-hand driver positive).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshFrame {
    /// Sense of the driver.
    pub sense: Sense,
    /// Working transverse pressure angle a_wt, rad.
    pub pressure_angle: f64,
    /// Base helix angle b_b of the driver, rad, right hand positive.
    pub base_helix_angle: f64,
    /// Direction alpha_ij from the driver's centre to the driven gear's, rad from +x.
    pub orientation: f64,
}

impl MeshFrame {
    /// Frame of a pair: pinion at the origin, wheel on +x.
    pub fn of_pair(pair: &GearPair, driver: Driver, sense: Sense) -> Self {
        let (base_helix_angle, orientation) = match driver {
            Driver::Pinion => (pair.pinion.base_helix_angle(), 0.0),
            Driver::Wheel => (pair.wheel.base_helix_angle(), PI),
        };
        Self { sense, pressure_angle: pair.working_pressure_angle(), base_helix_angle, orientation }
    }

    /// sgn: +1 for a counter-clockwise driver, -1 for a clockwise one.
    pub fn sign(&self) -> f64 {
        self.sense.sign() as f64
    }

    /// Orientation angle psi, rad.
    pub(crate) fn psi(&self) -> f64 {
        match self.sense {
            Sense::Ccw => self.orientation - self.pressure_angle,
            Sense::Cw => self.orientation + self.pressure_angle - PI,
        }
    }

    /// e_y, along the line of action.
    pub fn along(&self) -> Vec3 {
        let (sin, cos) = self.psi().sin_cos();
        Vec3::new(-sin, cos, 0.0)
    }

    /// e_x, across the line of action.
    pub fn across(&self) -> Vec3 {
        let (sin, cos) = self.psi().sin_cos();
        self.sign() * Vec3::new(cos, sin, 0.0)
    }

    /// n, into the driven gear.
    pub fn normal(&self) -> Vec3 {
        let (sin, cos) = self.base_helix_angle.sin_cos();
        cos * self.along() - self.sign() * sin * Vec3::z()
    }

    /// sgn b_b: what the helix is in the axes e_x, e_y, e_z, which are mirrored for a clockwise driver.
    pub fn local_helix(&self) -> f64 {
        self.sign() * self.base_helix_angle
    }

    /// The driver's flanks that carry the load: the leading ones.
    pub fn side(&self) -> Side {
        match self.sense {
            Sense::Ccw => Side::Left,
            Sense::Cw => Side::Right,
        }
    }

    pub(crate) fn check(&self) -> Result<(), LumpedError> {
        finite("orientation in rad", self.orientation)?;
        let angles = [
            ("working pressure angle in rad", self.pressure_angle, self.pressure_angle > 0.0),
            ("base helix angle in rad", self.base_helix_angle, true),
        ];
        for (quantity, value, fine) in angles {
            if !(fine && value.abs() < 1.4) {
                return Err(LumpedError::OutOfRange {
                    quantity,
                    value,
                    method: "a lumped model",
                    allowed: "below 1.4 rad (80 deg), the pressure angle above 0",
                });
            }
        }
        Ok(())
    }
}
