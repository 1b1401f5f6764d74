//! Extreme values of the flanks of a mesh in motion.

use serde::{Deserialize, Serialize};

/// Extreme values of the flanks of a mesh, updated at the end of every step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// Smallest normal force of a slice in contact, damping included, N; `None` before the first step in contact. A
    /// negative value would be a tensile force.
    pub least_force: Option<f64>,
    /// Largest sum of normal forces on the driving flanks, damping included, N.
    pub largest_force: f64,
    /// Largest gap between the driving flanks, the smallest over all pairs at each time, mm; 0 if contact was never
    /// lost at the end of a step.
    pub largest_gap: f64,
    /// Number of steps at whose end the driving flanks are not in contact.
    pub steps_apart: u64,
    /// Number of steps at whose end the coast flanks are in contact.
    pub steps_on_coast: u64,
}

impl Extremes {
    /// Adds the end of a step with the given overlaps of the undeformed flanks on the driving and on the coast side, mm
    /// along the normal; negative if they are apart.
    pub fn see(&mut self, [driving, coast]: [f64; 2]) {
        self.steps_apart += u64::from(driving <= 0.0);
        self.largest_gap = self.largest_gap.max(-driving);
        self.steps_on_coast += u64::from(coast > 0.0);
    }
}
