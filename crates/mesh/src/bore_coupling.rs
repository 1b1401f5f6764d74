//! How a gear's bore follows its shaft.

use crate::Foundation;

/// Coupling of the bore to the shaft; the first two have the names that finite-element programs use.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum BoreCoupling {
    /// Every node of the bore moves with the shaft's cross-section: a rigid bore.
    #[default]
    Kinematic,
    /// The bore is free to deform; its area-weighted mean displacement and mean rotation are those of the shaft.
    ///
    /// ```text
    /// integral of u dA = 0,   integral of (x - c) x u dA = 0      in the gear's frame; c: centroid of the held faces
    /// ```
    /// The holding force is spread over the bore as a traction t = a + b x (x - c): six numbers, no local reaction.
    Distributing,
    /// The bore stands on springs, which the shaft's cross-section carries.
    Elastic(Foundation),
}

impl BoreCoupling {
    /// Name used in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kinematic => "kinematic",
            Self::Distributing => "distributing",
            Self::Elastic(_) => "elastic",
        }
    }

    /// Whether all sectors of a gear are held alike.
    pub fn is_by_sectors(self) -> bool {
        match self {
            Self::Kinematic | Self::Distributing => true,
            Self::Elastic(foundation) => foundation.is_cyclic(),
        }
    }

    /// The springs under the bore, if it stands on any.
    pub fn foundation(self) -> Option<Foundation> {
        match self {
            Self::Kinematic | Self::Distributing => None,
            Self::Elastic(foundation) => Some(foundation),
        }
    }
}
