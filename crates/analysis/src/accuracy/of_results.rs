//! Bounds of cycles that are solved already: the points of a chart.

use scene::{AccuracyScene, Scene};

use super::{Accuracy, companion::Companions, estimate::estimate, kept_gears::KeptGears};
use crate::{AnalysisError, NoCache, NoObserver, StaticResult};

/// Bounds of one result after the other; what they are held against is solved once where it is the same.
pub(crate) struct BoundsOfResults {
    kept: KeptGears<'static>,
    companions: Companions,
}

impl BoundsOfResults {
    /// Nothing solved yet.
    pub(crate) fn new() -> Self {
        Self { kept: KeptGears::new(&NoCache), companions: Companions::default() }
    }

    /// Those of a scene as it was solved, whatever accuracy it asks for.
    ///
    /// # Errors
    /// [`AnalysisError`] where what it is held against cannot be solved.
    pub(crate) fn of(&mut self, scene: &Scene, result: &StaticResult) -> Result<Accuracy, AnalysisError> {
        let scene = Scene { accuracy: AccuracyScene::default(), ..scene.clone() };
        estimate(&scene, result, &self.kept, &mut self.companions, &mut NoObserver)
    }
}
