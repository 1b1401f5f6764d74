//! Flanks at an instant of a motion.

use contact::SliceResult;
use ltca::FilletStress;

/// The flanks of one side at an instant; all zero of flanks that are not there.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlankInstant {
    /// Sum of the normal forces, N, without damping.
    pub force: f64,
    /// Damping along the approach, N.
    pub damping: f64,
    /// Length of the loaded contact lines, mm; 0 of flanks that know none.
    pub line_length: f64,
    /// Normal force of each pair of the window, N, by running number from `first_pair` on, without damping; empty of flanks
    /// that know no pairs.
    pub pair_forces: Vec<f64>,
    /// Running number of the first pair of the window.
    pub first_pair: i64,
    /// Slices that carry load, pair by pair, ascending in z, without damping; empty of flanks that know none.
    pub slices: Vec<LoadedSlice>,
    /// Tooth changes so far.
    pub tooth_changes: u64,
    /// Stress in the root fillets of the window's teeth on gear 1 and gear 2 under the forces without damping, of the
    /// driving flanks; empty when not asked for ([`ltca::StaticOptions::root_stress`]).
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
    /// Contact of the slice: place, line load, pressure.
    pub slice: SliceResult,
}
