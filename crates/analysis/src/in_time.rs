//! A scene in time, solved by the analysis that it requests, without a file.

use std::sync::Arc;

use answer::RowStore;
use mesh::Mesh;
use scene::Scene;
use serde_json::Value;

use crate::{
    AnalysisError, GearCache, Observer,
    accuracy::motion::{AccurateMotion, MotionAnswer, MotionTold},
    context::Ending,
    facts::RunInfo,
    lumped::{
        BasinAnalysis, BasinResult, BifurcationAnalysis, ContinuationAnalysis, ContinuationResult, KeySweep,
        LumpedAnalysis, LumpedQuantity, LumpedResult, NoLumpedSink, SweepOptions, is_lumped,
    },
    motion::{
        MotionAnalysis, MotionCheckpoint, MotionOutcome, MotionResult, MotionRow, MotionSink, SweepAnalysis,
        SweepResult,
    },
};

/// A scene in time with its result.
#[derive(Debug)]
pub struct SolvedInTime {
    /// The scene as given; for `model = "auto"` with the chosen model.
    pub scene: Scene,
    /// Result of the scene.
    pub answer: TimeAnswer,
}

/// Result of a scene in time, one variant per analysis.
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
        /// The sweep that was requested.
        options: Box<SweepOptions>,
        /// Points of the sweep.
        found: Box<BifurcationAnalysis>,
    },
    /// Periodic motions along a key.
    Branch(Box<ContinuationResult>),
    /// Basins of attraction.
    Basins(Box<BasinResult>),
}

/// Evaluates an expression with the result of whichever analysis: all of them have `facts`, `headline` and `remarks`.
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

    /// Facts about the result, with its certificate.
    pub fn facts(&self) -> &RunInfo {
        of_any!(&self.answer, result => &result.facts)
    }

    /// Remarks for the user.
    pub fn remarks(&self) -> &[answer::Remark] {
        of_any!(&self.answer, result => &result.remarks)
    }

    /// Whether the result passes its checks and meets the requested accuracy. The certificate of a sweep of a
    /// reduced-order model has the worst values of all points with a result.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]; [`AnalysisError::Refused`] for a result that is less accurate than requested, or
    /// without any speed.
    pub fn verdict(&self) -> Result<(), AnalysisError> {
        match &self.answer {
            TimeAnswer::Speeds(result) => result.verdict(&self.scene),
            _ => self.facts().verdict(&self.scene),
        }
    }
}

/// Whether a scene requests one motion of reduced gears, the only kind that has checkpoints and accepts meshes in
/// memory.
pub fn is_one_motion(scene: &Scene) -> bool {
    let one =
        scene.motion.as_ref().is_some_and(|m| m.sweep.is_none() && m.continuation.is_none() && m.basins.is_none());
    one && !is_lumped(scene) && scene.accuracy.is_none()
}

/// What a scene in time is solved with.
pub(crate) struct InTime<'a> {
    /// Meshes of pinion and wheel in place of those of the scene.
    pub meshes: Option<[&'a Mesh; 2]>,
    /// Where reduced gears come from and go to.
    pub cache: &'a dyn GearCache,
    /// State to go on from, with the rows before it.
    pub from: Option<(MotionCheckpoint, Arc<RowStore<MotionRow>>)>,
    /// Mesh cycles after which it stops.
    pub stop_after: Option<u64>,
}

impl InTime<'_> {
    /// Solves a scene of any model and any `motion.run`; rows of reduced gears are passed to `sink` as they are
    /// computed.
    ///
    /// # Errors
    /// [`AnalysisError`]; [`AnalysisError::Refused`] for a static scene, and if checkpoints or meshes in memory are
    /// used for anything but a [single motion](is_one_motion).
    pub fn solve(
        self,
        scene: &Scene,
        observer: &mut dyn Observer,
        sink: &mut dyn MotionSink,
    ) -> Result<Ending<SolvedInTime>, AnalysisError> {
        let Self { meshes, cache, from, stop_after } = self;
        let Some(motion) = &scene.motion else { return Err(crate::error::unasked(scene, "motion")) };
        if is_one_motion(scene) {
            let mut analysis = MotionAnalysis::new(scene).with_cache(cache).stop_after(stop_after);
            if let Some(meshes) = meshes {
                analysis = analysis.with_meshes(meshes);
            }
            if let Some((checkpoint, rows)) = from {
                analysis = analysis.resume(checkpoint, rows);
            }
            return Ok(match analysis.solve_into(observer, sink)? {
                MotionOutcome::Finished(result) => finished(scene.clone(), TimeAnswer::Motion(result)),
                MotionOutcome::Stopped { cycles } => Ending::Stopped { cycles },
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

fn finished(scene: Scene, answer: TimeAnswer) -> Ending<SolvedInTime> {
    Ending::Finished(SolvedInTime { scene, answer })
}
