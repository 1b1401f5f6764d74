//! Errors of maps.

/// No map of the contact was made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError<E> {
    /// The contact itself cannot be solved.
    #[error("at phase {phase:.6}, approach {approach_um:.4} um: {source}")]
    Contact {
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Approach along the normal, um.
        approach_um: f64,
        /// Error of the contact.
        source: E,
    },
    /// No approach was found at which the mesh has a given force.
    #[error("at phase {phase:.6}: no approach gives {force_n:.6} N, the nearest {found_n:.6} N")]
    NoApproach {
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Force wanted, N.
        force_n: f64,
        /// Last force found, N.
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
    /// The error of the map exceeds the permitted error.
    #[error(
        "a map of {phases} phases and {loads} forces is off by {error:.1e} of the mean approach, allowed is {allowed:.1e}"
    )]
    Coarse {
        /// Number of phases of the finest map.
        phases: usize,
        /// Number of forces of the finest map.
        loads: usize,
        /// Relative error of the map.
        error: f64,
        /// Largest permitted relative error.
        allowed: f64,
    },
    /// A value in the request is out of range.
    #[error("{name} = {value} must be {expected}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The permitted range.
        expected: &'static str,
    },
}
