//! Solves the cases of a plan side by side, and writes each down as it comes.

use std::{
    io,
    ops::Range,
    sync::{Mutex, PoisonError},
};

use analysis::{Progress, SharedModels, side_by_side};
use scene::{Kind, Scene, plan::Plan};
use serde_json::Value;
use study::Columns;

use super::{CaseRow, CaseTable, DoneCases, case_values, static_case_values};

/// Rows and headline of a scene in time, or why there are none.
pub type InTime<'a> = &'a (dyn Fn(usize, &Scene) -> Result<(Columns, Value), String> + Sync);

/// Solves the cases of a plan, in a range of their numbers, that are not done yet, each on a thread of its own; `done` gets each as it comes, and
/// `progress` hears of it. Cases that have not begun when it is cancelled are not done.
///
/// A case without a result takes nothing from the others: its row says why.
///
/// # Errors
/// When the system refuses to write a row.
pub fn solve_cases(
    (plan, range): (&Plan, Range<usize>),
    models: &SharedModels<'_>,
    in_time: InTime<'_>,
    done: &DoneCases,
    progress: &dyn Progress,
) -> io::Result<()> {
    let open: Vec<usize> = range.filter(|&case| !done.has(case)).collect();
    let (table, failed) = (CaseTable::of(plan), Mutex::new(None));
    let failure = || failed.lock().unwrap_or_else(PoisonError::into_inner);
    side_by_side(open.len(), |i| {
        if failure().is_some() || progress.is_cancelled() {
            return;
        }
        let case = open[i];
        let row = CaseRow { case, values: plan.values(case), outcome: solve(plan, models, in_time, case) };
        if let Err(e) = done.add(case, table.line(&row)) {
            *failure() = Some(e);
        }
        progress.tick();
    });
    failed.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}

/// The numbers of a case, or why there are none.
fn solve(plan: &Plan, models: &SharedModels<'_>, in_time: InTime<'_>, case: usize) -> Result<Vec<f64>, String> {
    let mut scene = plan.scene(case).map_err(|e| e.to_string())?;
    // Nobody looks at these.
    (scene.output.vtu, scene.output.parquet, scene.output.contact_lines) = (false, false, false);
    if scene.analysis.kind == Kind::Static {
        let (scene, history, derivatives) = models.solve_with_derivatives(&scene).map_err(|e| e.to_string())?;
        return static_case_values(&plan.outputs, (&scene, &history, derivatives.as_ref()));
    }
    let (rows, headline) = in_time(case, &scene)?;
    case_values(&plan.outputs, &rows, &headline, scene.analysis.cycles)
}
