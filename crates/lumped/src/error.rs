//! Errors of the lumped models.

/// Why a lumped model cannot be set up.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LumpedError {
    /// An input is outside of what the formula is stated for.
    #[error("{quantity} = {value} is outside the range of {method}: {allowed}")]
    OutOfRange {
        /// Name of the input.
        quantity: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The method.
        method: &'static str,
        /// Range that the method allows.
        allowed: &'static str,
    },
    /// A mass, an inertia, a stiffness or a length that must be there is not.
    #[error("{quantity} = {value} must be above 0")]
    NotPositive {
        /// Name and unit of the input.
        quantity: &'static str,
        /// Value of the quantity, or the least of a series.
        value: f64,
    },
    /// A value that may be zero but not less.
    #[error("{quantity} = {value} must be 0 or above")]
    Negative {
        /// Name and unit of the input.
        quantity: &'static str,
        /// Value of the quantity.
        value: f64,
    },
    /// A value is NaN or infinite.
    #[error("{quantity}: number {index} is {value}, not a finite number")]
    NotFinite {
        /// Name and unit of the input.
        quantity: &'static str,
        /// Index of the number, from 0.
        index: usize,
        /// Value found.
        value: f64,
    },
    /// No samples where some are needed.
    #[error("{quantity}: no samples")]
    Empty {
        /// Name and unit of the input.
        quantity: &'static str,
    },
    /// Samples of one mesh cycle that do not belong together.
    #[error("{quantity}: {found} samples where {wanted} are wanted")]
    Lengths {
        /// Name and unit of the input.
        quantity: &'static str,
        /// Samples given.
        found: usize,
        /// Samples of the others.
        wanted: usize,
    },
    /// A shaft, its sections or its material make no sense.
    #[error(transparent)]
    Beam(#[from] fem::FemError),
    /// Something sits beside the shaft.
    #[error("{position_mm} mm is not on a shaft of {length_mm} mm")]
    OffShaft {
        /// Position, mm.
        position_mm: f64,
        /// Length of the shaft, mm.
        length_mm: f64,
    },
    /// Two stations at one place.
    #[error("shaft {shaft} has two stations at {position_mm} mm")]
    SameStation {
        /// Shaft, from 0.
        shaft: usize,
        /// Position, mm.
        position_mm: f64,
    },
    /// A station that is named and not there.
    #[error("there is no station {station} on shaft {shaft} (both count from 0)")]
    NoStation {
        /// Shaft, from 0.
        shaft: usize,
        /// Station, from 0.
        station: usize,
    },
    /// A shaft that no chain of meshes joins to shaft 0.
    #[error("no mesh connects shaft {shaft} with shaft 0")]
    NotConnected {
        /// Shaft, from 0.
        shaft: usize,
    },
    /// Chains of meshes that ask for different speeds of one shaft.
    #[error("the meshes give shaft {shaft} two speeds: {} and {} times that of shaft 0", ratios[0], ratios[1])]
    Ratios {
        /// Shaft, from 0.
        shaft: usize,
        /// Speed ratios to shaft 0 by both ways.
        ratios: [f64; 2],
    },
    /// What is left out of the coordinates of a shaft would move freely.
    #[error("shaft {shaft}: coordinates that are left out can move freely")]
    Free {
        /// Shaft, from 0.
        shaft: usize,
    },
    /// A shaft that can move as a whole.
    #[error("nothing holds shaft {shaft} {motion}")]
    Loose {
        /// Shaft, from 0.
        shaft: usize,
        /// Direction in which the shaft can move.
        motion: &'static str,
    },
    /// Torques that would set freely turning shafts going.
    #[error("torques are not in balance: {torque} N mm are left over, seen from shaft 0")]
    NotBalanced {
        /// Torque that is not balanced, N mm.
        torque: f64,
    },
    /// Contact or displacements under steady loads were not found.
    #[error("no static equilibrium: something is free to move, or contact does not settle")]
    NoEquilibrium,
    /// A driver whose torque balances the load needs elastic teeth.
    #[error("rigid gears are driven by a speed or by a torque of its own")]
    BalancedDrive,
}

impl LumpedError {
    /// Hint for the user: what to do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::OutOfRange { .. } => {
                "bring it into that range, or use `model = \"reduced\"`, which has no such limits".into()
            }
            Self::NotPositive { quantity, .. } => format!("give a positive {quantity}"),
            Self::Negative { quantity, .. } => format!("give 0 or a positive {quantity}"),
            Self::NotFinite { quantity, .. } => format!("look at where {quantity} comes from: it was not computed"),
            Self::Empty { .. } => "give at least one sample of the mesh cycle".into(),
            Self::Beam(source) => return source.hint(),
            Self::OffShaft { .. } => "positions count from the beginning of the shaft's first segment".into(),
            Self::SameStation { .. } => "put both masses into one station".into(),
            Self::NoStation { .. } => "count them from 0, in the order in which they are given".into(),
            Self::NotConnected { .. } => "add the mesh that drives it, or leave the shaft out".into(),
            Self::Ratios { .. } => "numbers of teeth around a closed train must agree".into(),
            Self::Free { .. } => "give the shaft two supports and a thrust bearing, or keep the coordinate".into(),
            Self::Loose { motion, .. } => {
                let needed = match *motion {
                    "along x" => "a stiffness along x at two places",
                    "along y" => "a stiffness along y at two places",
                    "along z" => "a stiffness along z at one place, because helical teeth push along the axis",
                    "tilting about x" => "a stiffness along y at a second place, or one about x",
                    _ => "a stiffness along x at a second place, or one about y",
                };
                format!(
                    "its supports need {needed} (shaft 0 is the pinion's, shaft 1 the wheel's: `[[pinion.shaft.supports]]`)"
                )
            }
            Self::NotBalanced { .. } => {
                "torques times speed ratios must add up to zero, or one shaft must be held in turning".into()
            }
            Self::NoEquilibrium => {
                "is every shaft held in x, y, z and against tilting, and is every stiffness in its unit?".into()
            }
            Self::BalancedDrive => "give the driver a speed, or a torque of its own".into(),
            Self::Lengths { .. } => "sample every quantity at the same phases of the mesh cycle".into(),
        })
    }
}

/// `value` is a number above 0.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<(), LumpedError> {
    finite(quantity, value)?;
    if value > 0.0 { Ok(()) } else { Err(LumpedError::NotPositive { quantity, value }) }
}

/// `value` is a number, 0 or above.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<(), LumpedError> {
    finite(quantity, value)?;
    if value >= 0.0 { Ok(()) } else { Err(LumpedError::Negative { quantity, value }) }
}

/// `value` is a number.
pub(crate) fn finite(quantity: &'static str, value: f64) -> Result<(), LumpedError> {
    if value.is_finite() { Ok(()) } else { Err(LumpedError::NotFinite { quantity, index: 0, value }) }
}
