//! Why the motion of a pair could not go on, or could not begin.

use std::convert::Infallible;

use dynamics::MapFailure;
use integrate::MotionError;
use ltca::StaticError;

use crate::GearboxError;

/// What often keeps a motion within reach of the contact search.
const SMALLER_STEPS: &str = "see the message; a smaller step often keeps the motion within reach of the contact search";

/// The motion of a pair could not go on, or what was asked of it has no meaning.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PairMotionError {
    /// The integrator stopped.
    #[error(transparent)]
    Integration(#[from] MotionError<Infallible>),
    /// Contact could not be solved.
    #[error("at {time:.9} s: {source}")]
    Contact {
        /// Time, s.
        time: f64,
        /// Error of the contact.
        source: StaticError,
    },
    /// There is no equilibrium to begin with.
    #[error(
        "at {time:.9} s: no equilibrium to begin with; the last step of the search was {step:.3e} of the displacements"
    )]
    NoStart {
        /// Time, s.
        time: f64,
        /// Last step, relative.
        step: f64,
    },
    /// A load below what round-off of places makes of the stiffness of teeth.
    #[error(
        "at {time:.9} s: a load of {load_n:.3e} N on the flanks is too light: round-off of places alone makes {lost_n:.3e} N of the stiffness of the teeth"
    )]
    LostLoad {
        /// Time, s.
        time: f64,
        /// Force of the load on the flanks, N.
        load_n: f64,
        /// Force that round-off makes, N.
        lost_n: f64,
    },
    /// Shooting with a driver whose speed is free.
    #[error("a driver that a torque turns has no period of its own: shooting needs a given speed")]
    FreeDriver,
    /// Shooting with normal modes that do not go over into each other from tooth to tooth.
    #[error(
        "shooting with normal modes needs gears that are known by sectors, whose teeth are all alike, and whole pairs of modes of one frequency"
    )]
    ModesWithoutPeriod,
    /// A sweep of a pair that a torque of its own drives.
    #[error(
        "a sweep prescribes the speed: the driver must be driven by speed, or by the torque that balances the load"
    )]
    SweepByTorque,
    /// The flanks have no maps.
    #[error(transparent)]
    Unmapped(#[from] MapFailure),
    /// The machine of the pair cannot be put together, or does not know where it is.
    #[error("{0}")]
    Machine(Box<GearboxError>),
}

impl PairMotionError {
    /// What went wrong at a time, s.
    pub fn at(time: f64) -> impl Fn(GearboxError) -> Self + Copy {
        move |source| match source {
            GearboxError::Contact(source) => Self::Contact { time, source },
            GearboxError::AtMesh { source, .. } => Self::at(time)(*source),
            GearboxError::Motion(source) => (*source).into(),
            GearboxError::NoEquilibrium { step, .. } => Self::NoStart { time, step },
            GearboxError::LostLoad { load_n, lost_n } => Self::LostLoad { time, load_n, lost_n },
            GearboxError::ModesWithoutPeriod { .. } => Self::ModesWithoutPeriod,
            other => Self::Machine(Box::new(other)),
        }
    }

    /// The error of the contact, where it is what stopped the motion.
    pub fn contact_error(&self) -> Option<&StaticError> {
        match self {
            Self::Contact { source, .. } => Some(source),
            _ => None,
        }
    }

    /// Hint: an action that cures the error.
    pub fn hint(&self) -> String {
        match self {
            Self::Integration(source) => source.hint().into(),
            Self::Contact { source, .. } => source.hint().unwrap_or_else(|| SMALLER_STEPS.into()),
            Self::NoStart { .. } => {
                "give bearings that hold the gears in mesh under the load (stiffnesses in N/mm and N mm/rad), and `flanks = \"both\"` where a torque presses the coast flanks".into()
            }
            Self::LostLoad { .. } => {
                "give a larger torque: teeth that bear next to nothing are not known well enough to move under it".into()
            }
            Self::FreeDriver | Self::ModesWithoutPeriod => {
                "wait for the motion to settle instead of shooting for its periodic state".into()
            }
            Self::Machine(source) => source.hint().unwrap_or_default(),
            Self::Unmapped(MapFailure::Map(_)) => "allow a larger error of the map, or use the model \"reduced\"".into(),
            Self::Unmapped(_) => "use the model \"reduced\", which solves the contact itself".into(),
            Self::SweepByTorque => "give the driver a speed, or let its torque balance the load".into(),
        }
    }
}

impl From<MotionError<GearboxError>> for PairMotionError {
    fn from(source: MotionError<GearboxError>) -> Self {
        match source.of_integrator() {
            Ok(own) => Self::Integration(own),
            Err((time, source)) => Self::at(time)(source),
        }
    }
}
