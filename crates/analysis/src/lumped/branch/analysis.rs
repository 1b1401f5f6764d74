//! The branch of periodic motions of a scene.

use answer::Remark;
use std::ops::ControlFlow;

use periodic::{BalanceOptions, Branch, BranchOptions, FourierSeries, PeriodicError, PeriodicMotion, Tracer};
use scene::{ContinuationScene, Scene};

use super::{
    super::{LumpedInputs, analysis, excitation::ExcitationSource, remarks::no_backlash},
    BranchPoint, BranchTurn, ContinuationHeadline, TimePoint,
    family::ModelFamily,
    headline::{HeadlineInputs, headline},
    in_time::{integrated, settled},
    point::point,
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer, PhaseWork, Progress,
    certificate::{Check, Checks},
    error::in_scene,
    facts::RunInfo,
    gears,
    refused::Refusal,
    resolution::with_slices,
    run_phase, unless_cancelled,
};

/// Residual of the balance of forces that Newton's method ends with: twelve digits of a contact solver are not to be
/// had over many harmonics.
const TOLERANCE: f64 = 1e-9;
/// Phases for each harmonic.
const SAMPLES_PER_HARMONIC: usize = 8;
/// Share of the range that a branch may leave out.
const LEFT_OUT: f64 = 1e-2;
/// First step over the longest.
const FIRST_STEP: f64 = 0.1;

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

/// The answer to a continuation.
#[derive(Debug)]
pub struct ContinuationResult {
    /// What it was made of, and what must hold of it.
    pub facts: RunInfo,
    /// Motions in the order of the branch.
    pub points: Vec<BranchPoint>,
    /// Where it turns, or another branch leaves it.
    pub turns: Vec<BranchTurn>,
    /// Stable motions integrated in time.
    pub in_time: Vec<TimePoint>,
    /// The few numbers that it is made for.
    pub headline: ContinuationHeadline,
    /// What a user should hear.
    pub remarks: Vec<Remark>,
}

