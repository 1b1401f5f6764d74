//! A run at rest into files: fields for ParaView as positions come, and what the view of the gears in space needs.

use std::time::Instant;

use analysis::{SinkResult, StaticSink};
use ltca::{StaticModel, StaticPosition};
use scene::Scene;

use crate::{
    ResultFiles,
    paraview::FieldWriter,
    view::{View, ViewRecorder},
};

/// Writes fields and remembers the gears in space as positions come.
pub struct StaticFileSink<'a> {
    scene: &'a Scene,
    results: &'a dyn ResultFiles,
    fields: FieldWriter<'a>,
    recorder: ViewRecorder,
    start: Instant,
    /// Wall time to the first position, s.
    pub first_result_s: Option<f64>,
}

impl<'a> StaticFileSink<'a> {
    /// Of a scene; the time to the first position counts from `start`.
    pub fn new(scene: &'a Scene, results: &'a dyn ResultFiles, start: Instant) -> Self {
        let (fields, recorder) = (FieldWriter::new(scene, results), ViewRecorder::new(scene));
        Self { scene, results, fields, recorder, start, first_result_s: None }
    }

    /// The gears in space, from what the positions left.
    pub fn into_view(self, model: &StaticModel, warnings: &mut Vec<String>) -> Option<View> {
        self.recorder.view_or_warning(self.scene, model, warnings)
    }
}

impl StaticSink for StaticFileSink<'_> {
    fn begin(&mut self, scene: &Scene) {
        // As many positions as are solved; how time and teeth go is the same.
        *self = Self { recorder: ViewRecorder::new(scene), ..Self::new(self.scene, self.results, self.start) };
    }

    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) -> SinkResult {
        self.first_result_s.get_or_insert_with(|| self.start.elapsed().as_secs_f64());
        self.recorder.position(index, position, model);
        Ok(self.fields.position(index, position, model)?)
    }

    fn finish(&mut self) -> SinkResult {
        Ok(self.fields.finish()?)
    }
}
