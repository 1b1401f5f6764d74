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
#[path = "../../tests/units/resolved.rs"]
mod tests;
