//! Whether the rows and the steps of a motion show what moves.

use crate::remark;
use answer::Remark;
use study::{mesh_harmonics, unresolved_share};

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

/// Rows, or steps, that are too few for what moves; `samples`: the transmission error row by row over so many whole mesh
/// cycles, `steps` in each.
pub(crate) fn unresolved(samples: &[f64], cycles: u64, steps: f64) -> Vec<Remark> {
    rows(samples, cycles).into_iter().chain(orders(samples, cycles, steps)).collect()
}

fn rows(samples: &[f64], cycles: u64) -> Option<Remark> {
    let share = unresolved_share(samples, cycles as usize).ok().filter(|share| *share > UNRESOLVED)?;
    let rows = samples.len() as u64 / cycles.max(1);
    Some(remark::few_rows(rows, 100.0 * share, rows / 4, rows / 2, 100.0 * UNRESOLVED))
}

fn orders(samples: &[f64], cycles: u64, steps: f64) -> Option<Remark> {
    let rows = samples.len() / cycles.max(1) as usize;
    let all = mesh_harmonics(samples, cycles as usize, rows / 2).ok()?;
    let sum: f64 = all.iter().map(|h| h.amplitude).sum();
    let in_period = |order: usize| steps / order as f64;
    let wanted = |share: f64| STEPS + MORE_STEPS * share;
    let counts = all.iter().map(|h| (h.order, h.amplitude / sum)).filter(|(_, share)| *share > COUNTS);
    let (order, share) = counts.rev().find(|(order, share)| in_period(*order) < wanted(*share))?;
    Some(remark::few_steps(in_period(order), order, 100.0 * share, wanted(share)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::unresolved;

    /// One order with many steps is silent; the same with few, and one that the rows hardly show, are told.
    #[test]
    fn few_steps_and_few_rows_are_told() {
        let wave = |rows: usize, order: f64| -> Vec<f64> {
            (0..2 * rows).map(|i| 10.0 + (TAU * order * i as f64 / rows as f64).cos()).collect()
        };
        assert!(unresolved(&wave(64, 2.0), 2, 64.0).is_empty());
        assert!(unresolved(&[3.0; 64], 2, 8.0).is_empty(), "nothing moves");
        let few = unresolved(&wave(64, 2.0), 2, 24.0);
        assert!(few.len() == 1 && few[0].text().contains("1/12.0 of the period of mesh order 2"), "{few:?}");
        let coarse = unresolved(&wave(16, 7.0), 2, 1000.0);
        assert!(coarse.len() == 1 && coarse[0].text().contains("16 rows a mesh cycle"), "{coarse:?}");
    }
}
