//! Runs of cheaper models, runs at many values of a key, and their files.

use analysis::lumped::{
    BasinAnalysis, ContinuationAnalysis, KeySweep, LumpedAnalysis, LumpedQuantity, NoLumpedSink, SweepOptions,
};
use report::{
    columns::{LumpedLayout, lumped_history::DTE, lumped_quantity},
    write_basin_result, write_continuation_result, write_key_sweep_result, write_lumped_result,
};

use report::folder::Cache;

use crate::{
    certificate::Written,
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    scene::{MotionScene, Scene},
};

/// Runs the model of a scene and writes all files of the result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    motion: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Written, CommandError> {
    if let Some(speeds) = &motion.sweep {
        let (scenes, options) = SweepOptions::over_speed(scene, speeds, quantity(scene, DTE.name)?);
        let table = sweep_key(&scenes, &options, None, phases, results, cache)?;
        return Ok(Written { table, verdict: Ok(()) });
    }
    if motion.continuation.is_some() || motion.basins.is_some() {
        return of_many_motions(scene, motion, phases, results, cache);
    }
    let result = LumpedAnalysis::new(scene).with_cache(cache).solve_into(phases, &mut NoLumpedSink)?;
    let table = write_lumped_result(scene, &result, &phases.cost(), results)?;
    Ok(Written { table, verdict: result.facts.verdict(scene).map_err(CommandError::from) })
}

/// Follows the periodic motions of a scene along a key, or looks for basins of attraction, and writes all files of the
/// result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn of_many_motions(
    scene: &Scene,
    motion: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Written, CommandError> {
    if motion.basins.is_some() {
        let found = BasinAnalysis::new(scene).with_cache(cache).solve_with(phases)?;
        let table = write_basin_result(scene, &found, &phases.cost(), results)?;
        return Ok(Written { table, verdict: found.facts.verdict(scene).map_err(CommandError::from) });
    }
    let found = ContinuationAnalysis::new(scene).with_cache(cache).solve_with(phases)?;
    let table = write_continuation_result(scene, &found, &phases.cost(), results)?;
    Ok(Written { table, verdict: found.facts.verdict(scene).map_err(CommandError::from) })
}

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
/// `scenes` in ascending order of the value; `again`: words of `ale-gear sweep` that make it again.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out at any value: one value without a motion has its
/// reason in its row.
pub(crate) fn sweep_key(
    scenes: &[(f64, Scene)],
    options: &SweepOptions,
    again: Option<&str>,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<String, CommandError> {
    let found = KeySweep::new(scenes, options).with_cache(cache).solve_with(phases)?;
    Ok(write_key_sweep_result(options, &found, again, &phases.cost(), results)?)
}
