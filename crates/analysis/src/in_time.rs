//! A scene in time, solved by the analysis that it asks for, without a file.

use mesh::Mesh;
use scene::Scene;
use serde_json::Value;

use crate::{
    AnalysisError, GearCache, NoCache, Observer,
    accuracy::motion::{AccurateMotion, MotionAnswer, MotionTold},
    facts::Facts,
    lumped::{
        BasinAnalysis, BasinResult, BifurcationAnalysis, ContinuationAnalysis, ContinuationResult, KeySweep,
        LumpedAnalysis, LumpedQuantity, LumpedResult, NoLumpedSink, SweepOptions, is_lumped,
    },
    motion::{
        MotionAnalysis, MotionCheckpoint, MotionOutcome, MotionResult, MotionRow, MotionSink, NoMotionSink,
        SweepAnalysis, SweepResult,
    },
};

/// A scene in time with its answer.
#[derive(Debug)]
pub struct SolvedInTime {
    /// The scene as it was asked for; of `model = "auto"` with the model that was taken.
    pub scene: Scene,
    /// The answer.
    pub answer: TimeAnswer,
}

/// The answer to a scene in time, one variant for each analysis.
#[derive(Debug)]
pub enum TimeAnswer {
    /// One motion of reduced gears.
    Motion(Box<MotionResult>),
    /// One motion of a reduced-order model.
    Lumped(Box<LumpedResult>),
    /// Steady states of reduced gears over speed.
    Speeds(Box<SweepResult>),
    /// Steady states of a reduced-order model over speed.
    LumpedSpeeds {
        /// The sweep that was asked for.
        options: Box<SweepOptions>,
        /// Its points.
        found: Box<BifurcationAnalysis>,
    },
    /// Periodic motions along a key.
    Branch(Box<ContinuationResult>),
    /// Basins of attraction.
    Basins(Box<BasinResult>),
}

/// How an analysis in time ended.
#[derive(Debug)]
pub enum TimeOutcome {
    /// It came to its end.
    Finished(Box<SolvedInTime>),
    /// It stopped where it was asked to; the sink has a checkpoint.
    Stopped {
        /// Mesh cycles done.
        cycles: u64,
    },
}

/// Evaluates an expression with the result of whichever analysis: all of them have `facts`, `headline` and `warnings`.
macro_rules! of_any {
    ($answer:expr, $result:ident => $value:expr) => {
        match $answer {
            TimeAnswer::Motion($result) => $value,
            TimeAnswer::Lumped($result) => $value,
            TimeAnswer::Speeds($result) => $value,
            TimeAnswer::LumpedSpeeds { found: $result, .. } => $value,
            TimeAnswer::Branch($result) => $value,
            TimeAnswer::Basins($result) => $value,
        }
    };
}

impl SolvedInTime {
    /// The headline of `summary.json`; numbers without a value (NaN) are null.
    pub fn headline(&self) -> Value {
        // Strings and numbers only, all keys are strings: there is nothing that JSON could refuse.
        of_any!(&self.answer, result => serde_json::to_value(&result.headline).unwrap_or_default())
    }

    /// What the answer was made of, with its certificate.
    pub fn facts(&self) -> &Facts {
        of_any!(&self.answer, result => &result.facts)
    }

    /// What a user should hear.
    pub fn warnings(&self) -> &[answer::Remark] {
        of_any!(&self.answer, result => &result.warnings)
    }

    /// Whether the answer holds and is as exact as was asked. The certificate of a sweep of a reduced-order
    /// model has the worst of all values that came out.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]; [`AnalysisError::Refused`] of a result less exact than asked, or without a speed.
    pub fn verdict(&self) -> Result<(), AnalysisError> {
        match &self.answer {
            TimeAnswer::Speeds(result) => result.verdict(&self.scene),
            _ => self.facts().verdict(&self.scene),
        }
    }
}

/// A scene in time, of any model and any `motion.run`.
#[derive(Clone)]
pub struct TimeAnalysis<'a> {
    scene: &'a Scene,
    meshes: Option<[&'a Mesh; 2]>,
    cache: &'a dyn GearCache,
    from: Option<(MotionCheckpoint, Vec<MotionRow>)>,
    stop_after: Option<u64>,
}

impl std::fmt::Debug for TimeAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TimeAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

