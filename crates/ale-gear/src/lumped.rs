//! Runs at many values of a key, and their files.

use analysis::lumped::{KeySweep, LumpedQuantity, SweepOptions};
use columns::{LumpedLayout, lumped_quantity};
use report::write_key_sweep_result;

use store::folder::Cache;

use crate::{error::CommandError, output::ResultDirectory, phases::Phases, scene::Scene};

/// The column of that name of a scene's rows.
///
/// # Errors
/// Exit status 2 for a column that the model does not write.
pub(crate) fn quantity(scene: &Scene, name: &str) -> Result<LumpedQuantity, CommandError> {
    lumped_quantity(scene, name).ok_or_else(|| {
        let whose = format!("{}: the model writes no column `{name}`", scene.file.display());
        let names = LumpedLayout::of(scene).sheet().names();
        CommandError::input(whose, Some(format!("it writes {}", names.join(", "))))
    })
}

/// Runs the model of a scene at each value, way by way; writes all files of the result, the text is the closing table.
///
/// `scenes` in ascending order of the value; `again`: the command that makes it again.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out at any value: one value without a motion has its
/// reason in its row.
pub(crate) fn sweep_key(
    scenes: &[(f64, Scene)],
    options: &SweepOptions,
    again: &str,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<String, CommandError> {
    let found = KeySweep::new(scenes, options).with_cache(cache).solve_with(phases)?;
    Ok(write_key_sweep_result(options, &found, Some(again), &phases.cost(), results)?.table)
}
