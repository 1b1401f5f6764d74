//! A run at rest into files: fields for ParaView as positions come, and what the view of the gears in space needs.

use std::time::Instant;

use analysis::{AnalysisError, DerivativeRecorder, Derivatives, SinkResult, StaticSink};
use ltca::{StaticModel, StaticPosition};
use scene::Scene;

use crate::{
    paraview::FieldWriter,
    view::{View, ViewRecorder},
};
use store::ResultFiles;

/// Writes fields, differentiates and remembers the gears in space as positions come.
pub struct StaticFileSink<'a> {
    scene: &'a Scene,
    results: &'a dyn ResultFiles,
    fields: FieldWriter<'a>,
    recorder: Option<ViewRecorder>,
    /// Why there is none is told at the first position.
    derivatives: Result<Option<DerivativeRecorder>, Option<AnalysisError>>,
    start: Instant,
    /// Wall time to the first position, s.
    pub first_result_s: Option<f64>,
}

impl<'a> StaticFileSink<'a> {
    /// Sink of a scene; the time to the first position counts from `start`.
    pub fn new(scene: &'a Scene, results: &'a dyn ResultFiles, start: Instant) -> Self {
        let (fields, recorder) = (FieldWriter::new(scene, results), Some(ViewRecorder::new(scene)));
        Self { scene, results, fields, recorder, derivatives: Ok(None), start, first_result_s: None }
    }

    /// Takes the derivatives that the scene asks for.
    pub fn take_derivatives(&mut self) -> Option<Derivatives> {
        let recorder = self.derivatives.as_mut().ok()?.take()?;
        Some(recorder.into_derivatives())
    }

    /// Remembering nothing of the gears in space.
    #[must_use]
    pub fn without_view(self) -> Self {
        Self { recorder: None, ..self }
    }

    /// The gears in space, from what the positions left.
    pub fn into_view(self, model: &StaticModel, remarks: &mut Vec<answer::Remark>) -> Option<View> {
        self.recorder?.view_or_remark(self.scene, model, remarks)
    }
}

impl StaticSink for StaticFileSink<'_> {
    fn begin(&mut self, scene: &Scene) {
        // As many positions as are solved; how time and teeth go is the same.
        *self = Self {
            recorder: self.recorder.as_ref().map(|_| ViewRecorder::new(scene)),
            derivatives: DerivativeRecorder::new(scene).map_err(Some),
            ..Self::new(self.scene, self.results, self.start)
        };
    }

    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) -> SinkResult {
        self.first_result_s.get_or_insert_with(|| self.start.elapsed().as_secs_f64());
        if let Some(recorder) = &mut self.recorder {
            recorder.position(index, position, model);
        }
        match &mut self.derivatives {
            Ok(Some(recorder)) => recorder.position(model)?,
            Ok(None) => {}
            Err(why) => return why.take().map_or(Ok(()), |why| Err(why.into())),
        }
        Ok(self.fields.position(index, position, model)?)
    }

    fn finish(&mut self) -> SinkResult {
        Ok(self.fields.finish()?)
    }
}
