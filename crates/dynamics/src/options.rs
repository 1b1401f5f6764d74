//! Options of a motion.

use serde::{Deserialize, Serialize};

use crate::{Bearing, RigidBody, Speed, Torque, body::COORDINATES};
use ltca::StaticOptions;

/// Drive of the input in the running sense: the quantity that is prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Drive<T = Torque> {
    /// Prescribed speed of the input, rad/s, constant or with a ramp: its inertia counts as infinite.
    Speed(Speed),
    /// Prescribed speed of the rotation of the whole train, rad/s at the input. Deviations have no momentum along this
    /// rotation, and the torque of the input balances loads and losses at every instant. Theory (45a), (92a), (45b).
    Balanced(Speed),
    /// Prescribed torque on the input, with an initial speed.
    Torque {
        /// Initial speed, rad/s.
        start: f64,
        /// Torque on the input, N mm.
        torque: T,
    },
}

impl<T> Drive<T> {
    /// Speed of the input over time if it is given, otherwise the initial speed.
    #[inline]
    pub fn nominal(&self) -> Speed {
        match *self {
            Self::Speed(speed) | Self::Balanced(speed) => speed,
            Self::Torque { start, .. } => Speed::Constant(start),
        }
    }

    /// The drive with another speed, constant or initial, rad/s.
    #[must_use]
    pub fn at_speed(self, speed: f64) -> Self {
        match self {
            Self::Speed(_) => Self::Speed(Speed::Constant(speed)),
            Self::Balanced(_) => Self::Balanced(Speed::Constant(speed)),
            Self::Torque { torque, .. } => Self::Torque { start: speed, torque },
        }
    }
}

/// Damping of the mesh: a force on each slice in contact, proportional to the rate at which its flanks approach or
/// separate. It is limited by the slice's own force, so it never pulls.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum MeshDamping {
    /// Damping ratio zeta of the two gears vibrating against each other: c = 2 zeta sqrt(k_m m_e), distributed over the
    /// mean length of contact lines.
    Ratio(f64),
    /// Damping coefficient, N s/mm per mm of contact line.
    PerLength(f64),
}

/// Bodies, bearings and drives of a pair in motion; contact as in the static options.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionOptions {
    /// Driver, sense, contact, friction, window. Its torque is the reference for the initial state and for scales.
    pub statics: StaticOptions,
    /// Bodies of pinion and wheel.
    pub bodies: [RigidBody; 2],
    /// Bearings of both gears.
    pub bearings: [Bearing; 2],
    /// Free rigid coordinates of each gear. The driver's rotation is free if a torque drives, the driven gear's always.
    pub free: [[bool; COORDINATES]; 2],
    /// Drive of the driving gear.
    pub drive: Drive,
    /// Load torque on the driven gear against its rotation, N mm.
    pub load: Torque,
    /// Damping of the mesh.
    pub damping: MeshDamping,
    /// Mesh cycles at t = 0, where the run begins.
    pub start_cycles: f64,
}

impl MotionOptions {
    /// Mean of the load over time, N mm; for a table, the torque from which scales are taken.
    pub fn mean_load(&self) -> f64 {
        self.load.mean().unwrap_or(self.statics.torque)
    }
}
