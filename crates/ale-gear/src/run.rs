//! A scene at rest, with what goes into files on the way: fields for ParaView and the gears in space.

use analysis::StaticResult;
use analysis::accuracy::{AccurateAnalysis, AccurateResult};
use report::StaticFileSink;

pub(crate) use analysis::static_certificate as certificate;

use report::folder::Cache;

use crate::{
    error::CommandError,
    facts::Solved,
    output::{self, ResultDirectory},
    phases::Phases,
    scene::Scene,
};

/// Solves a scene; ParaView files, when asked for, go into `results` on the way. Reduced gears come from `cache` and go
/// there.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no solution is found.
pub fn solve(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Solved, CommandError> {
    let mut sink = StaticFileSink::new(scene, results, phases.start());
    let analysis = AccurateAnalysis::new(scene).with_cache(cache);
    let AccurateResult { scene, result } = analysis.solve_into(phases, &mut sink)?;
    let StaticResult { mut history, mut facts, model, .. } = result;
    let Some(model) = model else { return Ok(Solved { scene, history, facts, view: None }) };
    facts.first_result_s = sink.first_result_s;
    let root = output::root_stress_headline(&history).map(|root| root.largest_tensions());
    let mut warnings: Vec<String> = root.into_iter().flat_map(output::root_stress_warnings).collect();
    let view = phases.run("view", || sink.into_view(&model, &mut warnings));
    history.warnings.extend(warnings);
    Ok(Solved { scene, history, facts, view })
}
