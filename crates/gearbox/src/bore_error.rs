//! Errors of rolling elements that press the bore of a gear.

/// Reasons for which a bearing cannot be in the bore of a gear.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BoreError {
    /// Elements that press along the axis as well, or none.
    #[error("a gear's bore is pressed by cylindrical rollers alone")]
    Elements,
    /// A gear on another shaft, or elsewhere on the same.
    #[error("gear {gear} is not on the shaft of the bearing at its position")]
    Elsewhere {
        /// Name of the gear.
        gear: String,
    },
    /// Two bearings in one bore.
    #[error("another bearing is in the bore of gear {gear}")]
    Twice {
        /// Name of the gear.
        gear: String,
    },
    /// An outer race that is not the bore.
    #[error("the outer race of the rollers is {race_mm:.3} mm wide, and the bore {bore_mm:.3} mm")]
    Race {
        /// Diameter of the circle about all rollers, mm.
        race_mm: f64,
        /// Diameter of the bore, mm.
        bore_mm: f64,
    },
    /// Rollers that reach out of the bore.
    #[error(
        "the rollers lie from {:.3} to {:.3} mm, and the bore from {:.3} to {:.3} mm of mid-face",
        rollers_mm[0], rollers_mm[1], bore_mm[0], bore_mm[1]
    )]
    Beyond {
        /// Ends of the rollers along z, mm from mid-face.
        rollers_mm: [f64; 2],
        /// Ends of the bore's faces.
        bore_mm: [f64; 2],
    },
}

impl BoreError {
    /// Hint for the user: what to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Elements => "take `type = \"cylindrical-roller\"` (needles are such), or leave `in_bore_of` out",
            Self::Elsewhere { .. } => {
                "name the gear's shaft with `shaft`, and give the bearing the gear's `position_mm`; what carries it goes into \
                 `in_shaft`"
            }
            Self::Twice { .. } => "give one bearing two `rows`, `row_distance_mm` apart",
            Self::Race { .. } => {
                "`pitch_diameter_mm` and `element_diameter_mm` make up the bore: change them or the gear's bore"
            }
            Self::Beyond { .. } => "take a shorter `element_length_mm`, or a bore that is longer (`held_mm`)",
        }
    }
}
