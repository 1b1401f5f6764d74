//! The branch of periodic motions of a scene.

use answer::Remark;
use std::ops::ControlFlow;

use periodic::{Branch, BranchPlan, FourierSeries, PeriodicError, PeriodicMotion};
use scene::{ContinuationScene, Scene};

use super::{
    super::{LumpedInputs, analysis, excitation::ExcitationSource, remarks::no_backlash},
    ContinuationHeadline,
    family::ModelFamily,
    in_time::{integrated, settled},
    point::point,
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer, PhaseWork, Progress,
    branch::{BranchFigures, BranchPoint, BranchTurn, BranchWords, ReadOff, TimePoint, checks, stable_ones},
    certificate::Checks,
    error::in_scene,
    facts::RunInfo,
    gears,
    refused::Refusal,
    resolution::with_slices,
    run_phase, unless_cancelled,
};

/// A scene with `run = "continuation"`.
#[derive(Clone, Copy)]
pub struct ContinuationAnalysis<'a> {
    scene: &'a Scene,
    cache: &'a dyn GearCache,
}

impl std::fmt::Debug for ContinuationAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ContinuationAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

/// Result of a continuation.
#[derive(Debug)]
pub struct ContinuationResult {
    /// Facts about the run, with its certificate.
    pub facts: RunInfo,
    /// Motions in the order of the branch.
    pub points: Vec<BranchPoint>,
    /// Points at which the branch turns or another branch leaves it.
    pub turns: Vec<BranchTurn>,
    /// Stable motions integrated in time.
    pub in_time: Vec<TimePoint>,
    /// Headline values.
    pub headline: ContinuationHeadline,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

impl<'a> ContinuationAnalysis<'a> {
    /// Analysis of a scene with the model `mapped`, `reduced`, `lumped8`, `lumped12` or `shaft18`.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, cache: &NoCache }
    }

    /// Uses reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Follows the branch without progress reports.
    ///
    /// # Errors
    /// The errors of [`ContinuationAnalysis::solve_with`].
    pub fn solve(&self) -> Result<ContinuationResult, AnalysisError> {
        self.solve_with(&mut NoObserver)
    }

    /// Follows the branch, and integrates several of its stable motions in time.
    ///
    /// # Errors
    /// [`AnalysisError::Periodic`] if no periodic motion is found at the beginning; the errors of the model.
    pub fn solve_with(&self, observer: &mut dyn Observer) -> Result<ContinuationResult, AnalysisError> {
        let scene = with_slices(self.scene.clone());
        let other = || crate::error::unasked(&scene, "continuation");
        let words = scene.motion.as_ref().and_then(|m| m.continuation).ok_or_else(other)?;
        let first = Self::at_first(&scene, &words);
        let inputs = LumpedInputs::gather(&first, &mut ExcitationSource::new(observer, self.cache))?;
        let system = inputs.build()?;
        let mut family = ModelFamily::new(&inputs, words.key, words.period_cycles)?;
        let coordinates = system.coordinates();
        let mut facts = analysis::facts(&inputs, coordinates);
        let mut remarks = system.remarks;
        let plan = BranchWords {
            range: [words.from, words.to],
            harmonics: [words.harmonics, words.most_harmonics],
            tail: words.tail,
            phases: words.phases,
            longest_step: words.longest_step,
            motions: words.motions,
        }
        .plan();
        let branch = run_phase(observer, "branch", PhaseWork::Unknown, |progress| {
            follow(&mut family, &inputs, (&words, &plan), progress)
        })?;
        let read = |family: &mut ModelFamily<'_>, motion: &PeriodicMotion| point(family, motion, words.period_cycles);
        let (points, turns) = run_phase(observer, "read", PhaseWork::Steps(branch.motions.len() as u64), |progress| {
            let points = branch.motions.iter().map(|motion| {
                progress.tick();
                unless_cancelled(progress)?;
                read(&mut family, motion)
            });
            let points = points.collect::<Result<Vec<_>, _>>()?;
            let turns = branch.bifurcations.iter().map(|b| Ok(BranchTurn::new(b, read(&mut family, &b.motion)?)));
            Ok::<_, AnalysisError>((points, turns.collect::<Result<Vec<_>, AnalysisError>>()?))
        })?;
        let chosen = stable_ones(points.iter(), words.time_points as usize);
        let in_time = run_phase(observer, "in time", PhaseWork::Steps(chosen.len() as u64), |progress| {
            let one = |&i: &usize| {
                progress.tick();
                unless_cancelled(progress)?;
                let of = (&branch.motions[i], points[i].peak_to_peak_dte_um);
                integrated(&family, &inputs, of)
            };
            chosen.iter().map(one).collect::<Result<Vec<TimePoint>, AnalysisError>>()
        })?;
        facts.certificate = checks(&branch, &plan).and(Checks::new(family.now().0.checks()));
        let largest = points.iter().max_by(|a, b| a.peak_to_peak_dte_um.total_cmp(&b.peak_to_peak_dte_um));
        let read = ReadOff { points: &alone(&points), turns: &alone(&turns), in_time: &alone(&in_time) };
        let figures = BranchFigures::new((&branch, &plan, words.key.word()), read, (coordinates, words.period_cycles));
        let headline = ContinuationHeadline {
            key: words.key.word(),
            mesh_resonance_hz: system.resonance_hz,
            largest: largest.cloned().ok_or_else(Refusal::no_values)?,
            figures,
        };
        remarks.extend(gears::remarks(&inputs.pair));
        remarks.extend(no_backlash(&inputs));
        remarks.extend(headline.figures.remarks(("period_cycles", 2 * words.period_cycles)));
        remarks.extend(inputs.left_out_of_sweeps());
        Ok(ContinuationResult { facts, points, turns, in_time, headline, remarks })
    }

    /// The scene where the branch begins; of a torque that grows, maps and scales are those of the largest.
    fn at_first(scene: &Scene, words: &ContinuationScene) -> Scene {
        let mut first = scene.clone();
        match words.key {
            scene::ContinuationKey::Speed => first.operation.speed_rpm = words.from,
            scene::ContinuationKey::Torque => first.operation.torque_nm = words.from.max(words.to),
            _ => {}
        }
        // A motion in time is looked at for its whole period.
        first.analysis.cycles = first.analysis.cycles.max(words.period_cycles);
        first
    }
}

/// What is read off each motion, of the one mesh of a pair.
fn alone<T: Clone>(all: &[T]) -> Vec<Vec<T>> {
    all.iter().map(|own| vec![own.clone()]).collect()
}

/// The branch from its first motion on.
fn follow(
    family: &mut ModelFamily<'_>,
    inputs: &LumpedInputs,
    (words, plan): (&ContinuationScene, &BranchPlan),
    progress: &dyn Progress,
) -> Result<Branch<AnalysisError>, AnalysisError> {
    // Of several motions there, the one that a start from rest leads to; where that does not repeat itself, the search
    // begins at rest.
    let first = inputs.in_scene(family.scene_at(words.from));
    let start = match settled(&first, words.period_cycles)? {
        Some(settled) => settled,
        None => FourierSeries::at_rest(&family.rest()?, plan.balance.harmonics),
    };
    let branch = plan.follow(family, &start, |motion| {
        progress.say(format!("{} = {:.6}", words.key.word(), motion.parameter));
        if progress.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    branch.map_err(in_scene::<PeriodicError<AnalysisError>>(&inputs.scene))
}