impl<'a> TimeAnalysis<'a> {
    /// Of a scene, its meshes read or made as it says.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, meshes: None, cache: &NoCache, from: None, stop_after: None }
    }

    /// Whether a scene asks for one motion of reduced gears as they are: what has checkpoints, and takes meshes in memory.
    pub fn is_one_motion(scene: &Scene) -> bool {
        let one =
            scene.motion.as_ref().is_some_and(|m| m.sweep.is_none() && m.continuation.is_none() && m.basins.is_none());
        one && !is_lumped(scene) && scene.accuracy.is_none()
    }

    /// With meshes of pinion and wheel in place of those of the scene, where they are given.
    #[must_use]
    pub fn with_meshes(self, meshes: Option<[&'a Mesh; 2]>) -> Self {
        Self { meshes, ..self }
    }

    /// With reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// From a checkpoint on, as [`MotionAnalysis::resume`].
    #[must_use]
    pub fn resume(self, checkpoint: MotionCheckpoint, rows: Vec<MotionRow>) -> Self {
        Self { from: Some((checkpoint, rows)), ..self }
    }

    /// Stops when so many mesh cycles are done, as [`MotionAnalysis::stop_after`].
    #[must_use]
    pub fn stop_after(self, cycles: Option<u64>) -> Self {
        Self { stop_after: cycles, ..self }
    }

    /// Solves the scene to its end, all rows in memory.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(self, observer: &mut dyn Observer) -> Result<SolvedInTime, AnalysisError> {
        let scene = self.scene;
        match self.stop_after(None).solve_into(observer, &mut NoMotionSink)? {
            TimeOutcome::Finished(solved) => Ok(*solved),
            // Nobody asked it to.
            TimeOutcome::Stopped { .. } => Err(crate::error::unasked(scene, "motion to its end")),
        }
    }

    /// Solves the scene; rows of reduced gears go into `sink` as they come.
    ///
    /// # Errors
    /// [`AnalysisError`]; [`AnalysisError::Refused`] for a scene at rest, and where checkpoints or meshes in memory
    /// go with what is no [single motion](TimeAnalysis::is_one_motion).
    pub fn solve_into(
        self,
        observer: &mut dyn Observer,
        sink: &mut dyn MotionSink,
    ) -> Result<TimeOutcome, AnalysisError> {
        let Self { scene, meshes, cache, from, stop_after } = self;
        let Some(motion) = &scene.motion else { return Err(crate::error::unasked(scene, "motion")) };
        if Self::is_one_motion(scene) {
            let mut analysis = MotionAnalysis::new(scene).with_cache(cache).stop_after(stop_after);
            if let Some(meshes) = meshes {
                analysis = analysis.with_meshes(meshes);
            }
            if let Some((checkpoint, rows)) = from {
                analysis = analysis.resume(checkpoint, rows);
            }
            return Ok(match analysis.solve_into(observer, sink)? {
                MotionOutcome::Finished(result) => finished(scene.clone(), TimeAnswer::Motion(result)),
                MotionOutcome::Stopped { cycles } => TimeOutcome::Stopped { cycles },
            });
        }
        if meshes.is_some() || from.is_some() || stop_after.is_some() {
            return Err(crate::error::unasked(scene, "single motion of reduced gears"));
        }
        let answer = if motion.basins.is_some() {
            TimeAnswer::Basins(Box::new(BasinAnalysis::new(scene).with_cache(cache).solve_with(observer)?))
        } else if motion.continuation.is_some() {
            TimeAnswer::Branch(Box::new(ContinuationAnalysis::new(scene).with_cache(cache).solve_with(observer)?))
        } else if let (Some(speeds), true) = (&motion.sweep, is_lumped(scene)) {
            let (scenes, options) = SweepOptions::over_speed(scene, speeds, LumpedQuantity::transmission_error());
            let found = KeySweep::new(&scenes, &options).with_cache(cache).solve_with(observer)?;
            TimeAnswer::LumpedSpeeds { options: Box::new(options), found: Box::new(found) }
        } else if motion.sweep.is_some() {
            TimeAnswer::Speeds(Box::new(SweepAnalysis::new(scene).with_cache(cache).solve_into(observer, sink)?))
        } else if is_lumped(scene) {
            let analysis = LumpedAnalysis::new(scene).with_cache(cache);
            TimeAnswer::Lumped(Box::new(analysis.solve_into(observer, &mut NoLumpedSink)?))
        } else {
            let told = &mut MotionTold { motion: sink, lumped: &mut NoLumpedSink };
            let solved = AccurateMotion::new(scene).with_cache(cache).solve_into(observer, told)?;
            let answer = match solved.answer {
                MotionAnswer::Lumped(result) => TimeAnswer::Lumped(result),
                MotionAnswer::Reduced(result) => TimeAnswer::Motion(result),
            };
            return Ok(finished(solved.scene, answer));
        };
        Ok(finished(scene.clone(), answer))
    }
}

fn finished(scene: Scene, answer: TimeAnswer) -> TimeOutcome {
    TimeOutcome::Finished(Box::new(SolvedInTime { scene, answer }))
}
