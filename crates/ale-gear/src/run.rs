//! A scene at rest, with what goes into files on the way: fields for ParaView and the gears in space.

use analysis::{SolvedAtRest, StaticAnalysis, StaticResult};
use export::StaticFileSink;
use export::view::View;

pub(crate) use analysis::static_certificate as certificate;

use store::folder::Cache;

use crate::{
    error::CommandError,
    facts::ForFiles,
    output::{self, ResultDirectory},
    phases::Phases,
    scene::Scene,
};

/// What a report shows of the gears in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InSpace {
    /// Displacement and root stress on the teeth of the window.
    Fields,
    /// The contact bands alone, which cost nothing.
    Bands,
}

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
    in_space: InSpace,
) -> Result<ForFiles, CommandError> {
    let mut sink = StaticFileSink::new(scene, results, phases.start());
    if in_space == InSpace::Bands {
        sink = sink.without_view();
    }
    let analysis = StaticAnalysis::new(scene).with_cache(cache);
    let StaticResult { scene, pair, mut history, mut facts, model } = analysis.solve_into(phases, &mut sink)?;
    let derivatives = sink.take_derivatives();
    let Some(model) = model else {
        return Ok(ForFiles { solved: SolvedAtRest { scene, history, derivatives }, facts, view: None });
    };
    facts.first_result_s = sink.first_result_s;
    let root = output::root_stress_headline(&history).map(|root| root.largest_tensions());
    let mut remarks: Vec<_> = root.into_iter().flat_map(output::root_stress_remarks).collect();
    let view = match in_space {
        InSpace::Fields => phases.run("view", || sink.into_view(&model, &mut remarks)),
        InSpace::Bands => Some(View::of_history(&scene, &pair, &history)),
    };
    history.remarks.extend(remarks);
    Ok(ForFiles { solved: SolvedAtRest { scene, history, derivatives }, facts, view })
}
