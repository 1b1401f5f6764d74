//! What is read off a branch.

use crate::remark;
use periodic::Bifurcation;
use scene::ContinuationScene;
use serde::Serialize;

use super::{BranchPoint, LossName, TimePoint};

/// A motion in time that differs from that of the branch by more than this has left it, or has too long steps.
const APART: f64 = 0.02;

described::described! {
    /// Where the branch turns, or where another one leaves it.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct BranchTurn {
        /// `fold`, `period-doubling` or `torus`
        pub loss: LossName,
        /// the motion there
        #[serde(flatten)]
        pub point: BranchPoint,
    }
}

described::described! {
    /// What a continuation is made for; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct ContinuationHeadline {
        /// key that is varied
        pub key: &'static str,
        /// smallest and largest value on the branch
        pub range: [f64; 2],
        /// mesh cycles of a period
        pub period_cycles: u32,
        /// coordinates of the model
        pub coordinates: usize,
        /// natural frequency of the mesh
        pub mesh_resonance_hz: f64,
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
        /// motion with the largest peak to peak
        pub largest: BranchPoint,
        /// motions in which the driving flanks lose contact
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

/// What the headline takes beside points.
pub(super) struct HeadlineInputs<'a> {
    pub words: &'a ContinuationScene,
    pub coordinates: usize,
    pub mesh_resonance_hz: f64,
    pub newton_steps: usize,
    pub broken: Option<String>,
}

/// Reads it off a branch; `None` without a motion.
pub(super) fn headline(
    of: HeadlineInputs<'_>,
    points: &[BranchPoint],
    turns: &[BranchTurn],
    in_time: &[TimePoint],
) -> Option<ContinuationHeadline> {
    let largest = points.iter().max_by(|a, b| a.peak_to_peak_dte_um.total_cmp(&b.peak_to_peak_dte_um))?;
    let values =
        |loss: LossName| turns.iter().filter(|turn| turn.loss == loss).map(|turn| turn.point.value).collect::<Vec<_>>();
    let range = points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.value), b.max(p.value)]);
    Some(ContinuationHeadline {
        key: of.words.key.word(),
        range,
        period_cycles: of.words.period_cycles,
        coordinates: of.coordinates,
        mesh_resonance_hz: of.mesh_resonance_hz,
        motions: points.len(),
        unstable: points.iter().filter(|p| !p.is_stable).count(),
        folds: values(LossName::Fold),
        period_doublings: values(LossName::PeriodDoubling),
        torus_bifurcations: values(LossName::Torus),
        largest: largest.clone(),
        parting: points.iter().filter(|p| p.share_apart > 0.0).count(),
        most_harmonics: points.iter().map(|p| p.harmonics).max().unwrap_or(0),
        newton_steps: of.newton_steps,
        difference_in_time: in_time.iter().map(TimePoint::difference).reduce(f64::max),
        returns: points.len() > 1 && points.last().is_some_and(|last| last.value == of.words.from),
        broken: of.broken,
    })
}

impl ContinuationHeadline {
    /// What a user should hear.
    pub(super) fn remarks(&self) -> Vec<answer::Remark> {
        let ends = self.broken.as_ref().map(|why| remark::branch_ends(&**why));
        let apart = self.difference_in_time.filter(|d| *d > APART).map(|d| remark::branch_apart(100.0 * d));
        let back = (self.broken.is_none() && self.returns).then(remark::branch_turns_back);
        let lost = (!self.torus_bifurcations.is_empty()).then(remark::torus_bifurcation);
        let doubled =
            self.period_doublings.first().map(|value| remark::period_doubling(*value, 2 * self.period_cycles));
        ends.into_iter().chain(back).chain(apart).chain(lost).chain(doubled).collect()
    }
}

impl BranchTurn {
    /// Turn of a branch: a bifurcation and what was read off its motion.
    pub(super) fn new(bifurcation: &Bifurcation, point: BranchPoint) -> Self {
        Self { loss: bifurcation.loss.into(), point }
    }
}
