//! Errors of rolling bearings.

/// Reasons for which no bearing can be made from the given data.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RollingBearingError {
    /// A value outside its range.
    #[error("{quantity} = {value} is not {wanted}")]
    OutOfRange {
        /// The quantity, with its unit.
        quantity: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The permitted range.
        wanted: &'static str,
    },
    /// More rolling elements than fit on the pitch circle.
    #[error("{elements} rolling elements of {diameter_mm} mm do not fit on a pitch circle of {pitch_diameter_mm} mm")]
    Crowded {
        /// Number of elements per row.
        elements: usize,
        /// Diameter of the elements, mm.
        diameter_mm: f64,
        /// Pitch diameter of the elements, mm.
        pitch_diameter_mm: f64,
    },
    /// A clearance at which the rings pass through each other between the balls.
    #[error(
        "a radial clearance of {clearance_um} um is more than the grooves are deep for: {most_um:.0} um at the most"
    )]
    Clearance {
        /// Given clearance, um.
        clearance_um: f64,
        /// Twice the distance of the centres of curvature of both grooves, um.
        most_um: f64,
    },
    /// A load rating that no bearing of these dimensions has.
    #[error("a static load rating of {rating_n:.0} N fits no bearing of this size: {least_n:.0} N to {most_n:.0} N do")]
    Rating {
        /// Given static load rating, N.
        rating_n: f64,
        /// Static load rating with the smallest elements, N.
        least_n: f64,
        /// Static load rating with the largest elements, N.
        most_n: f64,
    },
}

impl RollingBearingError {
    /// Hint: an action that cures the error.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::OutOfRange { .. } => "take the values of the catalogue or of the drawing",
            Self::Crowded { .. } => "are the diameters those of the elements and of the circle of their centres?",
            Self::Clearance { .. } => "files have the clearance in um: the whole play from one side to the other",
            Self::Rating { .. } => {
                "files have it in kN; or state the rolling elements themselves: number, diameter and pitch circle"
            }
        }
    }
}
