//! Error bounds of cycles that are already solved: the points of a chart.

use scene::{AccuracyScene, Scene};

use super::{Accuracy, companion::Companions, estimate::estimate, gear_memo::GearMemo};
use crate::{AnalysisError, GearCache, NoCache, NoObserver, StaticResult};

/// Bounds of one result after the other; what they are held against is solved once where it is the same.
pub(crate) struct BoundsOfResults {
    kept: GearMemo<'static>,
    companions: Companions,
}

impl BoundsOfResults {
    /// Nothing solved yet.
    pub(crate) fn new() -> Self {
        Self { kept: GearMemo::new(&NoCache), companions: Companions::default() }
    }

    /// Bounds of a scene as it was solved, for any request of accuracy.
    ///
    /// # Errors
    /// [`AnalysisError`] where what it is held against cannot be solved.
    pub(crate) fn of(&mut self, scene: &Scene, result: &StaticResult) -> Result<Accuracy, AnalysisError> {
        bounds_of(scene, result, &self.kept, &mut self.companions)
    }
}

/// Bounds of a result, whatever accuracy its scene asks for; what it is held against is solved with a cache.
///
/// # Errors
/// [`AnalysisError`] where what it is held against cannot be solved.
pub(crate) fn bounds_of(
    scene: &Scene,
    result: &StaticResult,
    cache: &dyn GearCache,
    companions: &mut Companions,
) -> Result<Accuracy, AnalysisError> {
    let scene = Scene { accuracy: AccuracyScene::default(), ..scene.clone() };
    estimate(&scene, result, cache, companions, &mut NoObserver)
}
