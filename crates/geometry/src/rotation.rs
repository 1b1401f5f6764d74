//! Which gear drives, which way the pair turns, and which flanks carry the load then.

use serde::{Deserialize, Serialize};

use crate::Side;

/// Sense in which the pinion turns, seen from +z.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sense {
    /// Counter-clockwise: pair numbers fall as new pairs come in.
    Ccw,
    /// Clockwise: pair numbers rise.
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

    /// The other way round.
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
    /// The gear that is driven.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Pinion => Self::Wheel,
            Self::Wheel => Self::Pinion,
        }
    }

    /// Index of the driven gear: 0 pinion, 1 wheel.
    pub fn driven(self) -> usize {
        match self {
            Self::Pinion => 1,
            Self::Wheel => 0,
        }
    }

    /// The pinion's flanks that carry the load: the leading ones when it drives, the trailing ones when it is driven.
    pub fn loaded_side(self, sense: Sense) -> Side {
        match (self, sense) {
            (Self::Pinion, Sense::Ccw) | (Self::Wheel, Sense::Cw) => Side::Left,
            (Self::Pinion, Sense::Cw) | (Self::Wheel, Sense::Ccw) => Side::Right,
        }
    }
}
