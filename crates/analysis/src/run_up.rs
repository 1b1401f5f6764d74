//! What a run-up costs and shows: the torque that its acceleration takes, and how finely its order cuts see a resonance.

use std::f64::consts::FRAC_1_SQRT_2;

use answer::Remark;
use dynamics::Speed;

use crate::remark;

/// Share of the load from which on the torque of an acceleration is told.
const SHARE: f64 = 0.1;
/// Points that a resonance has to have in an order cut.
const POINTS: usize = 10;
/// Largest slope of the smooth step 3 x^2 - 2 x^3.
const STEEPEST: f64 = 1.5;

/// What the acceleration of a ramp of speed takes, at the gear or shaft whose inertia and load are meant.
///
/// ```text
/// T_J = 3/2 J |omega_2 - omega_1| / T
/// ```
/// the largest of the smooth step 3 x^2 - 2 x^3 over its duration T.
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

/// A resonance in an order cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CutPeak {
    /// Place of the largest amplitude.
    pub at: usize,
    /// Points in a row about it with half of its power or more.
    pub points: usize,
}

/// The largest amplitude of an order cut and the points across it; `None` where the cut does not fall to half of its power
/// on both sides, so that it shows no whole peak.
pub(crate) fn cut_peak(amplitudes: &[f64]) -> Option<CutPeak> {
    let at = (0..amplitudes.len()).max_by(|&a, &b| amplitudes[a].total_cmp(&amplitudes[b]))?;
    let below = |x: &f64| *x < FRAC_1_SQRT_2 * amplitudes[at];
    let first = amplitudes[..at].iter().rposition(below)?;
    let last = at + amplitudes[at..].iter().position(below)?;
    Some(CutPeak { at, points: last - first - 1 })
}

/// Remark on a peak that too few points of the cut of an order show, with its speed (1/min).
pub(crate) fn coarse_cut(peak: CutPeak, order: usize, speed_rpm: f64, cure: &str) -> Option<Remark> {
    let times = POINTS as f64 / peak.points.max(1) as f64;
    (peak.points < POINTS).then(|| remark::coarse_order_cut(peak.points, order, speed_rpm, POINTS, times, cure))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A resonance of 2 % damping in a cut whose points are 1/256 of its frequency apart has 4 % of it across: ten points.
    /// A flank alone, and a level, are no peak.
    #[test]
    fn points_across_a_peak_are_those_of_half_its_power() {
        let gain = |r: f64| ((1.0 - r * r).powi(2) + (0.04 * r).powi(2)).sqrt().recip();
        let cut: Vec<f64> = (128..512).map(|i| gain(f64::from(i) / 256.0)).collect();
        let CutPeak { at, points } = cut_peak(&cut).unwrap();
        assert!((127..=128).contains(&at) && (10..=11).contains(&points), "{points} points about {at}");
        assert_eq!(cut_peak(&cut[..129]), None, "a flank is no peak");
        assert_eq!(cut_peak(&[1.0; 20]), None, "a level is no peak");
        assert_eq!(cut_peak(&[]), None);
    }

    /// The torque is J times the largest acceleration of the ramp itself.
    #[test]
    fn the_torque_of_a_ramp_is_its_largest_acceleration_on_the_inertia() {
        let speed = Speed::Ramp { from: 50.0, to: 250.0, start: 0.5, duration: 4.0 };
        let torque = RunUpTorque::new(speed, (3.0, -0.5), 700.0).unwrap();
        let steepest = (0..=800).map(|i| speed.acceleration(0.5 + 0.005 * f64::from(i))).fold(0.0, f64::max);
        assert!((torque.inertia / (3.0 * 0.5 * steepest) - 1.0).abs() < 1e-12, "{torque:?}, not {steepest}");
        assert!(torque.remark("the input", "wait").is_some());
        assert_eq!(RunUpTorque { load: 1e4, ..torque }.remark("the input", "wait"), None);
        assert_eq!(RunUpTorque::new(Speed::Constant(50.0), (3.0, 1.0), 700.0), None);
    }
}
