//! State of the flanks at an instant of a motion.

use contact::SliceResult;
use ltca::FilletStress;

/// State of the flanks of one side at an instant; all zero for flanks that the model does not have.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlankInstant {
    /// Sum of the normal forces, N, without damping.
    pub force: f64,
    /// Damping force along the approach, N.
    pub damping: f64,
    /// Length of the loaded contact lines, mm; 0 for flanks without contact lines.
    pub line_length: f64,
    /// Normal force of each pair of the window, N, by running number starting at `first_pair`, without damping; empty
    /// for flanks without single pairs.
    pub pair_forces: Vec<f64>,
    /// Running number of the first pair of the window.
    pub first_pair: i64,
    /// Slices that carry load, pair by pair, ascending in z, without damping; empty for flanks without slices.
    pub slices: Vec<LoadedSlice>,
    /// Number of tooth changes so far.
    pub tooth_changes: u64,
    /// Stress in the root fillets of the window's teeth on gear 1 and gear 2 under the forces of the driving flanks,
    /// without damping; empty if not requested ([`ltca::StaticOptions::root_stress`]).
    pub root_stress: [Vec<FilletStress>; 2],
}

impl FlankInstant {
    /// Sum of the normal forces, damping included, N.
    pub fn normal_force(&self) -> f64 {
        self.force + self.damping
    }

    /// Largest pressure, MPa.
    pub fn max_pressure(&self) -> f64 {
        self.slices.iter().fold(0.0, |m: f64, s| m.max(s.slice.pressure))
    }
}

/// A slice that carries load, with its pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedSlice {
    /// Running number of the tooth pair.
    pub pair: i64,
    /// Contact of the slice: position, line load, pressure.
    pub slice: SliceResult,
}
