//! The search for the design whose numbers are smallest within limits, of a pair or a gearbox.

use std::{
    io,
    ops::ControlFlow,
    sync::{Mutex, PoisonError},
};

use analysis::{SharedModels, parallel_map};
use design::{Curve, Evaluated, Evaluation, Goal, Limited, Measure, Over, Search, SearchResult, rounded};
use scene::optimum::NumberOptimisation;

use crate::{CaseObserver, CaseRow, DoneCases, solve::numbers};

/// The best design found, and its numbers.
#[derive(Debug, Clone)]
pub struct NumberOptimum {
    /// The search.
    pub found: SearchResult,
    /// Values that a machine can be set to; those of the search where that is any.
    pub values: Vec<f64>,
    /// All that is known there.
    pub evaluation: Evaluation,
    /// Goals and limited numbers at the start, in the order of [`NumberOptimisation::outputs`], load by load.
    pub before: Vec<Vec<f64>>,
    /// The same with `values`.
    pub after: Vec<Vec<f64>>,
}

/// Why there is no optimum.
#[derive(Debug, thiserror::Error)]
pub enum OptimumError {
    /// The start, or the rounded optimum, has no result.
    #[error("{0}")]
    NoResult(String),
    /// Who waits has lost interest.
    #[error("cancelled")]
    Cancelled,
    /// A row is not written.
    #[error("a row cannot be kept: {0}")]
    Write(#[from] io::Error),
}

/// What is small: the mean of the absolute values.
const fn goal() -> Goal {
    // The peak to peak of a number and 0 is its absolute value.
    Goal { measure: Measure::PeakToPeak, over: Over::Mean }
}

/// What the numbers of a design come to: the mean absolute value of the goals under all loads.
pub fn goal_of(numbers: &[Vec<f64>], goals: usize) -> f64 {
    let all = numbers.iter().flat_map(|of_load| &of_load[..goals]).map(|x| x.abs());
    all.sum::<f64>() / (goals * numbers.len().max(1)) as f64
}

/// Unit of the mean of the goals; empty where the goals have different units.
pub fn goal_unit(plan: &NumberOptimisation) -> String {
    let mut units = plan.goal_names().map(answer::unit_of);
    let first = units.next().unwrap_or_default();
    if units.all(|unit| unit == first) { first } else { String::new() }
}

/// Searches; `done` keeps each solved design and neighbour, so that a search that is cut short goes on from them, and
/// `seen` is told of every evaluation: which one it is, and the goal; where it breaks, no more is evaluated.
///
/// Derivatives are differences over a thousandth of the range of a parameter. All numbers are those of a case of a plan.
///
/// # Errors
/// [`OptimumError`]; a later design without a result counts as a bad one.
pub fn optimise_numbers(
    plan: &NumberOptimisation,
    models: &SharedModels<'_>,
    observer: CaseObserver<'_>,
    done: &DoneCases,
    mut seen: impl FnMut(Evaluated, Option<f64>) -> ControlFlow<()>,
) -> Result<NumberOptimum, OptimumError> {
    let bounds: Vec<[f64; 2]> = plan.parameters.iter().map(|p| p.bounds).collect();
    let search = Search { goal: goal(), bounds: bounds.clone(), evaluations: plan.evaluations as usize };
    let (mut count, mut goes_on) = (0, true);
    let mut at = |values: &[f64], is_rounded: bool| {
        if !goes_on {
            return Err(OptimumError::Cancelled);
        }
        let found = evaluate(plan, models, observer, done, (count, values));
        count += 1;
        let which = if is_rounded { Evaluated::Rounded } else { Evaluated::Step(count) };
        goes_on = seen(which, found.as_ref().ok().map(|(e, _)| goal().value(&e.curves))).is_continue();
        found
    };
    // Numbers of each design, the start the first.
    let mut known: Vec<(Vec<f64>, Vec<Vec<f64>>)> = Vec::new();
    let found = search.run(&plan.start(), |values| {
        let (evaluation, numbers) = at(values, false)?;
        known.push((values.to_vec(), numbers));
        Ok::<_, OptimumError>(evaluation)
    })?;
    let before = known[0].1.clone();
    let grains: Vec<f64> = plan.parameters.iter().map(|p| p.grain).collect();
    let values = rounded(&found.values, &grains, &bounds, &found.evaluation, &goal());
    let (evaluation, after) = match known.into_iter().find(|(own, _)| *own == values && values == found.values) {
        Some((_, numbers)) => (found.evaluation.clone(), numbers),
        None => at(&values, true)?,
    };
    Ok(NumberOptimum { found, values, evaluation, before, after })
}

/// The numbers of a design, and how they change along each parameter.
fn evaluate(
    plan: &NumberOptimisation,
    models: &SharedModels<'_>,
    observer: CaseObserver<'_>,
    done: &DoneCases,
    (count, values): (usize, &[f64]),
) -> Result<(Evaluation, Vec<Vec<f64>>), OptimumError> {
    let (outputs, loads) = (plan.outputs(), plan.loads.len());
    let designs: Vec<(Vec<f64>, f64)> =
        std::iter::once((values.to_vec(), 0.0)).chain((0..values.len()).map(|k| plan.beside(values, k))).collect();
    let failed = Mutex::new(None);
    let solved = parallel_map(designs.len() * loads, |i| {
        let (case, own) = (count * designs.len() * loads + i, &designs[i / loads].0);
        if let Some(known) = done.row(case).filter(|row| row.values == *own) {
            return known.outcome;
        }
        let outcome = plan
            .machine_under(own, &plan.loads[i % loads])
            .map_err(|e| e.to_string())
            .and_then(|machine| numbers(machine, &outputs, models, &mut *observer()));
        let row = CaseRow { case, values: own.clone(), outcome };
        if let Err(e) = done.add(row.clone()) {
            *failed.lock().unwrap_or_else(PoisonError::into_inner) = Some(e);
        }
        row.outcome
    });
    if let Some(e) = failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(e.into());
    }
    let solved = solved.into_iter().collect::<Result<Vec<_>, String>>().map_err(OptimumError::NoResult)?;
    let by_design: Vec<&[Vec<f64>]> = solved.chunks(loads).collect();
    let here = by_design[0];
    let rates = |load: usize, k: usize| -> Vec<f64> {
        let beside = by_design[1..].iter().zip(&designs[1..]);
        beside.map(|(beside, (_, step))| (beside[load][k] - here[load][k]) / step).collect()
    };
    let still = vec![0.0; values.len()];
    let goals = plan.goals.len();
    let curve = |(load, k): (usize, usize)| Curve {
        sample: 0,
        weight: 1.0,
        values: vec![here[load][k], 0.0],
        rates: vec![rates(load, k), still.clone()],
    };
    let limited = |(load, k): (usize, usize)| Limited {
        value: here[load][goals + k],
        rates: rates(load, goals + k),
        limit: plan.limits[k].most,
    };
    let each = |count: usize| (0..loads).flat_map(move |load| (0..count).map(move |k| (load, k)));
    let curves = each(goals).map(curve).collect();
    let limited = each(plan.limits.len()).map(limited).collect();
    Ok((Evaluation { curves, limited }, here.to_vec()))
}
