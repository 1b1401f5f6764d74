//! A scene in time, from its answer to the files of its result.

use analysis::{
    AnalysisError, Context, GearCache, Observer,
    in_time::{SolvedInTime, is_one_motion},
};
use mesh::Mesh;
use scene::Scene;

use crate::{Cost, ReportError, Written, motion_files::MotionFileSink, pair_files::write_in_time};
use store::folder::ResultDirectory;

/// Hears of the phases, and knows what they cost.
pub trait Recorder: Observer {
    /// What it all cost so far.
    fn cost(&self) -> Cost;
}

/// A scene in time whose files are written.
#[derive(Debug)]
pub struct WrittenInTime {
    /// The answer; whether it holds is told by [`SolvedInTime::verdict`].
    pub solved: Box<SolvedInTime>,
    /// What it took, as `summary.json` has it.
    pub cost: Cost,
    /// The answer as its files have it.
    pub written: Written,
}

/// What files say against an analysis.
fn unwritten(error: ReportError) -> AnalysisError {
    AnalysisError::Sink(Box::new(error))
}

/// Solves a scene in time, in one piece, and writes all files of the result; `meshes` of pinion and wheel take the place
/// of the scene's where reduced gears move by themselves.
///
/// # Errors
/// As [`analysis::solve`]; of files as [`AnalysisError::Sink`] with a [`ReportError`].
pub fn solve_in_time(
    scene: &Scene,
    meshes: Option<[&Mesh; 2]>,
    recorder: &mut dyn Recorder,
    results: &ResultDirectory,
    cache: &dyn GearCache,
) -> Result<WrittenInTime, AnalysisError> {
    let mut sink = MotionFileSink::new(scene, results.folder(), None, None);
    if is_one_motion(scene) {
        sink = sink.with_fields(results);
    }
    let context = Context::new(recorder).with_meshes(meshes).with_cache(cache).with_sink(&mut sink);
    let solved = analysis::solve(scene, context)?.finished()?.in_time()?;
    let cost = recorder.cost();
    let written = write_in_time(&solved, &cost, sink.view.as_ref(), results).map_err(unwritten)?;
    Ok(WrittenInTime { solved, cost, written })
}
