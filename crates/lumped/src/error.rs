//! What a lumped model refuses.

/// Why a lumped model cannot be set up.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LumpedError {
    /// An input is outside of what the formula is stated for.
    #[error("{quantity} = {value} is outside of what {method} is stated for: {allowed}")]
    OutOfRange {
        /// Name of the input.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The method.
        method: &'static str,
        /// What it allows.
        allowed: &'static str,
    },
    /// A mass, an inertia, a stiffness or a length that must be there is not.
    #[error("{quantity} = {value} must be above 0")]
    NotPositive {
        /// Name and unit of the input.
        quantity: &'static str,
        /// Its value, or the least of a series.
        value: f64,
    },
    /// A value that may be zero but not less.
    #[error("{quantity} = {value} must be 0 or above")]
    Negative {
        /// Name and unit of the input.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A value is NaN or infinite.
    #[error("{quantity}: number {index} is {value}, not a finite number")]
    NotFinite {
        /// Name and unit of the input.
        quantity: &'static str,
        /// Which number of it, from 0.
        index: usize,
        /// What stands there.
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
}

impl LumpedError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::OutOfRange { .. } => "use `model = \"reduced\"` for this pair: it has no such limits".into(),
            Self::NotPositive { quantity, .. } => format!("give a positive {quantity}"),
            Self::Negative { quantity, .. } => format!("give 0 or a positive {quantity}"),
            Self::NotFinite { quantity, .. } => format!("look at where {quantity} comes from: it was not computed"),
            Self::Empty { .. } => "give at least one sample of the mesh cycle".into(),
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
