//! A motion with error bounds, by the cheapest model that meets the requested accuracy.

use scene::{Method, Run, Scene};

use super::{
    MotionAnswer, MotionModel, MotionTold,
    ladder::{MotionLadder, Moved},
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer,
    accuracy::{
        Accuracy,
        climb::{Climbed, climb},
    },
    facts::RunInfo,
    lumped::NoLumpedSink,
    motion::NoMotionSink,
};

/// Result of a scene in motion, with error bounds.
#[derive(Debug)]
pub struct AccurateMotionResult {
    /// The scene as solved; for `model = "auto"` with the chosen model, mesh, slices and steps.
    pub scene: Scene,
    /// Rows and facts of the motion, including [`RunInfo::accuracy`].
    pub answer: MotionAnswer,
}

/// A scene in motion to be solved with error bounds.
///
/// With `model = "auto"` the cheapest of `lumped12`, `reduced` and `reduced+modes` is used that meets `[accuracy]`. For
/// "reduced" and "reduced+modes" the bounds of the run are estimated.
#[derive(Clone, Copy)]
pub struct AccurateMotion<'a> {
    scene: &'a Scene,
    cache: &'a dyn GearCache,
}

impl std::fmt::Debug for AccurateMotion<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("AccurateMotion").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

impl<'a> AccurateMotion<'a> {
    /// Analysis of a scene in motion with `[accuracy]`.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, cache: &NoCache }
    }

    /// Uses reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Solves it without progress reports.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(&self) -> Result<AccurateMotionResult, AnalysisError> {
        let mut told = MotionTold { motion: &mut NoMotionSink, lumped: &mut NoLumpedSink };
        self.solve_into(&mut NoObserver, &mut told)
    }

    /// Solves it; rows are passed on as they are computed, again from the beginning at every run.
    ///
    /// If the finest model does not meet the accuracy, its result is returned nevertheless; [`Accuracy::is_met`] tells.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        &self,
        observer: &mut dyn Observer,
        told: &mut MotionTold<'_>,
    ) -> Result<AccurateMotionResult, AnalysisError> {
        self.possible()?;
        let mut ladder = MotionLadder::new(self.scene, self.cache, told);
        let Climbed { solved: Moved { mut scene, mut answer, .. }, accuracy, tried, .. } =
            climb(&mut ladder, observer)?;
        answer.facts_mut().accuracy = Some(Accuracy { models: tried, ..accuracy });
        scene.accuracy = self.scene.accuracy.clone();
        Ok(AccurateMotionResult { scene, answer })
    }

    /// What scenes that come from no file may ask, and there are no bounds of.
    fn possible(&self) -> Result<(), AnalysisError> {
        let steady = self.scene.motion.as_ref().is_some_and(|m| m.run == Run::Steady && m.error_tolerance.is_none());
        let known = self.scene.is_auto() || MotionModel::of(self.scene).is_some();
        if steady && known && self.scene.contact.method == Method::Slice {
            return Ok(());
        }
        Err(crate::error::unasked(self.scene, "steady motion of reduced gears with bounds"))
    }
}

impl MotionAnswer {
    /// Facts of the run.
    pub fn facts(&self) -> &RunInfo {
        match self {
            Self::Lumped(result) => &result.facts,
            Self::Reduced(result) => &result.facts,
        }
    }

    fn facts_mut(&mut self) -> &mut RunInfo {
        match self {
            Self::Lumped(result) => &mut result.facts,
            Self::Reduced(result) => &mut result.facts,
        }
    }

    /// Share of the peak to peak that elastic inertia may change, of a model that knows.
    pub(super) fn elastic_share(&self) -> Option<f64> {
        match self {
            Self::Lumped(_) => None,
            Self::Reduced(result) => Some(result.headline.elasticity.change_over_peak_to_peak),
        }
    }
}
