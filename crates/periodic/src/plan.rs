//! A branch from one value of its parameter to another.

use std::ops::ControlFlow;

use crate::{
    BalanceOptions, Branch, BranchOptions, FourierSeries, PeriodicEquations, PeriodicError, PeriodicMotion, Tracer,
};

/// First step over the longest.
const FIRST_STEP: f64 = 0.1;

/// What is asked of a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchPlan {
    /// Value of the parameter where the branch begins.
    pub from: f64,
    /// Value at which it ends, above or below.
    pub to: f64,
    /// Accuracy of the motions.
    pub balance: BalanceOptions,
    /// Longest step, in ranges of the parameter and scales of the coordinates.
    pub longest_step: f64,
    /// Largest number of motions.
    pub most: usize,
}

impl BranchPlan {
    /// The branch from the motion near `start` on; `seen` gets each motion and may end it.
    ///
    /// # Errors
    /// As of [`Tracer::branch`].
    pub fn follow<S: PeriodicEquations>(
        &self,
        system: &mut S,
        start: &FourierSeries,
        seen: impl FnMut(&PeriodicMotion) -> ControlFlow<()>,
    ) -> Result<Branch<S::Error>, PeriodicError<S::Error>> {
        let way = self.to - self.from;
        let options = BranchOptions {
            range: [self.from.min(self.to), self.from.max(self.to)],
            first_step: FIRST_STEP * self.longest_step * way,
            longest_step: self.longest_step,
            most: self.most,
        };
        Tracer::new(system, self.balance, way.abs())?.branch(self.from, start, &options, seen)
    }

    /// Value of the parameter at which a branch had all of its motions before it left the range.
    pub fn cut_short<E>(&self, branch: &Branch<E>) -> Option<f64> {
        let last = branch.motions.last().map(|motion| motion.parameter)?;
        let ended = last == self.from || last == self.to;
        (!ended && branch.motions.len() >= self.most).then_some(last)
    }

    /// Share of the range that a branch has not reached when it broke off or had all its motions; 0 of one that has left
    /// the range at either end.
    pub fn left_out<E>(&self, branch: &Branch<E>) -> f64 {
        if branch.broken.is_none() && self.cut_short(branch).is_none() {
            return 0.0;
        }
        let reached = branch.motions.iter().map(|motion| motion.parameter);
        let [low, high] = reached.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        1.0 - ((high - low).max(0.0) / (self.to - self.from).abs()).min(1.0)
    }
}
