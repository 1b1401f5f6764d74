//! A scene in time, whichever analysis it asked for.

use analysis::in_time::{SolvedInTime, TimeAnswer};

use super::{
    basins::write_basin_result,
    branch::write_continuation_result,
    key_sweep::write_key_sweep_result,
    lumped::write_lumped_result,
    motion::{write_motion_result, write_sweep_result},
};
use crate::{Cost, ReportError, Written};
use export::view::View;
use store::folder::ResultDirectory;

/// Writes the results of whichever analysis a scene in time asked for; `view`: the gears in space, of reduced ones.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_in_time(
    solved: &SolvedInTime,
    cost: &Cost,
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
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
