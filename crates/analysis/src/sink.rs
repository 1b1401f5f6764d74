//! Who gets the positions of a pair at rest as they are solved.

use ltca::{StaticModel, StaticPosition};
use scene::Scene;

/// Gets the positions of a static analysis as they are solved.
pub trait StaticSink {
    /// The analysis of a scene as it is solved begins, again where a wider window or a finer rung is needed: what came
    /// before does not count.
    fn begin(&mut self, scene: &Scene);

    /// A position, in order; the model is where it was found.
    ///
    /// # Errors
    /// Whatever ends the analysis; it comes back as `AnalysisError::Sink`.
    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) -> SinkResult;

    /// All positions have come.
    ///
    /// # Errors
    /// As [`StaticSink::position`].
    fn finish(&mut self) -> SinkResult;
}

/// What a sink says.
pub type SinkResult = Result<(), Box<dyn std::error::Error + Send + Sync>>;

/// Takes nothing: the result holds all positions.
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
