//! Headline values of a branch, and remarks for the user.

use answer::Remark;
use periodic::{Branch, BranchPlan};
use serde::Serialize;

use super::{BranchPoint, BranchTurn, LossName, TimePoint};
use crate::remark;

/// A motion in time that differs from that of the branch by more than this has left it, or has too long steps.
const APART: f64 = 0.02;

described::described! {
    /// What a branch of periodic motions is; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct BranchFigures {
        /// smallest and largest value on the branch
        pub range: [f64; 2],
        /// mesh cycles of a period, of the fastest mesh of a gearbox
        pub period_cycles: u32,
        /// coordinates of the model
        pub coordinates: usize,
        /// motions of the branch
        pub motions: usize,
        /// unstable motions
        pub unstable: usize,
        /// values of the key at folds, in the order of the branch
        pub folds: Vec<f64>,
        /// values of the key at period doublings
        pub period_doublings: Vec<f64>,
        /// values of the key at torus bifurcations
        pub torus_bifurcations: Vec<f64>,
        /// motions in which driving flanks lose contact
        pub parting: usize,
        /// largest number of harmonics of a motion
        pub most_harmonics: usize,
        /// Newton steps of all motions
        pub newton_steps: usize,
        /// largest difference of a motion integrated in time, over the peak to peak
        pub difference_in_time: Option<f64>,
        /// whether the branch leaves the range where it began
        pub returns: bool,
        /// reason why the branch ends within its range; `null` where it does not
        pub broken: Option<String>,
    }
}

/// What is read off the motions of a branch: of each mesh a point, a turn and a motion in time.
#[derive(Clone, Copy)]
pub(crate) struct ReadOff<'a> {
    pub points: &'a [Vec<BranchPoint>],
    pub turns: &'a [Vec<BranchTurn>],
    pub in_time: &'a [Vec<TimePoint>],
}

impl BranchFigures {
    /// The figures of a branch; `key`: what messages call its parameter.
    pub(crate) fn new<E: std::fmt::Display>(
        (branch, plan, key): (&Branch<E>, &BranchPlan, &str),
        read: ReadOff<'_>,
        (coordinates, period_cycles): (usize, u32),
    ) -> Self {
        let points = || read.points.iter().filter_map(|all| all.first());
        let values = |loss: LossName| {
            let own = read.turns.iter().filter_map(|all| all.first()).filter(|turn| turn.loss == loss);
            own.map(|turn| turn.point.value).collect::<Vec<_>>()
        };
        let cut = |last: f64| format!("{key} = {last:.6} is reached after all {} `motions`", plan.most);
        Self {
            range: points().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.value), b.max(p.value)]),
            period_cycles,
            coordinates,
            motions: read.points.len(),
            unstable: points().filter(|p| !p.is_stable).count(),
            folds: values(LossName::Fold),
            period_doublings: values(LossName::PeriodDoubling),
            torus_bifurcations: values(LossName::Torus),
            parting: read.points.iter().filter(|all| all.iter().any(|p| p.share_apart > 0.0)).count(),
            most_harmonics: points().map(|p| p.harmonics).max().unwrap_or(0),
            newton_steps: branch.iterations,
            difference_in_time: read.in_time.iter().flatten().map(TimePoint::difference).reduce(f64::max),
            returns: read.points.len() > 1 && points().next_back().is_some_and(|last| last.value == plan.from),
            broken: branch.broken.as_ref().map(ToString::to_string).or_else(|| plan.cut_short(branch).map(cut)),
        }
    }

    /// What a user should hear; `key`: the key that follows motions of twice the period, with the value that does.
    pub(crate) fn remarks(&self, (key, twice): (&str, u32)) -> Vec<Remark> {
        let ends = self.broken.as_deref().map(remark::branch_ends);
        let apart = self.difference_in_time.filter(|d| *d > APART).map(|d| remark::branch_apart(100.0 * d));
        let back = (self.broken.is_none() && self.returns).then(remark::branch_turns_back);
        let lost = (!self.torus_bifurcations.is_empty()).then(remark::torus_bifurcation);
        let doubled = self.period_doublings.first().map(|value| remark::period_doubling(*value, key, twice));
        ends.into_iter().chain(back).chain(apart).chain(lost).chain(doubled).collect()
    }
}
