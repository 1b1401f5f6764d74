//! Whether a motion repeats itself, judged by its transmission error.

use std::collections::VecDeque;

use integrate::{LONGEST_PERIOD, Periodicity};

/// Difference after one cycle, over the peak to peak, below which a motion dies out to period one rather than having
/// a longer period.
const SUBHARMONIC: f64 = 0.01;

/// Transmission errors of the last mesh cycles, row by row.
#[derive(Debug, Clone, Default)]
pub(super) struct PeriodicityMonitor {
    cycles: VecDeque<Vec<f64>>,
}

impl PeriodicityMonitor {
    /// Takes the rows of one more cycle. A period of several cycles is one only where the motion differs clearly
    /// after one: what dies out slowly may look alike after a few cycles by chance.
    ///
    /// Largest difference of a row to the one that many cycles before, over the peak to peak of this cycle, or over a
    /// millionth of its largest value where that is more: what does not vibrate repeats itself.
    pub fn judge(&mut self, rows: Vec<f64>, tolerance: f64) -> Periodicity {
        let (low, high) = rows.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| (a.min(x), b.max(x)));
        let size = (high - low).max(1e-6 * low.abs().max(high.abs())).max(f64::MIN_POSITIVE);
        let mut once = f64::INFINITY;
        let mut best = Periodicity { period: 1, residual: f64::INFINITY };
        for (i, before) in self.cycles.iter().rev().enumerate() {
            let off = rows.iter().zip(before).map(|(a, b)| (a - b).abs()).fold(0.0, crate::worse);
            let residual = off / size;
            if i == 0 {
                once = residual;
            }
            if i == 0 || (once > SUBHARMONIC && residual < best.residual) {
                best = Periodicity { period: i + 1, residual };
            }
            if residual <= tolerance {
                break;
            }
        }
        if self.cycles.len() == LONGEST_PERIOD {
            self.cycles.pop_front();
        }
        self.cycles.push_back(rows);
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A record of period three is found as such, not as one of six, and noise as none.
    #[test]
    fn the_shortest_period_is_found() {
        let mut monitor = PeriodicityMonitor::default();
        let mut last = None;
        for k in 0..8 {
            let own = f64::from(k % 3);
            last = Some(monitor.judge(vec![own, 2.0 + own, -1.0], 1e-9));
        }
        assert_eq!(last, Some(Periodicity { period: 3, residual: 0.0 }));
        let mut monitor = PeriodicityMonitor::default();
        let noise = (0..8).map(|k| monitor.judge(vec![f64::from(k * k), 0.0], 1e-9).residual);
        assert!(noise.fold(f64::INFINITY, f64::min) > 1e-3);
    }
}
