//! A gearbox, from a checked gearbox file to a result folder: what is computed stands in
//! [`analysis::gearbox_at_rest`], what is written in [`report::gearbox_files`].

use analysis::gearbox_at_rest::{GearboxAnalysis, GearboxOutcome, GearboxSink, NoGearboxSink};
use report::{
    checkpoint::{GearboxFileSink, GearboxState},
    folder::Cache,
    gearbox_files::write_gearbox,
};
use scene::gearbox::Gearbox;

use crate::{
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
        let mut analysis = GearboxAnalysis::new(file).with_cache(cache).stop_after(progression.stop_after);
        let (checkpoints, from) = part.map_or((None, None), |(checkpoints, from)| (Some(checkpoints), from));
        if let (Some(checkpoints), Some(stored)) = (checkpoints, &from) {
            let rows = stored.state.read_rows(checkpoints.folder.path())?;
            analysis = analysis.resume(stored.state.motion.clone(), rows);
        }
        let mut sink: Box<dyn GearboxSink> = match checkpoints {
            Some(checkpoints) => Box::new(GearboxFileSink::new(checkpoints, from.as_ref())),
            None => Box::new(NoGearboxSink),
        };
        let result = match analysis.solve_into(phases, &mut *sink)? {
            GearboxOutcome::Stopped { cycles } => return Ok(Outcome::Stopped { cycles }),
            GearboxOutcome::Finished(result) => result,
        };
        let table = write_gearbox(file, &result, phases.cost(), results)?.table;
        let verdict = result.verdict(file).map_err(CommandError::from);
        Ok(Outcome::Finished((table, verdict)))
    })
}
