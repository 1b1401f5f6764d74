//! Options of a motion.

use serde::{Deserialize, Serialize};

use crate::{Bearing, RigidBody, Speed, Torque, body::COORDINATES};
use ltca::StaticOptions;

/// Drive of the input, in the running sense: what is prescribed of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Drive<T = Torque> {
    /// Prescribed speed of the input, rad/s, constant or from one to another: its inertia counts as infinite.
    Speed(Speed),
    /// Prescribed speed of the turn of the whole train, rad/s at the input: deviations have no momentum along it, and the
    /// torque of the input balances loads and losses at every instant. Theory (45a), (92a), (45b).
    Balanced(Speed),
    /// A torque on the input, which starts at a speed.
    Torque {
        /// Speed at the start, rad/s.
        start: f64,
        /// Torque, N mm.
        torque: T,
    },
}

impl<T> Drive<T> {
    /// Speed of the input by time where it is given, else that of the start.
    #[inline]
    pub fn nominal(&self) -> Speed {
        match *self {
            Self::Speed(speed) | Self::Balanced(speed) => speed,
            Self::Torque { start, .. } => Speed::Constant(start),
        }
    }

    /// The drive at another speed, constant or of the start, rad/s.
    #[must_use]
    pub fn at_speed(self, speed: f64) -> Self {
        match self {
            Self::Speed(_) => Self::Speed(Speed::Constant(speed)),
            Self::Balanced(_) => Self::Balanced(Speed::Constant(speed)),
            Self::Torque { torque, .. } => Self::Torque { start: speed, torque },
        }
    }
}

/// Damping of the mesh: a force on each slice in contact against the rate at which its flanks approach or part, at most
/// the slice's own force: never a pull.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum MeshDamping {
    /// Damping ratio zeta of the two gears turning against each other: c = 2 zeta sqrt(k_m m_e), shared over the mean
    /// length of contact lines.
    Ratio(f64),
    /// N s/mm per mm of contact line.
    PerLength(f64),
}

/// Bodies, bearings, drives of a pair in motion; contact as in the static options.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionOptions {
    /// Driver, sense, contact, friction, window. Its torque is the reference for start and scales.
    pub statics: StaticOptions,
    /// Pinion and wheel.
    pub bodies: [RigidBody; 2],
    /// Bearings of both gears.
    pub bearings: [Bearing; 2],
    /// Which rigid coordinates of each gear are free; the driver's turn is when a torque drives, the driven gear's
    /// always.
    pub free: [[bool; COORDINATES]; 2],
    /// Driver.
    pub drive: Drive,
    /// Load torque on the driven gear against its turn, N mm.
    pub load: Torque,
    /// Mesh damping.
    pub damping: MeshDamping,
    /// Mesh cycles at t = 0: where the run begins.
    pub start_cycles: f64,
}

impl MotionOptions {
    /// Mean of the load over time, N mm: of a table, which has none of its own, the torque that scales are taken from.
    pub fn mean_load(&self) -> f64 {
        self.load.mean().unwrap_or(self.statics.torque)
    }
}
