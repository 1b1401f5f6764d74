//! Errors of a motion.

/// A motion cannot continue.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError<E> {
    /// Error of the mechanism itself.
    #[error("at {time:.9} s: {source}")]
    Mechanism {
        /// Time, s.
        time: f64,
        /// Error of the mechanism.
        source: E,
    },
    /// Newton's method did not converge within a step.
    #[error(
        "at {time:.9} s, step {step:.3e} s: no solution after {iterations} iterations, the last change {change:.3e} of the motion's scale"
    )]
    NotConverged {
        /// Time at the step's start, s.
        time: f64,
        /// Step, s.
        step: f64,
        /// Number of iterations.
        iterations: usize,
        /// Last relative change.
        change: f64,
    },
    /// The error control requires a step below the least permitted one.
    #[error("at {time:.9} s: a step of {step:.3e} s is needed for the tolerance, the least allowed is {least:.3e} s")]
    StepTooSmall {
        /// Time, s.
        time: f64,
        /// Step required, s.
        step: f64,
        /// Least permitted step, s.
        least: f64,
    },
    /// The error control continues with steps that are far shorter than the motion requires.
    #[error(
        "at {time:.9} s: {steps} steps of {step:.3e} s in the mean bring the motion hardly on: rows ask for steps of {largest:.3e} s"
    )]
    Crawls {
        /// Time, s.
        time: f64,
        /// Number of steps since the last row.
        steps: u64,
        /// Mean length of these steps, s.
        step: f64,
        /// Largest permitted step, s.
        largest: f64,
    },
    /// An explicit method is far from stable with steps of the given length.
    #[error(
        "at {time:.9} s: the explicit method is stable with steps of up to {longest:.3e} s here, a step is {step:.3e} s"
    )]
    Unstable {
        /// Time, s.
        time: f64,
        /// Step length, s.
        step: f64,
        /// Longest stable step, s.
        longest: f64,
    },
    /// A matrix that must be regular is singular.
    #[error("at {time:.9} s: the {which} matrix is singular")]
    Singular {
        /// Time, s.
        time: f64,
        /// Name of the matrix.
        which: &'static str,
    },
    /// Mass matrix, scale and state have different lengths.
    #[error(
        "mass, scale and state are of different lengths: {mass}, {scale}, and {coordinates} coordinates with {velocities} velocities"
    )]
    Lengths {
        /// Number of rows of the mass matrix.
        mass: usize,
        /// Number of entries of the scale.
        scale: usize,
        /// Number of coordinates of the state.
        coordinates: usize,
        /// Number of velocities of the state.
        velocities: usize,
    },
    /// A step, tolerance, scale or count is not positive.
    #[error("{name} = {value} must be positive")]
    NotPositive {
        /// Name of the quantity.
        name: &'static str,
        /// Value of the quantity.
        value: f64,
    },
    /// The motion stops before the end of a cycle.
    #[error("the rotation stops before cycle {cycle} is complete")]
    StandsStill {
        /// Cycle, counted from the start of the motion.
        cycle: u64,
    },
    /// A checkpoint has another number of coordinates than the motion.
    #[error(
        "the checkpoint belongs to a motion with other free coordinates: it has {checkpoint}, this motion has {motion}"
    )]
    OtherCoordinates {
        /// Number of coordinates in the checkpoint.
        checkpoint: usize,
        /// Number of coordinates of the motion.
        motion: usize,
    },
    /// A spectral radius outside the range of generalised-alpha.
    #[error("the spectral radius of generalised-alpha lies between 0 and 1, not at {rho}")]
    SpectralRadius {
        /// The radius given.
        rho: f64,
    },
}

impl<E> MotionError<E> {
    /// Hint: an action that cures the error.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Mechanism { .. } => "take smaller steps: raise the number of steps per cycle",
            Self::NotConverged { .. } => {
                "take a smaller fixed step (`steps_per_mesh_cycle`, of a gearbox `steps_per_cycle`), or let the error control choose it (`error_tolerance`)"
            }
            Self::StepTooSmall { .. } => {
                "loosen the tolerance, allow smaller steps, or add damping where the motion is unstable"
            }
            Self::Crawls { .. } => {
                "loosen the `error_tolerance`; take an implicit `method` where bearings, dampers or friction are stiff; solve statics where the gears hardly turn"
            }
            Self::Unstable { .. } => {
                "take smaller steps (`steps_per_mesh_cycle`, `steps_per_resonance`; of a gearbox `steps_per_cycle`), let an `error_tolerance` choose them, or take an implicit `method`"
            }
            Self::Singular { .. } => "every free coordinate needs mass, and stiffness or damping must not be infinite",
            Self::Lengths { .. } => "give one scale, one coordinate and one velocity for each row of the mass matrix",
            Self::NotPositive { .. } => "give a positive number",
            Self::StandsStill { .. } => "ask for fewer mesh cycles, or let the speed end above zero",
            Self::OtherCoordinates { .. } => "go on with the scene that the checkpoint was written for",
            Self::SpectralRadius { .. } => "give `spectral_radius` a number from 0 to 1",
        }
    }
}
