//! A scene at rest, with what goes into files on the way: fields for ParaView and the gears in space.

use std::time::Instant;

use analysis::{SinkResult, StaticAnalysis, StaticResult, StaticSink};
use ltca::{StaticError, StaticModel, StaticPosition};
use report::{paraview::FieldWriter, view::ViewRecorder};

pub(crate) use analysis::{foreseen_s, options, static_certificate as certificate, time_again};

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
    Ok(solve_scene(scene, phases, results, cache, true)?.0)
}

/// As [`solve`], without the gears in space; the model comes back too, its gears reduced: for more of the same. `None` for a
/// model without meshes.
///
/// # Errors
/// Those of [`solve`].
pub(crate) fn solve_and_keep(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<(Solved, Option<StaticModel>), CommandError> {
    solve_scene(scene, phases, results, cache, false)
}

fn solve_scene(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    in_space: bool,
) -> Result<(Solved, Option<StaticModel>), CommandError> {
    let mut sink = FileSink::new(scene, results, phases.start());
    let analysis = StaticAnalysis::new(scene).with_cache(cache);
    let StaticResult { mut history, mut facts, model, .. } = analysis.solve_into(phases, &mut sink)?;
    let Some(model) = model else { return Ok((Solved { history, facts, view: None }, None)) };
    facts.first_result_s = sink.first_result_s;
    let root = output::root_stress_headline(&history).map(|root| root.largest_tensions());
    let mut warnings: Vec<String> = root.into_iter().flat_map(output::root_stress_warnings).collect();
    let recorder = sink.recorder;
    let view =
        in_space.then(|| phases.run("view", || recorder.view_or_warning(scene, &model, &mut warnings))).flatten();
    history.warnings.extend(warnings);
    Ok((Solved { history, facts, view }, Some(model)))
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
