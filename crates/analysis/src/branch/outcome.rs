//! What a user should hear of a branch.

use answer::Remark;

use crate::remark;

/// A motion in time that differs from that of the branch by more than this has left it, or has too long steps.
const APART: f64 = 0.02;

/// How a branch ended, and what it passed.
pub(crate) struct Outcome<'a> {
    /// Why it ends within its range, where it does.
    pub broken: Option<&'a str>,
    /// Whether it leaves the range where it began.
    pub returns: bool,
    /// Largest difference of a motion in time, over the peak to peak.
    pub difference_in_time: Option<f64>,
    /// Whether a second frequency begins somewhere.
    pub has_torus: bool,
    /// Value of the key at the first period doubling.
    pub doubled: Option<f64>,
    /// Mesh cycles of a period.
    pub period_cycles: u32,
}

impl Outcome<'_> {
    /// What a user should hear.
    pub fn remarks(&self) -> Vec<Remark> {
        let ends = self.broken.map(remark::branch_ends);
        let apart = self.difference_in_time.filter(|d| *d > APART).map(|d| remark::branch_apart(100.0 * d));
        let back = (self.broken.is_none() && self.returns).then(remark::branch_turns_back);
        let lost = self.has_torus.then(remark::torus_bifurcation);
        let doubled = self.doubled.map(|value| remark::period_doubling(value, 2 * self.period_cycles));
        ends.into_iter().chain(back).chain(apart).chain(lost).chain(doubled).collect()
    }
}
