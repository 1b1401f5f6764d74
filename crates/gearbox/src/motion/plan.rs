//! How a motion is integrated, and what it waits for.

use integrate::{Periodicity, Scheme, Settle};

/// Difference after a period, over the peak to peak, from which on it is sought: the motion is on its way.
const SETTLING: f64 = 0.05;

/// How a motion is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPlan {
    /// Method.
    pub scheme: Scheme,
    /// Length of a step, s, the longest where a given speed changes: steps are then turns of the input that are alike.
    pub step: f64,
    /// Cycles of the fastest mesh with rows.
    pub cycles: u64,
    /// Steps a cycle of the fastest mesh.
    pub steps_per_cycle: u64,
    /// Steps a row.
    pub steps_per_row: u64,
    /// Local error of a step over the coordinates' scales; `None`: steps of equal length.
    pub tolerance: Option<f64>,
    /// Ends a step wherever contact is lost or gained.
    pub stop_at_events: bool,
    /// Settles first: to this difference over a common period of all meshes, in so many cycles at the most. Steps a row
    /// must divide those of a cycle.
    pub settle: Option<Settle>,
    /// Takes a motion that settles to its periodic state by Newton's method, as soon as it nearly repeats itself.
    pub shoots: bool,
}

impl MotionPlan {
    /// A motion from its start on in steps of equal length (s), each of which is a row: it neither settles nor stops.
    pub fn of_steps(scheme: Scheme, step: f64, [cycles, steps_per_cycle]: [u64; 2]) -> Self {
        let (steps_per_row, tolerance, stop_at_events, settle, shoots) = (1, None, false, None, false);
        Self { scheme, step, cycles, steps_per_cycle, steps_per_row, tolerance, stop_at_events, settle, shoots }
    }

    /// Difference after a period, over the peak to peak, that counts as none; 0 of a motion that does not settle.
    pub fn periodic_tolerance(&self) -> f64 {
        self.settle.map_or(0.0, |settle| settle.tolerance)
    }

    /// Whether a motion that repeats itself so nearly is to be taken to its periodic state at once.
    pub fn seeks(&self, found: Periodicity) -> bool {
        self.shoots && found.residual <= SETTLING
    }
}
