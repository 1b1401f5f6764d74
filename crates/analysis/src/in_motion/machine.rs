//! Remarks about a whole machine in motion: its speed, its energy, its settling.

use answer::Remark;
use integrate::Periodicity;

use crate::remark;

/// Change of the mean speed over that of the start from which on a user should hear of it.
const SPEED: f64 = 0.01;
/// Length beyond what was asked for, over that, likewise.
const STRETCH: f64 = 0.01;
/// Energy that does not close, over the work that goes through the machine, likewise.
const OPEN_WORK: f64 = 1e-6;

/// The mean speed of an input that a torque drives, where it is another one than that of the start; both in 1/min.
pub(crate) fn speed_changed(mean_rpm: f64, start_rpm: f64) -> Option<Remark> {
    ((mean_rpm / start_rpm - 1.0).abs() > SPEED).then(|| remark::speed_has_changed(mean_rpm, start_rpm))
}

/// A motion of a given length (s) that goes on to the end of its last mesh cycle; `lasts`: s, where it is known.
pub(crate) fn stretched(asked: Option<f64>, cycles: u64, lasts: Option<f64>) -> Option<Remark> {
    let (asked, lasts) = (asked?, lasts?);
    (lasts > (1.0 + STRETCH) * asked).then(|| remark::whole_cycles(cycles, lasts, asked))
}

/// Energy that does not close, over the work that goes through the machine.
pub(crate) fn work_open(share: f64) -> Option<Remark> {
    (share.abs() > OPEN_WORK).then(|| remark::work_open(share.abs()))
}

/// How a motion has settled that was to repeat itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settled<'a> {
    /// Difference after a period, over the peak to peak, that was asked for.
    pub tolerance: f64,
    /// What the rows show, period in mesh cycles (of the fastest mesh).
    pub found: Periodicity,
    /// Mesh cycles before the rows.
    pub waited: u64,
    /// Mesh cycles after which the waiting ends; 0 of a motion that does not wait.
    pub most: u64,
    /// Mesh cycles after which all meshes are where they began.
    pub common: usize,
    /// Why it may not repeat itself.
    pub why: &'a str,
}

impl Settled<'_> {
    /// A motion that does not repeat, or that repeats only after several common periods.
    pub fn remark(self) -> Option<Remark> {
        let Self { tolerance, found: Periodicity { period, residual }, waited, most, common, why } = self;
        if residual <= tolerance {
            return (period > common).then(|| remark::subharmonic(period));
        }
        Some(match waited < most {
            true => remark::repeats_and_drifts(tolerance, waited, residual),
            false => remark::not_periodic(waited, residual, tolerance, why),
        })
    }
}

#[cfg(test)]
#[path = "../../tests/units/machine.rs"]
mod tests;
