//! Why there is no map.

/// No map of the contact was made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError<E> {
    /// The contact itself could not be solved.
    #[error("at phase {phase:.6}, approach {approach_um:.4} um: {source}")]
    Contact {
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Approach along the normal, um.
        approach_um: f64,
        /// Error of the contact.
        source: E,
    },
    /// No approach was found at which the mesh presses with a force.
    #[error("at phase {phase:.6}: no approach gives {force_n:.6} N, the nearest {found_n:.6} N")]
    NoApproach {
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Wanted, N.
        force_n: f64,
        /// Last found, N.
        found_n: f64,
    },
    /// The approach does not grow with the force.
    #[error("at phase {phase:.6}: the approach does not grow from {force_n:.6} N to the next force of the map")]
    NotMonotonic {
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Force, N.
        force_n: f64,
    },
    /// The map is off by more than was allowed.
    #[error(
        "a map of {phases} phases and {loads} forces is off by {error:.1e} of the mean approach, allowed is {allowed:.1e}"
    )]
    Coarse {
        /// Phases of the finest map.
        phases: usize,
        /// Forces of the finest map.
        loads: usize,
        /// Error of the map, relative.
        error: f64,
        /// Largest error allowed, relative.
        allowed: f64,
    },
    /// A request without meaning.
    #[error("{name} = {value} must be {expected}")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The permitted range.
        expected: &'static str,
    },
}
