//! Why a motion could not go on.

/// A motion could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError<E> {
    /// The system's own trouble.
    #[error("at {time:.9} s: {source}")]
    Mechanism {
        /// Time, s.
        time: f64,
        /// What happened.
        source: E,
    },
    /// Newton's method did not settle within a step.
    #[error(
        "at {time:.9} s, step {step:.3e} s: no solution after {iterations} iterations, the last change {change:.3e} of the motion's scale"
    )]
    NotConverged {
        /// Time at the step's start, s.
        time: f64,
        /// Step, s.
        step: f64,
        /// Iterations.
        iterations: usize,
        /// Last change, relative.
        change: f64,
    },
    /// There is no equilibrium to begin with.
    #[error(
        "at {time:.9} s: no equilibrium to begin with; the last step of the search was {change:.3e} of the motion's scale"
    )]
    NoStart {
        /// Time, s.
        time: f64,
        /// Last change, relative.
        change: f64,
    },
    /// The error control asked for a step below the least one.
    #[error("at {time:.9} s: a step of {step:.3e} s is needed for the tolerance, the least allowed is {least:.3e} s")]
    StepTooSmall {
        /// Time, s.
        time: f64,
        /// Step asked for, s.
        step: f64,
        /// Least step, s.
        least: f64,
    },
    /// An explicit method is far from stable with steps of given length.
    #[error(
        "at {time:.9} s: the explicit method is stable with steps of up to {longest:.3e} s here, a step is {step:.3e} s"
    )]
    Unstable {
        /// Time, s.
        time: f64,
        /// Step, s.
        step: f64,
        /// Longest stable step, s.
        longest: f64,
    },
    /// A matrix that must be regular is not.
    #[error("at {time:.9} s: the {which} matrix is singular")]
    Singular {
        /// Time, s.
        time: f64,
        /// Which.
        which: &'static str,
    },
    /// Options that make no sense, or lengths that do not fit.
    #[error("{0}")]
    Options(&'static str),
    /// No period to shoot for.
    #[error("{0}")]
    NoPeriod(&'static str),
}

impl<E> MotionError<E> {
    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Mechanism { .. } => {
                "see the message; a smaller step often keeps the motion within reach of the contact search"
            }
            Self::NotConverged { .. } => {
                "take a smaller fixed step (`steps_per_mesh_cycle`), or let the error control choose it (`error_tolerance`)"
            }
            Self::NoStart { .. } => {
                "give bearings that hold the gears in mesh under the load (stiffnesses in N/mm and N mm/rad), and `flanks = \"both\"` where a torque presses the coast flanks"
            }
            Self::StepTooSmall { .. } => {
                "loosen the tolerance, allow smaller steps, or add damping where the motion is unstable"
            }
            Self::Unstable { .. } => {
                "take smaller steps (`steps_per_mesh_cycle`, `steps_per_resonance`), let an `error_tolerance` choose them, or take an implicit `method`"
            }
            Self::Singular { .. } => "every free coordinate needs mass, and stiffness or damping must not be infinite",
            Self::Options(_) => "correct the integrator's options",
            Self::NoPeriod(_) => "wait for the motion to settle instead of shooting for its periodic state",
        }
    }
}
