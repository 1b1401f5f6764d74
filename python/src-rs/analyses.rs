//! What a pair is asked beside one load at rest: in time, along a key, over many cases, at its optimum. Each is written
//! into a folder that goes with the result, by the functions that the command has.

use std::ops::ControlFlow;

use ::mesh::Mesh;
use ::plan::{CaseLines, DoneCases, OptimumError, check_numbers, optimise_numbers, solve_cases};
use ::scene::{
    Scene,
    optimum::{NumberOptimisation, Optimisation},
    plan::Plan,
};
use analysis::{
    AnalysisError, Context, GearCache, Observer, PhaseWork, Recorder, SharedModels,
    in_time::is_one_motion,
    optimum::{optimise, summarise},
    solve,
};
use export::MotionFileSink;
use report::{
    optimum_files::{NumberOptimumResult, OptimumResult, write_number_optimum, write_optimum},
    plan_files::{PageWords, write_cases},
    write_in_time,
};
use store::folder::ResultDirectory;
use tempfile::TempDir;

use crate::{
    error::{Complaint, Kind},
    result::{FILES, Result},
    work::Watch,
};

type Answer = std::result::Result<Result, Complaint>;

/// What all of them are solved on.
#[derive(Clone, Copy)]
pub struct Held<'a> {
    /// Models that are reduced already.
    pub models: &'a SharedModels<'a>,
    /// Reduced gears.
    pub cache: &'a dyn GearCache,
    /// Meshes of the caller.
    pub meshes: Option<[&'a Mesh; 2]>,
}

/// A scene in time.
pub fn in_time(scene: &Scene, held: Held<'_>, watch: &mut Watch) -> Answer {
    let folder = TempDir::new()?;
    let results = ResultDirectory::create(&folder.path().join(FILES))?;
    let mut sink = MotionFileSink::new(scene, results.folder(), None, None);
    if is_one_motion(scene) {
        sink = sink.with_fields(&results);
    }
    let context: Context<'_, Scene> =
        Context::new(watch).with_meshes(held.meshes).with_cache(held.cache).with_sink(&mut sink);
    let solved = solve(scene, context)?.finished()?.in_time()?;
    let written = write_in_time(&solved, &watch.cost(), sink.view.as_ref(), &results)?;
    results.finish(drop)?;
    let failure = solved.verdict().err().map(Complaint::from);
    Result::written("dynamic", written.answer, folder, failure)
}

/// Many cases of a scene, a row a case; `again`: the call that makes it again.
pub fn vary(plan: &Plan, again: &str, held: Held<'_>, watch: &mut Watch) -> Answer {
    let folder = TempDir::new()?;
    let results = ResultDirectory::create(&folder.path().join(FILES))?;
    let done = DoneCases::in_memory(CaseLines::of(plan), Default::default());
    let count = plan.cases.count();
    let progress = watch.open("cases", PhaseWork::Steps(count as u64));
    let beside = watch.beside();
    solve_cases((plan, 0..count), held.models, &|| Box::new(beside.beside()), &done, &*progress)?;
    watch.end();
    analysis::unless_cancelled(&*progress)?;
    let words = PageWords { again, ..PageWords::default() };
    let written = write_cases((plan, &done), words, watch.cost(), &results)?;
    results.finish(drop)?;
    Result::written("plan", written.answer, folder, None)
}

/// The quietest micro-geometry; `again`: words of the command that make it again.
pub fn optimum(plan: &Optimisation, again: &str, held: Held<'_>, watch: &mut Watch) -> Answer {
    let folder = TempDir::new()?;
    let results = ResultDirectory::create(&folder.path().join(FILES))?;
    let progress = watch.open("search", PhaseWork::Steps(u64::from(plan.evaluations)));
    let found = optimise(held.models, plan, |which, goal| {
        progress.tick();
        progress.say(goal.map_or_else(|| which.to_string(), |goal| format!("{goal:.4} um")));
        if progress.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    watch.end();
    watch.open("tell", PhaseWork::Unknown);
    let summary = summarise(held.models, &found)?;
    watch.end();
    let scene = found.plan.own_scene(&found.values).map_err(AnalysisError::from)?.standing_alone();
    let of = OptimumResult { optimum: &found, summary: &summary, scene: &scene, again };
    let written = write_optimum(&of, watch.cost(), &results)?;
    results.finish(drop)?;
    Result::written("optimum", written.answer, folder, None)
}

/// The design whose numbers are smallest within limits; `again`: the call that makes it again.
pub fn number_optimum(plan: &NumberOptimisation, again: &str, held: Held<'_>, watch: &mut Watch) -> Answer {
    let start = plan.machine(&plan.start()).map_err(AnalysisError::from)?;
    check_numbers(&start, &plan.outputs(), &plan.file)
        .map_err(|e| Complaint::new(Kind::Input, &e, Some(e.hint.clone())))?;
    let folder = TempDir::new()?;
    let results = ResultDirectory::create(&folder.path().join(FILES))?;
    let progress = watch.open("search", PhaseWork::Steps(u64::from(plan.evaluations)));
    let lines = CaseLines::new(plan.parameters.len(), plan.outputs().len());
    let (done, beside) = (DoneCases::in_memory(lines, Default::default()), watch.beside());
    let found = optimise_numbers(plan, held.models, &|| Box::new(beside.beside()), &done, |which, goal| {
        progress.tick();
        progress.say(goal.map_or_else(|| which.to_string(), |goal| format!("{goal:.6}")));
        if progress.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let optimum = found.map_err(|e| match e {
        OptimumError::Cancelled => AnalysisError::Cancelled.into(),
        e => Complaint::new(Kind::NoResult, &e, None),
    })?;
    watch.end();
    let of = NumberOptimumResult { plan, optimum: &optimum, again };
    let written = write_number_optimum(&of, watch.cost(), &results)?;
    results.finish(drop)?;
    Result::written("optimum", written.answer, folder, None)
}
