//! Cost and resolution of a run-up: the torque of its acceleration, and how finely its order cuts resolve a resonance.

use answer::Remark;
use dynamics::Speed;
use study::CutPeak;

use crate::remark;

/// Share of the load from which on the torque of an acceleration is told.
const SHARE: f64 = 0.1;
/// Points that a resonance has to have in an order cut.
const POINTS: usize = 10;
/// Largest slope of the smooth step 3 x^2 - 2 x^3.
const STEEPEST: f64 = 1.5;

/// Torques of a speed ramp, at the gear or shaft to which inertia and load are referred.
///
/// ```text
/// T_J = 3/2 J |omega_2 - omega_1| / T
/// ```
/// This is the maximum for the smooth step 3 x^2 - 2 x^3 over its duration T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunUpTorque {
    /// Duration of the ramp, s.
    pub duration: f64,
    /// Largest torque that accelerates the inertia, N mm, not negative.
    pub inertia: f64,
    /// Torque of the loads, N mm, not negative.
    pub load: f64,
}

impl RunUpTorque {
    /// Torque of a ramp on an inertia (t mm^2) that turns `ratio` times as fast as what has the ramp, beside the load there
    /// (N mm); `None` for a constant speed.
    pub(crate) fn new(speed: Speed, (inertia, ratio): (f64, f64), load: f64) -> Option<Self> {
        let Speed::Ramp { from, to, duration, .. } = speed else { return None };
        let acceleration = STEEPEST * (to - from).abs() / duration;
        Some(Self { duration, inertia: inertia * ratio.abs() * acceleration, load: load.abs() })
    }

    /// Remark where the acceleration takes a tenth of the load or more; `place`: where the torques act, `cure`: what makes
    /// the ramp gentler.
    pub(crate) fn remark(&self, place: &str, cure: &str) -> Option<Remark> {
        let share = self.inertia / self.load;
        let [inertia_nm, load_nm] = [self.inertia, self.load].map(|torque| 1e-3 * torque);
        (share >= SHARE).then(|| remark::run_up_torque(self.duration, inertia_nm, place, 100.0 * share, load_nm, cure))
    }
}

/// Remark on a peak that too few points of the cut of an order show, with its speed (1/min).
pub(crate) fn coarse_cut(peak: CutPeak, order: usize, speed_rpm: f64, cure: &str) -> Option<Remark> {
    let times = POINTS as f64 / peak.points.max(1) as f64;
    (peak.points < POINTS).then(|| remark::coarse_order_cut(peak.points, order, speed_rpm, POINTS, times, cure))
}

#[cfg(test)]
#[path = "../tests/units/run_up.rs"]
mod tests;
