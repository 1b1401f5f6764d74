//! Solves the cases of a plan side by side, and writes each down as it comes.

use std::{
    io,
    ops::Range,
    sync::{Mutex, PoisonError},
};

use analysis::{Context, Ending, Observer, Progress, SharedModels, WarningsAtRest, side_by_side, solve};
use scene::plan::Plan;

use crate::{CaseRow, DoneCases, case_values};

/// Makes who hears of one case while it is solved.
pub type CaseObserver<'a> = &'a (dyn Fn() -> Box<dyn Observer> + Sync);

/// Solves the cases of a plan, in a range of their numbers, that are not done yet, each on a thread of its own; `done`
/// gets each as it comes, and `progress` hears of it. Cases that have not begun when it is cancelled are not done, nor are
/// those that end without a result then.
///
/// A case without a result takes nothing from the others: its row says why.
///
/// # Errors
/// When the system refuses to write a row.
pub fn solve_cases(
    (plan, range): (&Plan, Range<usize>),
    models: &SharedModels<'_>,
    observer: CaseObserver<'_>,
    done: &DoneCases,
    progress: &dyn Progress,
) -> io::Result<()> {
    let open: Vec<usize> = range.filter(|&case| !done.has(case)).collect();
    let failed = Mutex::new(None);
    let failure = || failed.lock().unwrap_or_else(PoisonError::into_inner);
    side_by_side(open.len(), |i| {
        if failure().is_some() || progress.is_cancelled() {
            return;
        }
        let case = open[i];
        let outcome = numbers(plan, models, &mut *observer(), case);
        if outcome.is_err() && progress.is_cancelled() {
            return;
        }
        let row = CaseRow { case, values: plan.values(case), outcome };
        if let Err(e) = done.add(row) {
            *failure() = Some(e);
        }
        progress.tick();
    });
    failed.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}

/// The numbers of a case, or why there are none. Its rows are gone when they are taken.
fn numbers(
    plan: &Plan,
    models: &SharedModels<'_>,
    observer: &mut dyn Observer,
    case: usize,
) -> Result<Vec<f64>, String> {
    let mut scene = plan.scene(case).map_err(|e| e.to_string())?;
    // Nobody looks at these.
    (scene.output.vtu, scene.output.parquet, scene.output.contact_lines) = (false, false, false);
    let context = Context::new(observer).with_models(models).with_warnings(WarningsAtRest::Left);
    let solved = solve(&scene, context).and_then(Ending::finished).map_err(|e| e.to_string())?;
    solved.verdict().map_err(|e| e.to_string())?;
    case_values(&plan.outputs, &solved)
}
