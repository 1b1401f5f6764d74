//! A gearbox, from a checked gearbox file to a result folder: what is computed stands in
//! [`analysis::gearbox_at_rest`], what is written in [`report::gearbox_files`].

use analysis::gearbox_at_rest::solve_gearbox;
use report::{folder::Cache, gearbox_files::write_gearbox};
use scene::gearbox::Gearbox;

use crate::{error::CommandError, output::ResultDirectory, phases::Phases};

/// Solves a gearbox as its file asks and writes all files of the result, also of one that does not hold: closing table,
/// and whether it holds.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no result comes out.
pub(crate) fn write_gearbox_result(
    file: &Gearbox,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<(String, Result<(), CommandError>), CommandError> {
    let result = solve_gearbox(file, cache, phases)?;
    let table = write_gearbox(file, &result, phases.cost(), results)?;
    Ok((table, result.verdict(file).map_err(CommandError::from)))
}
