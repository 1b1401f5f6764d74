//! How a motion is integrated, and what it waits for.

use integrate::{Periodicity, Scheme, Settle};
use nalgebra::DVector;

use super::{CycleSteps, MotionTimes};

/// Difference after a period, over the peak to peak, from which on it is sought: the motion is on its way.
const SETTLING: f64 = 0.05;

/// How a motion is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPlan {
    /// Method.
    pub scheme: Scheme,
    /// Cycles of the fastest mesh with rows.
    pub cycles: u64,
    /// Steps a cycle of the fastest mesh: turns of the input that are alike.
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
    /// Cycles of the motion, with the sizes of its coordinates. Without settling its last step is a row.
    pub fn times(&self, scale: DVector<f64>) -> MotionTimes {
        let Self { scheme, tolerance, stop_at_events, steps_per_cycle: per_cycle, steps_per_row: per_row, .. } = *self;
        let last = self.settle.is_none().then(|| self.cycles.saturating_mul(per_cycle));
        MotionTimes {
            scheme,
            steps: CycleSteps::Counted { per_cycle, per_row, last },
            tolerance,
            stop_at_events,
            scale,
        }
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
