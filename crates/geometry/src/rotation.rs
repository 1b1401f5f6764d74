//! Which gear drives, the sense of rotation, and the flanks that then carry the load.

use serde::{Deserialize, Serialize};

use crate::Side;

/// Sense of rotation of the pinion, seen from +z.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sense {
    /// Counter-clockwise: the number of the pair in mesh decreases with time.
    Ccw,
    /// Clockwise: the number of the pair in mesh increases with time.
    Cw,
}

impl Sense {
    /// +1 for counter-clockwise, -1 for clockwise.
    pub fn sign(self) -> i64 {
        match self {
            Self::Ccw => 1,
            Self::Cw => -1,
        }
    }

    /// The opposite sense.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Ccw => Self::Cw,
            Self::Cw => Self::Ccw,
        }
    }
}

/// Which gear drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Driver {
    /// Gear 1.
    Pinion,
    /// Gear 2.
    Wheel,
}

impl Driver {
    /// The other gear.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Pinion => Self::Wheel,
            Self::Wheel => Self::Pinion,
        }
    }

    /// Index of the driven gear: 0 for the pinion, 1 for the wheel.
    pub fn driven(self) -> usize {
        match self {
            Self::Pinion => 1,
            Self::Wheel => 0,
        }
    }

    /// The pinion flanks that carry the load: the leading ones if the pinion drives, the trailing ones if it is driven.
    pub fn loaded_side(self, sense: Sense) -> Side {
        match (self, sense) {
            (Self::Pinion, Sense::Ccw) | (Self::Wheel, Sense::Cw) => Side::Left,
            (Self::Pinion, Sense::Cw) | (Self::Wheel, Sense::Ccw) => Side::Right,
        }
    }
}
