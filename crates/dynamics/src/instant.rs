//! One instant of a motion.

use crate::Displacement;
use contact::SliceResult;
use ltca::FilletStress;

/// Quantities of one instant of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    /// Time, s.
    pub time: f64,
    /// Mesh cycles that the gears have turned since the start of counting.
    pub cycles: f64,
    /// Angular velocities of pinion and wheel about +z, rad/s.
    pub speeds: [f64; 2],
    /// Lag of the driven gear behind the nominal motion on its base circle, mm: the dynamic transmission error.
    pub transmission_error: f64,
    /// Rate of the transmission error, mm/s.
    pub transmission_error_rate: f64,
    /// Displacements of both gears.
    pub displacement: Displacement,
    /// Forces (N) and moments (N mm) of the mesh on both gears: normal, friction and damping.
    pub mesh: Displacement,
    /// Torque of the driver in the running sense, N mm: the given one, or the one that keeps the given speed.
    pub drive_torque: f64,
    /// Torque on the driven gear against its motion, N mm.
    pub load_torque: f64,
    /// Forces of the bearings on both gears.
    pub bearing: Displacement,
    /// Normal force of each pair of the window on the driving side, N, by running number from `first_pair` on; elastic
    /// part.
    pub pair_forces: Vec<f64>,
    /// Running number of the first pair of the window.
    pub first_pair: i64,
    /// Sum of normal forces on driving and coast flanks, damping included, N.
    pub normal_forces: [f64; 2],
    /// Total length of the contact lines on the driving side, mm.
    pub contact_line_length: f64,
    /// Largest pressure, MPa.
    pub max_pressure: f64,
    /// Tooth changes so far.
    pub tooth_changes: u64,
    /// Slices that carry load on the driving side, pair by pair, ascending in z; elastic part of the force.
    pub slices: Vec<LoadedSlice>,
    /// Stress in the root fillets of the window's teeth on pinion and wheel, of the elastic forces on the driving side;
    /// empty when not asked for ([`ltca::StaticOptions::root_stress`]).
    pub root_stress: [Vec<FilletStress>; 2],
}

/// A slice that carries load, with its pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedSlice {
    /// Running number of the tooth pair.
    pub pair: i64,
    /// Contact of the slice: place, line load, pressure.
    pub slice: SliceResult,
}
