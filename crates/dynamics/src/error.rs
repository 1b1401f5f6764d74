//! Why the motion of a pair could not go on, or could not begin.

use integrate::MotionError;
use ltca::StaticError;

use crate::MapFailure;

/// The motion of a pair could not go on, or what was asked of it has no meaning.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PairMotionError {
    /// The integrator stopped: for a reason of its own, or because contact could not be solved.
    #[error(transparent)]
    Integration(#[from] MotionError<StaticError>),
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
}

impl PairMotionError {
    /// Contact at time `time` (s) that could not be solved.
    pub fn contact(time: f64, source: StaticError) -> Self {
        Self::Integration(MotionError::Mechanism { time, source })
    }

    /// The error of the contact, where it is what stopped the motion.
    pub fn contact_error(&self) -> Option<&StaticError> {
        match self {
            Self::Integration(MotionError::Mechanism { source, .. }) => Some(source),
            _ => None,
        }
    }

    /// Hint: an action that cures the error.
    pub fn hint(&self) -> String {
        match self {
            Self::Integration(source) => {
                self.contact_error().and_then(StaticError::hint).unwrap_or_else(|| source.hint().into())
            }
            Self::NoStart { .. } => {
                "give bearings that hold the gears in mesh under the load (stiffnesses in N/mm and N mm/rad), and `flanks = \"both\"` where a torque presses the coast flanks".into()
            }
            Self::LostLoad { .. } => {
                "give a larger torque: teeth that bear next to nothing are not known well enough to move under it".into()
            }
            Self::FreeDriver | Self::ModesWithoutPeriod => {
                "wait for the motion to settle instead of shooting for its periodic state".into()
            }
            Self::Unmapped(MapFailure::Map(_)) => "allow a larger error of the map, or use the model \"reduced\"".into(),
            Self::Unmapped(_) => "use the model \"reduced\", which solves the contact itself".into(),
            Self::SweepByTorque => "give the driver a speed, or let its torque balance the load".into(),
        }
    }
}
