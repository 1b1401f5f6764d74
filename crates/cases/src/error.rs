//! What a plan may be wrong in.

/// A plan that has no cases, or none that could be told apart.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CasesError {
    /// An axis without values.
    #[error("axis {axis} has no values")]
    NoValues {
        /// Number of the axis, from 0.
        axis: usize,
    },
    /// A distribution whose numbers make none.
    #[error("axis {axis}: {what}")]
    NoDistribution {
        /// Number of the axis, from 0.
        axis: usize,
        /// What is wrong.
        what: &'static str,
    },
    /// More cases, samples or axes than can be taken.
    #[error("{what}: {asked}, {most} are taken at the most")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// How many.
        asked: u64,
        /// How many at the most.
        most: u64,
    },
}