impl<'a> ContinuationAnalysis<'a> {
    /// Analysis of a scene with the model `mapped`, `reduced`, `lumped8`, `lumped12` or `shaft18`.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, cache: &NoCache }
    }

    /// With reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Follows the branch, telling nobody.
    ///
    /// # Errors
    /// As [`ContinuationAnalysis::solve_with`].
    pub fn solve(&self) -> Result<ContinuationResult, AnalysisError> {
        self.solve_with(&mut NoObserver)
    }

    /// Follows the branch, and integrates some of its stable motions in time.
    ///
    /// # Errors
    /// [`AnalysisError::Periodic`] where no periodic motion is found at the beginning; those of the model.
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
        let branch = run_phase(observer, "branch", PhaseWork::Unknown, |progress| {
            follow(&mut family, &inputs, &words, progress)
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
        let chosen = stable_ones(&points, words.time_points as usize);
        let in_time = run_phase(observer, "in time", PhaseWork::Steps(chosen.len() as u64), |progress| {
            let one = |&i: &usize| {
                progress.tick();
                unless_cancelled(progress)?;
                let of = (&branch.motions[i], points[i].peak_to_peak_dte_um);
                integrated(&family, &inputs, of)
            };
            chosen.iter().map(one).collect::<Result<Vec<TimePoint>, AnalysisError>>()
        })?;
        facts.certificate = certificate(&points, &words)
            .and(Checks::new([covered(&branch, &words)]))
            .and(Checks::new(family.now().0.checks()));
        let of = HeadlineInputs {
            words: &words,
            coordinates,
            mesh_resonance_hz: system.resonance_hz,
            newton_steps: branch.iterations,
            broken: branch.broken.as_ref().map(ToString::to_string).or_else(|| cut_short(&branch, &words)),
        };
        let headline = headline(of, &points, &turns, &in_time).ok_or_else(Refusal::no_values)?;
        remarks.extend(gears::remarks(&inputs.pair));
        remarks.extend(no_backlash(&inputs));
        remarks.extend(headline.remarks());
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

/// The branch from its first motion on.
fn follow(
    family: &mut ModelFamily<'_>,
    inputs: &LumpedInputs,
    words: &ContinuationScene,
    progress: &dyn Progress,
) -> Result<Branch<AnalysisError>, AnalysisError> {
    let (way, range) = (words.to - words.from, [words.from.min(words.to), words.from.max(words.to)]);
    let options = BalanceOptions {
        harmonics: words.harmonics as usize,
        most_harmonics: words.most_harmonics as usize,
        tail: words.tail,
        samples_per_harmonic: SAMPLES_PER_HARMONIC,
        least_samples: words.phases as usize,
        tolerance: TOLERANCE,
    };
    let walk = BranchOptions {
        range,
        first_step: FIRST_STEP * words.longest_step * way,
        longest_step: words.longest_step,
        most: words.motions as usize,
    };
    let complain = in_scene::<PeriodicError<AnalysisError>>(&inputs.scene);
    let from = |family: &mut ModelFamily<'_>, start: &FourierSeries| {
        let mut tracer = Tracer::new(family, options, way.abs()).map_err(complain)?;
        let branch = tracer.branch(words.from, start, &walk, |motion| {
            progress.say(format!("{} = {:.6}", words.key.word(), motion.parameter));
            if progress.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        branch.map_err(complain)
    };
    // Of several motions there, the one that a start from rest leads to; where that does not repeat itself, the search
    // begins at rest.
    let first = inputs.in_scene(family.scene_at(words.from));
    match settled(&first, words.period_cycles)? {
        Some(settled) => from(family, &settled),
        None => {
            let rest = FourierSeries::at_rest(&family.rest()?, options.harmonics);
            from(family, &rest)
        }
    }
}

/// That the branch has had all of its motions before it left the range.
fn cut_short(branch: &Branch<AnalysisError>, words: &ContinuationScene) -> Option<String> {
    let last = branch.motions.last().map(|motion| motion.parameter)?;
    let ended = last == words.from || last == words.to;
    (!ended && branch.motions.len() >= words.motions as usize)
        .then(|| format!("{} = {last:.6} is reached after all {} `motions`", words.key.word(), words.motions))
}

/// Share of the range that the branch has not reached when it broke off or had all its motions; nothing of one that has
/// left the range at either end.
fn covered(branch: &Branch<AnalysisError>, words: &ContinuationScene) -> Check {
    let reached = branch.motions.iter().map(|motion| motion.parameter);
    let [low, high] = reached.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    let unfinished = branch.broken.is_some() || cut_short(branch, words).is_some();
    let left_out = 1.0 - ((high - low).max(0.0) / (words.to - words.from).abs()).min(1.0);
    Check {
        name: "range_left_out".into(),
        value: if unfinished { left_out } else { 0.0 },
        bound: LEFT_OUT,
        hint: "give more `motions`, a larger `longest_step` or more damping in [motion.continuation] and [motion]; the remarks \
                  say where the branch ended",
    }
}

/// Motions to be integrated in time: stable ones, spread over the branch.
fn stable_ones(points: &[BranchPoint], most: usize) -> Vec<usize> {
    let stable: Vec<usize> = (0..points.len()).filter(|&i| points[i].is_stable).collect();
    let count = most.min(stable.len());
    // In the middle of as many equal parts.
    (0..count).map(|k| stable[(2 * k + 1) * stable.len() / (2 * count)]).collect()
}

fn certificate(points: &[BranchPoint], words: &ContinuationScene) -> Checks {
    let largest = |of: fn(&BranchPoint) -> f64| points.iter().map(of).fold(0.0, crate::worse);
    Checks::new([
        Check {
            name: "harmonic_residual".into(),
            value: largest(|p| p.residual),
            bound: 10.0 * TOLERANCE,
            hint: "give more `phases`",
        },
        Check {
            name: "harmonic_tail".into(),
            value: largest(|p| p.tail),
            bound: words.tail,
            hint: "give more `most_harmonics`",
        },
    ])
}
