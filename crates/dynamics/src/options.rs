//! Options of a motion.

use serde::{Deserialize, Serialize};

use crate::{Bearing, RigidBody, Speed, Torque, body::COORDINATES};
use ltca::StaticOptions;

/// Drive of the pair: what is prescribed of the driver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Drive {
    /// The driver's angle is prescribed: its inertia counts as infinite.
    Speed(Speed),
    /// The speed of the common motion of both gears is prescribed (of the driver), their motion against each other is
    /// free: the driver's torque balances the load at every instant. Theory (45a).
    Balanced(Speed),
    /// The driver starts at a speed (rad/s), and a torque (N mm, in the running sense) acts on it.
    Torque {
        /// Speed at the start, rad/s.
        start: f64,
        /// Torque.
        torque: Torque,
    },
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
