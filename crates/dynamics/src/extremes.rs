//! Extreme values of the flanks of a mesh in motion.

use serde::{Deserialize, Serialize};

/// Extreme values of the flanks of a mesh, updated at the end of every step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// Least normal force of a slice in contact, damping included, N; none before the first step in contact. Below 0 a
    /// flank would pull.
    pub least_force: Option<f64>,
    /// Largest sum of normal forces on the driving flanks, damping included, N.
    pub largest_force: f64,
    /// Largest gap between the driving flanks of all pairs, mm; 0 when contact was never lost at the end of a step.
    pub largest_gap: f64,
    /// Steps whose end has no contact on the driving flanks.
    pub steps_apart: u64,
    /// Steps whose end has contact on the coast flanks.
    pub steps_on_coast: u64,
}

impl Extremes {
    /// Adds the end of a step at which the undeformed flanks overlap by so much on the driving and on the coast side, mm along
    /// the normal; negative where they are apart.
    pub fn see(&mut self, [driving, coast]: [f64; 2]) {
        self.steps_apart += u64::from(driving <= 0.0);
        self.largest_gap = self.largest_gap.max(-driving);
        self.steps_on_coast += u64::from(coast > 0.0);
    }
}
