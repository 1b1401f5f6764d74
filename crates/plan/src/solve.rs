//! Solves the cases of a plan side by side, and writes each down as it comes.

use std::{
    io,
    ops::Range,
    sync::{Mutex, PoisonError},
};

use analysis::{
    AnalysisError, Context, Ending, Observer, Progress, RemarksAtRest, SharedModels, gearbox::GearboxResult,
    parallel_map, solve,
};
use scene::{
    Machine, Quantity, Scene,
    gearbox::Gearbox,
    plan::{Plan, PlanOutput},
};

use crate::{CaseRow, DoneCases, case_values, gearbox_values};

/// Key of the headline and column of the rows that tell lengths of contact lines under load.
const LINE_LENGTH: [&str; 2] = ["mean_contact_line_length_mm", "contact_line_length_mm"];

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
    parallel_map(open.len(), |i| {
        if failure().is_some() || progress.is_cancelled() {
            return;
        }
        let case = open[i];
        let outcome = plan
            .machine(case)
            .map_err(|e| e.to_string())
            .and_then(|machine| numbers(machine, &plan.outputs, models, &mut *observer()));
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

/// The numbers that are wanted of a pair or a gearbox, or why there are none. Its rows are gone when they are taken.
pub(crate) fn numbers(
    machine: Machine,
    outputs: &[PlanOutput],
    models: &SharedModels<'_>,
    observer: &mut dyn Observer,
) -> Result<Vec<f64>, String> {
    let said = |e: AnalysisError| e.to_string();
    match machine {
        Machine::Pair(mut scene) => {
            // Nobody looks at these.
            (scene.output.vtu, scene.output.parquet, scene.output.contact_lines) = (false, false, false);
            scene.rating = scene.rating.filter(|_| outputs.iter().any(is_rating));
            if let Some(rating) = scene.rating.as_mut().filter(|_| !outputs.iter().any(is_spectrum)) {
                rating.spectrum = None;
            }
            let context = Context::<Scene>::new(observer)
                .with_models(models)
                .with_remarks(RemarksAtRest::Skipped)
                .with_line_lengths(outputs.iter().any(is_line_length));
            let solved = solve(&*scene, context).and_then(Ending::finished).map_err(said)?;
            solved.verdict().map_err(said)?;
            case_values(outputs, &solved)
        }
        Machine::Gearbox(mut file) => {
            let wants = wanted(outputs);
            // Nobody looks at the others.
            let bounded = file.accuracy.of(Quantity::NaturalFrequency).is_some();
            file.vibration = file.vibration.filter(|_| wants[0] || bounded);
            file.motion = file.motion.filter(|_| wants[1]);
            file.branch = file.branch.filter(|_| wants[2]);
            if let Some(rating) = file.rating.as_mut().filter(|_| !wants[3]) {
                rating.spectrum = None;
            }
            let context = Context::<Gearbox>::new(observer).with_models(models);
            let result = solve(&*file, context).and_then(Ending::finished).map_err(said)?;
            result.verdict(&file).map_err(said)?;
            gearbox_values(outputs, &file, &result)
        }
    }
}

/// Whether a number is one of the rating of a pair.
fn is_rating(output: &PlanOutput) -> bool {
    matches!(output, PlanOutput::Headline(key) if key.split('.').next() == Some("rating"))
}

/// Whether a number is of a load spectrum, each torque of which is solved by itself.
fn is_spectrum(output: &PlanOutput) -> bool {
    matches!(output, PlanOutput::Headline(key)
        if matches!(key.split('.').nth(1), Some("spectrum" | "local_spectrum")))
}

/// Whether a number is told of lengths of contact lines under load.
fn is_line_length(output: &PlanOutput) -> bool {
    match output {
        PlanOutput::Headline(key) => key == LINE_LENGTH[0],
        PlanOutput::Column { column, .. } => column == LINE_LENGTH[1],
    }
}

/// Whether numbers of a vibration are wanted of a gearbox, those of a motion, of a branch, and of a load spectrum: rows are of
/// the motion.
fn wanted(outputs: &[PlanOutput]) -> [bool; 4] {
    let of = |output: &PlanOutput| match output {
        PlanOutput::Headline(key) => GearboxResult::asks_for(key.split('.').next().unwrap_or(key)),
        PlanOutput::Column { .. } => [false, true, false, false],
    };
    outputs.iter().map(of).fold([false; 4], |all, own| std::array::from_fn(|i| all[i] | own[i]))
}
