//! Static analysis of a scene with error bounds, on the cheapest rung of the ladder that meets the requested accuracy.

use mesh::Mesh;
use scene::Scene;

use super::{
    Accuracy,
    climb::{Climbed, climb},
    estimate::free_estimate,
    rest_ladder::RestLadder,
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, NoSink, Observer, SharedModels, StaticResult, StaticSink,
    error::in_scene, pair_rating, refused::Refusal, solved_load::under_loads, statics::CycleAnalysis,
};

/// A static scene to be solved with error bounds.
///
/// With `model = "auto"` the cheapest rung of the ladder is used that meets `[accuracy]`. The first guess comes from
/// the calibration, the proof from the error estimate of the run. If the accuracy is not met, the largest cause of the
/// error is refined. For other models the bounds of the run are estimated; for a scene without `[accuracy]` there are
/// none.
#[derive(Clone, Copy)]
pub struct StaticAnalysis<'a> {
    scene: &'a Scene,
    meshes: Option<[&'a Mesh; 2]>,
    cache: &'a dyn GearCache,
    shared: Option<&'a SharedModels<'a>>,
    tells_facts: bool,
}

impl std::fmt::Debug for StaticAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("StaticAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

impl<'a> StaticAnalysis<'a> {
    /// Analysis of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, meshes: None, cache: &NoCache, shared: None, tells_facts: true }
    }

    /// Uses meshes of pinion and wheel from the caller instead of those of the scene. They are checked like mesh files
    /// and have no error bounds.
    #[must_use]
    pub fn with_meshes(self, meshes: [&'a Mesh; 2]) -> Self {
        Self { meshes: Some(meshes), ..self }
    }

    /// Number of slices over the face width; `None` for a model without slices.
    pub fn slices(&self) -> Option<u32> {
        CycleAnalysis::new(self.scene).slices()
    }

    /// Uses reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Shares gears with earlier scenes of its kind, see [`SharedModels`]. Rungs of a ladder share nothing, because
    /// their meshes differ.
    #[must_use]
    pub fn with_shared(self, models: &'a SharedModels<'a>) -> Self {
        Self { shared: Some(models), ..self }
    }

    /// Positions and remarks alone; of a scene that asks for no accuracy, bounds are left out and of `iso` all that only
    /// files tell.
    #[must_use]
    pub(crate) fn without_facts(self) -> Self {
        Self { tells_facts: false, ..self }
    }

    /// Solves it without progress reports.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(&self) -> Result<StaticResult, AnalysisError> {
        self.solve_into(&mut NoObserver, &mut NoSink)
    }

    /// Solves it; positions are passed to `sink` as they are solved, again from the beginning at every rung.
    ///
    /// If the finest rung does not meet the accuracy, its result is returned nevertheless; [`Accuracy::is_met`] tells.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        &self,
        observer: &mut dyn Observer,
        sink: &mut dyn StaticSink,
    ) -> Result<StaticResult, AnalysisError> {
        let meshes = self.meshes.or(self.shared.and_then(|models| models.meshes()));
        if self.scene.accuracy.is_none() {
            let alone = CycleAnalysis::new(self.scene).with_cache(self.cache).with_meshes(meshes);
            let analysis = self.shared.map_or(alone, |models| alone.with_shared(models));
            if !self.tells_facts {
                return analysis.without_facts().solve_into(observer, sink);
            }
            let mut result = analysis.solve_into(observer, sink)?;
            // The laws of bounds are those of the built-in mesher.
            result.facts.accuracy = if meshes.is_none() { free_estimate(self.scene, &result)? } else { None };
            return Ok(result);
        }
        if meshes.is_some() {
            let hint = "leave [accuracy] out, or name the files of the meshes in the scene";
            return Err(in_scene(self.scene)(Refusal::input("there are no bounds of meshes in memory", hint)));
        }
        pair_rating::check(self.scene, &self.scene.gear_pair()?)?;
        let mut ladder = RestLadder::new(self.scene, self.cache, sink);
        let Climbed { solved: mut result, accuracy, tried, .. } = climb(&mut ladder, observer)?;
        result.facts.accuracy = Some(Accuracy { rungs: tried, ..accuracy });
        self.add_loads(&mut result, observer)?;
        Ok(result)
    }

    /// The loads of the scene's spectrum, solved with the model of the rung that was taken.
    fn add_loads(&self, result: &mut StaticResult, observer: &mut dyn Observer) -> Result<(), AnalysisError> {
        let (Some(rating), Some(model)) = (&self.scene.rating, &result.model) else { return Ok(()) };
        if rating.spectrum.is_none() {
            return Ok(());
        }
        result.scene.rating = Some(rating.clone());
        let solved = under_loads(&result.scene, model, (&|| true, observer));
        result.history.under_loads = solved.map_err(|failure| failure.into_error(self.scene))?;
        let said = pair_rating::remarks(&result.scene, &result.history);
        let new: Vec<_> = said.into_iter().filter(|own| !result.history.remarks.contains(own)).collect();
        result.history.remarks.extend(new);
        Ok(())
    }
}
