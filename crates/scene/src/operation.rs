//! Load and sense of rotation.

use serde::Serialize;

/// Load and motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Operation {
    /// The gear that drives.
    pub driver: Driver,
    /// Sense of rotation of the pinion, seen from +z.
    pub rotation: Rotation,
    /// Torque on the driven gear, N m.
    pub torque_nm: f64,
    /// Speed of the driver, 1/min.
    pub speed_rpm: f64,
}

/// The gear that drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Driver {
    /// Gear 1.
    Pinion,
    /// Gear 2.
    Wheel,
}

/// Sense of rotation seen from +z.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Rotation {
    /// Counter-clockwise.
    Ccw,
    /// Clockwise.
    Cw,
}

impl Rotation {
    /// +1 counter-clockwise, -1 clockwise.
    pub fn sign(self) -> f64 {
        match self {
            Self::Ccw => 1.0,
            Self::Cw => -1.0,
        }
    }
}

impl Operation {
    /// Torque on the driven gear, N mm.
    pub fn torque(&self) -> f64 {
        self.torque_nm * 1e3
    }
}
