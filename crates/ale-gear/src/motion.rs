//! Motions of reduced gears, from a checked scene to a result folder: what is computed stands in [`analysis::motion`],
//! what is written in [`report::motion_files`] and [`report::checkpoint`].

use analysis::{
    AnalysisError,
    motion::{MotionAnalysis, MotionLayout, MotionOutcome},
};
use report::{
    checkpoint::{ENERGY_FILE, HISTORY, PairState, read_rows},
    motion_files::MotionFileSink,
    write_motion_result,
};

use report::folder::Cache;

use crate::{
    certificate::Written,
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    progression::{Outcome, Part, Progression},
    scene::{MotionScene, Scene},
};

/// Runs the motion of a scene and writes all files of the result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    motion: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    progression: &Progression,
) -> Result<Outcome, CommandError> {
    if motion.continuation.is_some() || motion.basins.is_some() {
        return finished(report::solve_many_motions(scene, motion, phases, results, cache));
    }
    if motion.sweep.is_some() {
        return finished(report::solve_sweep(scene, phases, results, cache));
    }
    if !scene.accuracy.is_none() {
        return finished(report::solve_accurate(scene, phases, results, cache));
    }
    progression.run(scene, |part| one_motion(scene, phases, (results, cache), part, progression.stop_after))
}

fn finished(told: Result<report::Told, AnalysisError>) -> Result<Outcome, CommandError> {
    Ok(Outcome::Finished(Written::of(told?)))
}

/// One motion, from a state where there is one.
fn one_motion(
    scene: &Scene,
    phases: &mut Phases,
    (results, cache): (&ResultDirectory, &Cache),
    part: Part<'_, PairState>,
    stop_after: Option<u64>,
) -> Result<Outcome, CommandError> {
    let (checkpoints, from) = part.map_or((None, None), |(checkpoints, from)| (Some(checkpoints), from));
    let folder = checkpoints.map_or(results.folder(), |c| c.folder.path());
    let mut analysis = MotionAnalysis::new(scene).with_cache(cache).stop_after(stop_after);
    if let Some(stored) = &from {
        let checkpoint = stored.state.checkpoint();
        let layout = MotionLayout::of(scene, checkpoint.window);
        let rows = read_rows(&layout, folder, &stored.state.rows)?;
        analysis = analysis.resume(checkpoint, rows);
    }
    let mut sink = MotionFileSink::new(scene, folder, checkpoints, from.as_ref()).with_fields(results);
    match analysis.solve_into(phases, &mut sink)? {
        MotionOutcome::Stopped { cycles } => Ok(Outcome::Stopped { cycles }),
        MotionOutcome::Finished(result) => {
            let view = sink.view.take();
            if checkpoints.is_some() {
                for file in [HISTORY, ENERGY_FILE] {
                    results.copy(&folder.join(file), file)?;
                }
            }
            let table = write_motion_result(scene, &result, &phases.cost(), view.as_ref(), results)?;
            Ok(Outcome::Finished(Written { table, verdict: result.facts.verdict(scene).map_err(CommandError::from) }))
        }
    }
}
