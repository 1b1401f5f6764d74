//! Why no periodic motion was found.

/// No periodic motion was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PeriodicError<E> {
    /// The system's own trouble.
    #[error("at parameter {parameter}, phase {phase:.6} of the period: {source}")]
    Mechanism {
        /// Value of the parameter.
        parameter: f64,
        /// Part of the period, 0 .. 1.
        phase: f64,
        /// Error of the system.
        source: E,
    },
    /// Newton's method did not settle.
    #[error(
        "at parameter {parameter}: no periodic motion after {iterations} Newton steps with {harmonics} harmonics, \
         forces are out of balance by {residual:.1e} of themselves"
    )]
    NotConverged {
        /// Value of the parameter.
        parameter: f64,
        /// Newton steps.
        iterations: usize,
        /// Harmonics.
        harmonics: usize,
        /// Residual, relative.
        residual: f64,
    },
    /// The equations have no unique solution there.
    #[error("at parameter {parameter}: the equations of the periodic motion are singular")]
    Singular {
        /// Value of the parameter.
        parameter: f64,
    },
    /// The harmonics allowed do not represent the motion.
    #[error(
        "at parameter {parameter}: {harmonics} harmonics leave {tail:.1e} of the forces out, allowed is {allowed:.1e}"
    )]
    Harmonics {
        /// Value of the parameter.
        parameter: f64,
        /// Largest number allowed.
        harmonics: usize,
        /// Tail that the harmonics leave out, relative.
        tail: f64,
        /// Largest tail allowed.
        allowed: f64,
    },
    /// An option without meaning.
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
