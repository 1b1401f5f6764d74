//! What is read off a branch.

use scene::ContinuationScene;
use serde::Serialize;

use crate::branch::{BranchPoint, BranchTurn, LossName, Outcome, TimePoint};

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
        let said = Outcome {
            broken: self.broken.as_deref(),
            returns: self.returns,
            difference_in_time: self.difference_in_time,
            has_torus: !self.torus_bifurcations.is_empty(),
            doubled: self.period_doublings.first().copied(),
            period_cycles: self.period_cycles,
        };
        said.remarks()
    }
}
