//! A gearbox, from a checked gearbox file to a result folder: what is computed stands in
//! [`analysis::gearbox`], what is written in [`report::gearbox_files`].

use analysis::{Context, Ending};
use report::gearbox_files::write_gearbox;
use scene::gearbox::Gearbox;
use store::checkpoint::{GearboxFileSink, GearboxState};
use store::folder::Cache;

use crate::{
    certificate::Closing,
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    progression::{Outcome, Part, Progression},
};

/// Solves a gearbox as its file asks and writes all files of the result, also of one that does not hold; its motion in
/// parts, where that is asked for.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no result comes out.
pub(crate) fn solve(
    file: &Gearbox,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    progression: &Progression,
) -> Result<Outcome, CommandError> {
    progression.run(file, |part: Part<'_, GearboxState>| {
        let mut context: Context<'_, Gearbox> =
            Context::new(phases).with_cache(cache).stop_after(progression.stop_after);
        let (checkpoints, from) = part.map_or((None, None), |(checkpoints, from)| (Some(checkpoints), from));
        if let (Some(checkpoints), Some(stored)) = (checkpoints, &from) {
            let rows = stored.state.read_rows(checkpoints.folder.path())?;
            context = context.resume((stored.state.motion.clone(), rows));
        }
        let mut sink = checkpoints.map(|checkpoints| GearboxFileSink::new(checkpoints, from.as_ref()));
        if let Some(sink) = &mut sink {
            context = context.with_sink(sink);
        }
        let result = match analysis::solve(file, context)? {
            Ending::Stopped { cycles } => return Ok(Outcome::Stopped { cycles }),
            Ending::Finished(result) => result,
        };
        let table = write_gearbox(file, &result, phases.cost(), results)?.table;
        let verdict = result.verdict(file).map_err(CommandError::from);
        Ok(Outcome::Finished((table, verdict)))
    })
}

/// As [`solve`], in one piece; the text is the closing table.
///
/// # Errors
/// As [`solve`].
pub(crate) fn solve_whole(
    file: &Gearbox,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Closing, CommandError> {
    let context: Context<'_, Gearbox> = Context::new(phases).with_cache(cache);
    let result = analysis::solve(file, context)?.finished()?;
    let table = write_gearbox(file, &result, phases.cost(), results)?.table;
    Ok((table, result.verdict(file).map_err(CommandError::from)))
}
