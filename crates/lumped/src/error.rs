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
}

impl LumpedError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::OutOfRange { .. } => Some("use `model = \"reduced\"` for this pair: it has no such limits".into()),
        }
    }
}
