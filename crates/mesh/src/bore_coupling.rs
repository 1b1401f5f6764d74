//! How a gear's bore follows its shaft.

use crate::{Bolts, Foundation};

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

    /// Bolts, and what holds all teeth alike beside them: springs all around, or the means of a bore that nothing else
    /// holds, which then are free to move. `None` without bolts, and where springs all around hold some motions and leave
    /// others.
    pub fn beside_bolts(self) -> Option<(Self, Bolts)> {
        let foundation = self.foundation()?;
        let (around, bolts) = (foundation.all_around(), foundation.bolts()?);
        if around.iter().all(|k| *k == 0.0) {
            return Some((Self::Distributing, bolts));
        }
        Foundation::new(around, None).ok().map(|springs| (Self::Elastic(springs), bolts))
    }

    /// This coupling of a gear whose teeth are counted from one on that stands this angle (rad) further: its bolts stand as far
    /// back.
    pub fn counted_from(self, angle: f64) -> Self {
        let Some((foundation, bolts)) = self.foundation().and_then(|own| Some((own, own.bolts()?))) else {
            return self;
        };
        let bolts = Bolts { first_angle: bolts.first_angle - angle, ..bolts };
        Foundation::new(foundation.all_around(), Some(bolts)).map_or(self, Self::Elastic)
    }
}
