//! Receives the positions of a static pair as they are solved.

use ltca::{StaticModel, StaticPosition};
use scene::Scene;

/// Receives the positions of a static analysis as they are solved.
pub trait StaticSink {
    /// Called when the analysis of a scene, as solved, begins, and again if a wider window or a finer rung is needed;
    /// earlier results are then discarded.
    fn begin(&mut self, scene: &Scene);

    /// Called for each position in order; the model is in the state of that position.
    ///
    /// # Errors
    /// Any error ends the analysis and is returned as `AnalysisError::Sink`.
    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) -> SinkResult;

    /// Called when all positions have been solved.
    ///
    /// # Errors
    /// Those of [`StaticSink::position`].
    fn finish(&mut self) -> SinkResult;
}

/// Result of a sink's method.
pub type SinkResult = Result<(), Box<dyn std::error::Error + Send + Sync>>;

/// Sink that takes nothing: the result has all positions.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoSink;

impl StaticSink for NoSink {
    fn begin(&mut self, _: &Scene) {}

    fn position(&mut self, _: usize, _: &StaticPosition, _: &StaticModel) -> SinkResult {
        Ok(())
    }

    fn finish(&mut self) -> SinkResult {
        Ok(())
    }
}
