//! Scenes in time, from a checked scene to a result folder: what is computed stands in [`analysis::in_time`], what is
//! written in [`report::write_in_time`]. What is added here are the checkpoints of one motion.

use std::sync::Arc;

use analysis::{Context, Ending, Solved, in_time::is_one_motion, motion::MotionLayout};
use export::MotionFileSink;
use report::write_in_time;
use store::checkpoint::{ENERGY_FILE, HISTORY, PairState, read_rows};
use store::folder::Cache;

use crate::{
    certificate::Written,
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    progression::{Outcome, Part, Progression},
    scene::Scene,
};

/// Solves a scene in time, in one piece, and writes all files of the result, also of one that does not hold.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve_whole(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Written, CommandError> {
    let mut sink = MotionFileSink::new(scene, results.folder(), None, None);
    if is_one_motion(scene) {
        sink = sink.with_fields(results);
    }
    let context: Context<'_, Scene> = Context::new(phases).with_cache(cache);
    let solved = analysis::solve(scene, context.with_sink(&mut sink))?;
    let solved = solved.finished()?.in_time()?;
    let cost = phases.cost();
    let table = write_in_time(&solved, &cost, sink.view.as_ref(), results)?.table;
    let verdict = solved.verdict().map_err(CommandError::from);
    Ok(Written { table, verdict, solved: Solved::InTime(solved), cost })
}

/// Runs a scene in time and writes all files of the result; one motion in parts, where that is asked for.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    progression: &Progression,
) -> Result<Outcome, CommandError> {
    progression.run(scene, |part: Part<'_, PairState>| {
        let Some((checkpoints, from)) = part else {
            let Written { table, verdict, .. } = solve_whole(scene, phases, results, cache)?;
            return Ok(Outcome::Finished((table, verdict)));
        };
        let folder = checkpoints.folder.path();
        let mut context: Context<'_, Scene> = Context::new(phases).with_cache(cache).stop_after(progression.stop_after);
        if let Some(stored) = &from {
            let checkpoint = stored.state.checkpoint();
            let layout = MotionLayout::of(scene, checkpoint.window);
            let rows = read_rows(&layout, folder, &stored.state.rows)?;
            context = context.resume((checkpoint, Arc::new(rows)));
        }
        let mut sink = MotionFileSink::new(scene, folder, Some(checkpoints), from.as_ref()).with_fields(results);
        let solved = match analysis::solve(scene, context.with_sink(&mut sink))? {
            Ending::Stopped { cycles } => return Ok(Outcome::Stopped { cycles }),
            Ending::Finished(solved) => solved.in_time()?,
        };
        for file in [HISTORY, ENERGY_FILE] {
            results.copy(&folder.join(file), file)?;
        }
        let table = write_in_time(&solved, &phases.cost(), sink.view.as_ref(), results)?.table;
        Ok(Outcome::Finished((table, solved.verdict().map_err(CommandError::from))))
    })
}
