//! All files of a motion, or of motions at many values, but the rows of reduced gears; the table at their end.

use analysis::{
    in_time::{SolvedInTime, TimeAnswer},
    lumped::{BasinResult, BifurcationAnalysis, ContinuationResult, LumpedResult, SweepOptions},
    motion::{MotionResult, SweepResult},
};
use scene::Scene;

use crate::{
    Cost, ReportError, ResultFiles, close_result,
    folder::ResultDirectory,
    lumped_files::{
        SweepPage, basins_table, branch_table, lumped_sweep_table, lumped_table, write_basins, write_branch,
        write_key_sweep, write_lumped,
    },
    motion_files::{write_motion, write_sweep},
    tables::{motion_table, sweep_table},
    view::View,
    write_summary,
};

/// Of reduced gears, whose rows are written as they come.
fn write_motion_result(
    scene: &Scene,
    result: &MotionResult,
    cost: &Cost,
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    write_motion(scene, result, cost, view, results)?;
    let MotionResult { facts, headline, warnings, .. } = result;
    close_result(scene, (facts, cost), headline, warnings, results)?;
    Ok(motion_table(scene, facts, cost, headline, warnings))
}

/// Of steady states of reduced gears over speed.
fn write_sweep_result(
    scene: &Scene,
    result: &SweepResult,
    cost: &Cost,
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    write_sweep(scene, result, cost, view, results)?;
    let SweepResult { facts, headline, warnings, .. } = result;
    close_result(scene, (facts, cost), headline, warnings, results)?;
    Ok(sweep_table(scene, facts, cost, headline, warnings))
}

/// Of a cheaper model at many values of a key; `again`: words of `ale-gear sweep` that make it again.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_key_sweep_result(
    options: &SweepOptions,
    found: &BifurcationAnalysis,
    again: Option<&str>,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    let BifurcationAnalysis { scene, facts, headline, warnings, .. } = found;
    let page = SweepPage { headline, again };
    write_key_sweep(options, found, &page, cost, results)?;
    let summary = write_summary(scene, facts, cost, &page, warnings, &results.files()?);
    ResultFiles::write(results, "summary.json", summary.as_bytes())?;
    Ok(lumped_sweep_table(scene, facts, cost, headline, warnings))
}

/// Of periodic motions along a key.
fn write_continuation_result(
    scene: &Scene,
    found: &ContinuationResult,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    write_branch(scene, found, cost, results)?;
    let ContinuationResult { facts, headline, warnings, .. } = found;
    close_result(scene, (facts, cost), headline, warnings, results)?;
    Ok(branch_table(scene, facts, cost, headline, warnings))
}

/// Of basins of attraction.
fn write_basin_result(
    scene: &Scene,
    found: &BasinResult,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    write_basins(scene, found, cost, results)?;
    let BasinResult { facts, headline, warnings, .. } = found;
    close_result(scene, (facts, cost), headline, warnings, results)?;
    Ok(basins_table(scene, facts, cost, headline, warnings))
}

/// Of a cheaper model, its rows among them.
fn write_lumped_result(
    scene: &Scene,
    result: &LumpedResult,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    write_lumped(scene, result, cost, results)?;
    let LumpedResult { facts, headline, warnings, .. } = result;
    close_result(scene, (facts, cost), headline, warnings, results)?;
    Ok(lumped_table(scene, facts, cost, headline, warnings))
}

/// Of whichever analysis a scene in time asked for; `view`: the gears in space, of reduced ones.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_in_time(
    solved: &SolvedInTime,
    cost: &Cost,
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    let SolvedInTime { scene, answer } = solved;
    match answer {
        TimeAnswer::Motion(result) => write_motion_result(scene, result, cost, view, results),
        TimeAnswer::Lumped(result) => write_lumped_result(scene, result, cost, results),
        TimeAnswer::Speeds(result) => write_sweep_result(scene, result, cost, view, results),
        TimeAnswer::LumpedSpeeds { options, found } => write_key_sweep_result(options, found, None, cost, results),
        TimeAnswer::Branch(result) => write_continuation_result(scene, result, cost, results),
        TimeAnswer::Basins(result) => write_basin_result(scene, result, cost, results),
    }
}
