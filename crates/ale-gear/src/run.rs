//! A scene at rest, with what goes into files on the way: fields for ParaView and the gears in space.

use std::time::Instant;

use analysis::{SinkResult, StaticAnalysis, StaticResult, StaticSink};
use ltca::{StaticError, StaticModel, StaticPosition};
use report::{paraview::FieldWriter, view::ViewRecorder};

pub(crate) use analysis::{foreseen_s, options, static_certificate as certificate};

use crate::{
    cache::Cache,
    error::CommandError,
    facts::Solved,
    output::{self, ResultDirectory},
    phases::Phases,
    scene::Scene,
};

/// Solves a scene; ParaView files, when asked for, go into `results` on the way. Reduced gears come from `cache` and go there.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no solution is found.
pub fn solve(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Solved, CommandError> {
    let mut sink = FileSink::new(scene, results, phases.start());
    let analysis = StaticAnalysis::new(scene).with_cache(cache);
    let StaticResult { mut history, mut facts, model, .. } = analysis.solve_into(phases, &mut sink)?;
    let Some(model) = model else { return Ok(Solved { history, facts, view: None }) };
    facts.first_result_s = sink.first_result_s;
    let root = output::root_stress_headline(&history).map(|root| root.largest_tensions());
    let mut warnings: Vec<String> = root.into_iter().flat_map(output::root_stress_warnings).collect();
    let recorder = sink.recorder;
    let view = phases.run("view", || recorder.view_or_warning(scene, &model, &mut warnings));
    history.warnings.extend(warnings);
    Ok(Solved { history, facts, view })
}

/// Writes fields and remembers the gears in space as positions come.
struct FileSink<'a> {
    scene: &'a Scene,
    results: &'a ResultDirectory,
    fields: FieldWriter<'a>,
    recorder: ViewRecorder,
    start: Instant,
    first_result_s: Option<f64>,
}

impl<'a> FileSink<'a> {
    fn new(scene: &'a Scene, results: &'a ResultDirectory, start: Instant) -> Self {
        let (fields, recorder) = (FieldWriter::new(scene, results), ViewRecorder::new(scene));
        Self { scene, results, fields, recorder, start, first_result_s: None }
    }
}

impl StaticSink for FileSink<'_> {
    fn begin(&mut self) {
        *self = Self::new(self.scene, self.results, self.start);
    }

    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) -> SinkResult {
        self.first_result_s.get_or_insert_with(|| self.start.elapsed().as_secs_f64());
        self.recorder.position(index, position, model);
        Ok(self.fields.position(index, position, model).map_err(CommandError::from)?)
    }

    fn finish(&mut self) -> SinkResult {
        Ok(self.fields.finish().map_err(CommandError::from)?)
    }
}

/// Wrong input is status 2, a solver that finds no answer status 1.
pub(crate) fn complaint(scene: &Scene, error: &StaticError) -> CommandError {
    analysis::solver_error(scene, error.clone()).into()
}
