//! What a rating cannot do.

/// A value without a rating, or a table that cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RatingError {
    /// A value for which a formula has no meaning.
    #[error("{quantity} is {value}, {clause} wants {allowed}")]
    OutOfRange {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// The value.
        value: f64,
        /// Standard and clause.
        clause: &'static str,
        /// What has a meaning.
        allowed: &'static str,
    },
    /// A table of materials, lubricants or loads that cannot be read.
    #[error("{what}")]
    Table {
        /// The row or line at fault, counted from 1; 0 where it is not known.
        line: usize,
        /// What is wrong with it.
        what: String,
    },
    /// A material without a number that a formula needs.
    #[error("the material \"{material}\" states no `{key}`, which {clause} needs")]
    MaterialLacks {
        /// Name of the material.
        material: String,
        /// The key of the table.
        key: &'static str,
        /// Standard and clause.
        clause: &'static str,
    },
    /// A lubricant without a number that a formula needs.
    #[error("the lubricant \"{lubricant}\" states no `{key}`, which {clause} needs")]
    LubricantLacks {
        /// Name of the lubricant.
        lubricant: String,
        /// The key of the table.
        key: &'static str,
        /// Standard and clause.
        clause: &'static str,
    },
}

/// A value that is positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64, clause: &'static str) -> Result<f64, RatingError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(RatingError::OutOfRange { quantity, value, clause, allowed: "a positive number" })
    }
}
