//! All files of one motion but its rows, and the table at its end.

use analysis::{accuracy::motion::MotionAnswer, lumped::LumpedResult, motion::MotionResult};
use scene::Scene;

use crate::{
    Cost, ReportError, close_result,
    folder::ResultDirectory,
    lumped_files::{lumped_table, write_lumped},
    motion_files::write_motion,
    tables::motion_table,
    view::View,
};

/// Of reduced gears, whose rows are written as they come.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_motion_result(
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

/// Of a cheaper model, its rows among them.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_lumped_result(
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

/// Of whichever model was taken.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_answer(
    scene: &Scene,
    answer: &MotionAnswer,
    cost: &Cost,
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    match answer {
        MotionAnswer::Lumped(result) => write_lumped_result(scene, result, cost, results),
        MotionAnswer::Reduced(result) => write_motion_result(scene, result, cost, view, results),
    }
}
