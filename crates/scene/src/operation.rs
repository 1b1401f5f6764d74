//! Load and sense of rotation.

use crate::schema::{Operation, Rotation};

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
