//! Integration of a motion, and the criterion for its steady state.

use integrate::{Periodicity, Scheme, Settle};
use nalgebra::DVector;

use super::{CycleSteps, MotionTimes};

/// Difference after a period, over the peak to peak, from which on it is sought: the motion is on its way.
const SETTLING: f64 = 0.05;

/// How a motion is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPlan {
    /// Integration method.
    pub scheme: Scheme,
    /// Cycles of the fastest mesh with rows.
    pub cycles: u64,
    /// Steps per cycle of the fastest mesh, at equal rotations of the input.
    pub steps_per_cycle: u64,
    /// Steps per row.
    pub steps_per_row: u64,
    /// Tolerance for the local error of a step, relative to the scales of the coordinates; `None`: steps of equal
    /// length.
    pub tolerance: Option<f64>,
    /// Whether a step ends wherever contact is lost or gained.
    pub stop_at_events: bool,
    /// Settling before the rows: to this difference over a common period of all meshes, in at most this number of
    /// cycles. The steps per row must divide those per cycle.
    pub settle: Option<Settle>,
    /// Whether a settling motion is brought to its periodic state by Newton's method as soon as it nearly repeats.
    pub shoots: bool,
}

impl MotionPlan {
    /// Cycles of the motion, with the magnitudes of its coordinates. Without settling its last step is a row.
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

    /// Difference over a period, relative to the peak to peak, that counts as periodic; 0 for a motion that does not
    /// settle.
    pub fn periodic_tolerance(&self) -> f64 {
        self.settle.map_or(0.0, |settle| settle.tolerance)
    }

    /// Whether a motion with this periodicity is to be brought to its periodic state immediately.
    pub fn seeks(&self, found: Periodicity) -> bool {
        self.shoots && found.residual <= SETTLING
    }
}
