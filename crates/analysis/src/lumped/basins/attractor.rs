//! Final motions of the runs, distinguished by their characteristic values.

use answer::TableError;
use serde::Serialize;
use study::{extent, mean};

use super::super::run_loop::LumpedRun;

/// Extents and means of one motion differ by less than this share of the peak to peak.
const SAME: f64 = 0.01;

described::described! {
    /// A motion that runs end in; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct Attractor {
        /// number of the motion, from 1, by peak to peak ascending. Motions are one when period, mean and extremes differ by less than a hundredth of the peak to peak
        pub attractor: usize,
        /// mesh cycles after which the motion comes back; `null` for all that do not within eight, which count as one
        pub period_cycles: Option<usize>,
        /// starts that end in it
        pub starts: usize,
        /// share of all starts that end in it
        pub share_pct: f64,
        /// mean dynamic transmission error of the last mesh cycles, eight at the least
        pub mean_dte_um: f64,
        /// smallest dynamic transmission error
        pub min_dte_um: f64,
        /// largest dynamic transmission error
        pub max_dte_um: f64,
        /// smallest normal force on the driving flanks
        pub min_normal_force_n: f64,
        /// largest normal force on the driving flanks
        pub max_normal_force_n: f64,
        /// largest number of mesh cycles that a start took to get there
        pub most_warm_up_cycles: u64,
    }
}

impl Attractor {
    /// What the last cycles of a run look like; `tolerance`: difference after a period, over the peak to peak, that is
    /// none.
    ///
    /// # Errors
    /// [`TableError`] where its rows cannot be read back.
    pub(super) fn of(run: &LumpedRun, tolerance: f64) -> Result<Self, TableError> {
        let errors = run.rows.series(0..run.rows.len(), |row| row.transmission_error_um)?;
        let forces = run.rows.series(0..run.rows.len(), |row| row.normal_force)?;
        let (error, force) = (extent(&errors), extent(&forces));
        let repeats = run.periodicity.filter(|p| p.residual <= tolerance);
        Ok(Self {
            attractor: 0,
            period_cycles: repeats.map(|p| p.period),
            starts: 1,
            share_pct: 0.0,
            mean_dte_um: mean(&errors),
            min_dte_um: error[0],
            max_dte_um: error[1],
            min_normal_force_n: force[0],
            max_normal_force_n: force[1],
            most_warm_up_cycles: run.warm_up,
        })
    }

    /// Largest less smallest transmission error, um.
    pub fn peak_to_peak_dte_um(&self) -> f64 {
        self.max_dte_um - self.min_dte_um
    }

    /// Whether both are one motion, which runs may enter at different cycles.
    fn is(&self, other: &Self) -> bool {
        let near = SAME * self.peak_to_peak_dte_um().max(other.peak_to_peak_dte_um());
        let of = |a: &Self| [a.mean_dte_um, a.min_dte_um, a.max_dte_um];
        let alike = of(self).iter().zip(of(other)).all(|(a, b)| (a - b).abs() <= near);
        self.period_cycles == other.period_cycles && (alike || self.period_cycles.is_none())
    }

    /// Takes one more start in.
    fn take(&mut self, other: &Self) {
        self.starts += 1;
        self.most_warm_up_cycles = self.most_warm_up_cycles.max(other.most_warm_up_cycles);
        if self.period_cycles.is_none() {
            // Of motions that do not come back, all that they reach.
            self.min_dte_um = self.min_dte_um.min(other.min_dte_um);
            self.max_dte_um = self.max_dte_um.max(other.max_dte_um);
            self.min_normal_force_n = self.min_normal_force_n.min(other.min_normal_force_n);
            self.max_normal_force_n = self.max_normal_force_n.max(other.max_normal_force_n);
        }
    }
}

/// The different ones among what runs ended in, by peak to peak ascending, and which of them each run belongs to.
pub(super) fn told_apart(of_starts: &[Option<Attractor>]) -> (Vec<Attractor>, Vec<Option<usize>>) {
    let mut found: Vec<Attractor> = Vec::new();
    let mut belongs: Vec<Option<usize>> = Vec::with_capacity(of_starts.len());
    for one in of_starts {
        belongs.push(one.as_ref().map(|one| match found.iter().position(|known| known.is(one)) {
            Some(i) => {
                found[i].take(one);
                i
            }
            None => {
                found.push(one.clone());
                found.len() - 1
            }
        }));
    }
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by(|&a, &b| found[a].peak_to_peak_dte_um().total_cmp(&found[b].peak_to_peak_dte_um()));
    let mut number = vec![0; found.len()];
    order.iter().enumerate().for_each(|(place, &i)| number[i] = place + 1);
    let all = of_starts.len().max(1) as f64;
    for (one, number) in found.iter_mut().zip(&number) {
        one.attractor = *number;
        one.share_pct = 100.0 * one.starts as f64 / all;
    }
    found.sort_by_key(|one| one.attractor);
    (found, belongs.into_iter().map(|i| i.map(|i| number[i])).collect())
}
