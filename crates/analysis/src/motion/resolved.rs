//! Whether the rows and the steps of a motion show what moves.

use answer::Remark;
use integrate::Scheme;
use study::{Harmonic, cycle_statistics, mesh_harmonics, unresolved_share};

use crate::remark;

/// Share of the vibration in the upper half of what rows can tell apart from which on a user should hear of it.
const UNRESOLVED: f64 = 0.05;
/// Share of the peak to peak that steps may change from which on a user should hear of it.
const STEPS: f64 = 0.01;
/// The resonance of a pair lies within this share of that of its mean stiffness, and so many places there are looked at.
const SHIFT: f64 = 0.05;
const SHIFTS: i32 = 5;

/// Steps of a motion at constant speed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TimeSteps {
    /// In a mesh cycle.
    pub per_cycle: f64,
    pub scheme: Scheme,
    /// Mesh resonance over the mesh frequency; 0: the mesh has no one stiffness.
    pub resonance: f64,
    /// Damping ratio of the mesh.
    pub damping: f64,
}

/// What steps make of the steady motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepError {
    /// Of the peak to peak, over itself, at the most.
    pub share: f64,
    /// The mesh order that has the largest part of it.
    pub order: usize,
}

impl TimeSteps {
    /// What these steps make of a motion whose transmission error is given row by row over whole mesh cycles; `None` of one
    /// that stands still.
    ///
    /// ```text
    /// e <= 2 sum_k A_k max |G(W_k h, W_k / w) - 1|,   w within SHIFT of the mesh resonance
    /// ```
    /// A_k: harmonics of the transmission error; G: [`Scheme::steady_gain`]. Theory (66a).
    pub fn error(&self, samples: &[f64], cycles: u64) -> Option<StepError> {
        let rows = samples.len() / cycles.max(1) as usize;
        let all = mesh_harmonics(samples, cycles as usize, rows / 2).ok()?;
        let peak_to_peak = cycle_statistics(samples, cycles as usize).ok()?.peak_to_peak;
        let part = |h: &Harmonic| 2.0 * h.amplitude * self.gain_error(h.order);
        let worst = all.iter().max_by(|a, b| part(a).total_cmp(&part(b)))?;
        let share = all.iter().map(part).sum::<f64>() / peak_to_peak;
        share.is_finite().then_some(StepError { share, order: worst.order })
    }

    /// By how much of itself steps may change the answer to a mesh order; all of it where they do not show it.
    fn gain_error(&self, order: usize) -> f64 {
        let angle = std::f64::consts::TAU * order as f64 / self.per_cycle;
        let off = |by: i32| {
            let resonance = self.resonance * (1.0 + SHIFT * f64::from(by) / f64::from(SHIFTS));
            // Far above the resonance inertia alone answers.
            let ratio = order as f64 / resonance.max(1e-6);
            (self.scheme.steady_gain(angle, ratio, self.damping) - 1.0).abs().min(1.0)
        };
        (-SHIFTS..=SHIFTS).map(off).fold(0.0, f64::max)
    }

    fn remark(&self, error: StepError) -> Option<Remark> {
        let steps = self.per_cycle / error.order as f64;
        let is_told = error.share > STEPS;
        is_told.then(|| remark::few_steps(100.0 * error.share, error.order, steps, 100.0 * STEPS))
    }
}

/// Rows that are too few for what moves, and steps; `samples`: the transmission error row by row over so many whole mesh
/// cycles, `steps` of a motion with steps of one length.
pub(crate) fn unresolved(samples: &[f64], cycles: u64, steps: Option<TimeSteps>) -> Vec<Remark> {
    let few_steps = steps.and_then(|steps| steps.remark(steps.error(samples, cycles)?));
    rows(samples, cycles).into_iter().chain(few_steps).collect()
}

fn rows(samples: &[f64], cycles: u64) -> Option<Remark> {
    let share = unresolved_share(samples, cycles as usize).ok().filter(|share| *share > UNRESOLVED)?;
    let rows = samples.len() as u64 / cycles.max(1);
    Some(remark::few_rows(rows, 100.0 * share, rows / 4, rows / 2, 100.0 * UNRESOLVED))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn steps(per_cycle: f64, resonance: f64) -> TimeSteps {
        TimeSteps { per_cycle, scheme: Scheme::Energy, resonance, damping: 0.05 }
    }

    fn wave(rows: usize, order: f64) -> Vec<f64> {
        (0..2 * rows).map(|i| 10.0 + (TAU * order * i as f64 / rows as f64).cos()).collect()
    }

    /// One order with many steps is silent; the same with few, and one that the rows hardly show, are told.
    #[test]
    fn few_steps_and_few_rows_are_told() {
        assert!(unresolved(&wave(64, 2.0), 2, Some(steps(400.0, 2.0))).is_empty());
        assert!(unresolved(&[3.0; 64], 2, Some(steps(8.0, 2.0))).is_empty(), "nothing moves");
        let few = unresolved(&wave(64, 2.0), 2, Some(steps(64.0, 2.0)));
        assert!(few.len() == 1 && few[0].text().contains("mesh order 2, whose period has 32.0"), "{few:?}");
        let coarse = unresolved(&wave(16, 7.0), 2, Some(steps(1000.0, 1.0)));
        assert!(coarse.len() == 1 && coarse[0].text().contains("16 rows a mesh cycle"), "{coarse:?}");
        assert!(unresolved(&wave(64, 2.0), 2, None).is_empty(), "steps that follow an error");
    }

    /// The same steps matter most on the sides of a resonance, and less the more there are: by the square.
    #[test]
    fn steps_matter_beside_a_resonance() {
        let error =
            |per_cycle: f64, resonance: f64| steps(per_cycle, resonance).error(&wave(64, 2.0), 2).unwrap().share;
        assert!(error(64.0, 2.0) > 3.0 * error(64.0, 8.0), "{} and {}", error(64.0, 2.0), error(64.0, 8.0));
        let order = (error(128.0, 2.0) / error(256.0, 2.0)).log2();
        assert!((order - 2.0).abs() < 0.1, "order {order}");
        assert!(error(4.0, 2.0) > 0.99, "two steps in a period show nothing");
    }
}
