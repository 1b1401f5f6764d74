//! Whether the rows and the steps of a motion show what moves.

use answer::Remark;
use study::{order_amplitudes, unresolved_share};

use crate::remark;

/// Share of the vibration in the upper half of what rows can tell apart from which on a user should hear of it.
const UNRESOLVED: f64 = 0.05;
/// Share of the sum of all mesh orders from which on one of them counts.
const COUNTS: f64 = 0.05;
/// Steps in the period of the highest order that counts: an implicit method takes it for 1 % slower than it is, which
/// changes its size by a tenth next to a resonance.
const STEPS: f64 = 18.0;
/// So many more in that of an order that is all of the vibration, and its share of them where it is less. In map (g) of
/// `docs/envelope.md` an order that is 0.29 of it is off by 16 % with 16 steps, by 4 % with 32.
const MORE_STEPS: f64 = 14.0;
/// Fewer steps than this in a period of the mesh resonance show it wrongly: peak to peak off by 10 to 60 % near it (map (c)
/// of `docs/envelope.md`).
const COARSE: f64 = 12.0;

/// What a user changes for more rows and for more steps.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepKeys {
    rows: &'static str,
    steps: &'static str,
}

impl StepKeys {
    /// In the scene of a pair.
    pub const PAIR: Self =
        Self { rows: "more `steps_per_mesh_cycle`", steps: "more `steps_per_mesh_cycle` or `steps_per_resonance`" };
    /// In the file of a gearbox.
    pub const GEARBOX: Self =
        Self { rows: "more `steps_per_cycle`, or fewer `steps_per_row`", steps: "more `steps_per_cycle`" };
}

/// The transmission error of a mesh in motion, row by row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshRecord<'a> {
    /// Evenly spaced, um.
    pub samples: &'a [f64],
    /// Mesh cycles that they span.
    pub cycles: f64,
    /// Steps a mesh cycle; infinite where an error tolerance finds them.
    pub steps: f64,
    /// Whether what comes after them is what they began with.
    pub comes_back: bool,
    pub keys: StepKeys,
}

impl MeshRecord<'_> {
    /// Rows, or steps, that are too few for what moves.
    pub fn unresolved(&self) -> Vec<Remark> {
        self.few_rows().into_iter().chain(self.few_steps()).collect()
    }

    /// Rows a mesh cycle.
    fn rows(&self) -> f64 {
        self.samples.len() as f64 / self.cycles
    }

    fn few_rows(&self) -> Option<Remark> {
        let share = unresolved_share(self.samples, 1, self.comes_back);
        let (share, rows) = (share.ok().filter(|share| *share > UNRESOLVED)?, self.rows() as u64);
        let cure = self.keys.rows;
        Some(remark::few_rows(rows, 100.0 * share, rows / 4, rows / 2, 100.0 * UNRESOLVED, cure))
    }

    fn few_steps(&self) -> Option<Remark> {
        let all = order_amplitudes(self.samples, self.cycles, self.comes_back).ok()?;
        let sum: f64 = all.iter().sum();
        let in_period = |order: usize| self.steps / order as f64;
        let wanted = |share: f64| STEPS + MORE_STEPS * share;
        let counts = all.iter().enumerate().map(|(k, own)| (k + 1, own / sum)).filter(|(_, share)| *share > COUNTS);
        let (order, share) = counts.rev().find(|(order, share)| in_period(*order) < wanted(*share))?;
        Some(remark::few_steps(in_period(order), order, 100.0 * share, wanted(share), self.keys.steps))
    }
}

/// Steps that are too long for a motion of this name and frequency, Hz; `steps`: in a period of it; `or`: what else helps.
pub(crate) fn coarse_steps(steps: f64, (what, hz): (&str, f64), (keys, or): (StepKeys, &str)) -> Option<Remark> {
    (steps < COARSE).then(|| remark::coarse_steps(steps, what, hz, format!("{}{or}", keys.steps)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn unresolved(samples: &[f64], cycles: f64, steps: f64, comes_back: bool) -> Vec<Remark> {
        MeshRecord { samples, cycles, steps, comes_back, keys: StepKeys::PAIR }.unresolved()
    }

    /// One order with many steps is silent; the same with few, and one that the rows hardly show, are told.
    #[test]
    fn few_steps_and_few_rows_are_told() {
        let wave = |rows: usize, order: f64| -> Vec<f64> {
            (0..2 * rows).map(|i| 10.0 + (TAU * order * i as f64 / rows as f64).cos()).collect()
        };
        assert!(unresolved(&wave(64, 2.0), 2.0, 64.0, true).is_empty());
        assert!(unresolved(&[3.0; 64], 2.0, 8.0, true).is_empty(), "nothing moves");
        let few = unresolved(&wave(64, 2.0), 2.0, 24.0, true);
        assert!(few.len() == 1 && few[0].text().contains("1/12.0 of the period of mesh order 2"), "{few:?}");
        let coarse = unresolved(&wave(16, 7.0), 2.0, 1000.0, true);
        assert!(coarse.len() == 1 && coarse[0].text().contains("16 rows a mesh cycle"), "{coarse:?}");
    }

    /// A mesh whose cycles are no whole number of rows, on a drift that does not come back: the same orders are told, and the
    /// jump from the end to the beginning is none of them.
    #[test]
    fn a_record_that_does_not_come_back_is_judged_by_its_orders() {
        let rows = 40.0 * 53.0 / 19.0;
        let record = |order: f64| -> Vec<f64> {
            (0..640).map(|i| 10.0 + 0.01 * f64::from(i) + (TAU * order * f64::from(i) / rows).cos()).collect()
        };
        let of = |order: f64, steps: f64| unresolved(&record(order), 640.0 / rows, steps, false);
        assert!(of(2.0, 80.0).is_empty(), "{:?}", of(2.0, 80.0));
        let few = of(2.0, 24.0);
        assert!(few.len() == 1 && few[0].text().contains("1/12.0 of the period of mesh order 2"), "{few:?}");
        let coarse = of(40.0, 10_000.0);
        assert!(coarse.len() == 1 && coarse[0].code() == "few_rows", "{coarse:?}");
        let (samples, keys) = (record(2.0), StepKeys::GEARBOX);
        let short = MeshRecord { samples: &samples[..300], cycles: 300.0 / rows, steps: 8.0, comes_back: false, keys };
        assert!(short.few_steps().is_none(), "less than three cycles do not tell their orders apart");
    }

    /// Eleven steps in the period of a resonance are told, with what helps; twelve are not.
    #[test]
    fn steps_that_cannot_show_a_resonance_are_told() {
        let of = |steps: f64| coarse_steps(steps, ("mesh resonance", 2000.0), (StepKeys::GEARBOX, ", or wait"));
        assert_eq!(of(12.0), None);
        assert_eq!(of(11.0).unwrap().hint().unwrap(), "take more `steps_per_cycle`, or wait");
    }
}
