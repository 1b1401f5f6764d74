//! The search for the design whose numbers are smallest within limits, of a pair or a gearbox.

use std::{
    io,
    ops::ControlFlow,
    sync::{Mutex, PoisonError},
};

use analysis::{SharedModels, parallel_map};
use design::{Curve, Evaluation, Goal, Limited, Measure, Over, Search, SearchResult, rounded};
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
    /// Goals and limited numbers at the start, in the order of [`NumberOptimisation::outputs`].
    pub before: Vec<f64>,
    /// Goals and limited numbers with `values`.
    pub after: Vec<f64>,
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

/// What the numbers of a design come to: the mean absolute value of the goals.
pub fn goal_of(numbers: &[f64], goals: usize) -> f64 {
    numbers[..goals].iter().map(|x| x.abs()).sum::<f64>() / goals as f64
}

/// Unit of the mean of the goals, where they all have one.
pub fn goal_unit(plan: &NumberOptimisation) -> String {
    let mut units = plan.goal_names().map(answer::unit_of);
    let first = units.next().unwrap_or_default();
    if units.all(|unit| unit == first) { first } else { String::new() }
}

/// Searches; `done` keeps each solved design and neighbour, so that a search that is cut short goes on from them, and
/// `seen` is told of every evaluation: how many there were, and the goal; where it breaks, no more is evaluated.
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
    mut seen: impl FnMut(usize, Option<f64>) -> ControlFlow<()>,
) -> Result<NumberOptimum, OptimumError> {
    let bounds: Vec<[f64; 2]> = plan.parameters.iter().map(|p| p.bounds).collect();
    let search = Search { goal: goal(), bounds: bounds.clone(), evaluations: plan.evaluations as usize };
    let (mut count, mut goes_on) = (0, true);
    let mut at = |values: &[f64]| {
        if !goes_on {
            return Err(OptimumError::Cancelled);
        }
        let found = evaluate(plan, models, observer, done, (count, values));
        count += 1;
        goes_on = seen(count, found.as_ref().ok().map(|(e, _)| goal().value(&e.curves))).is_continue();
        found
    };
    // Numbers of each design, the start the first.
    let mut known: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    let found = search.run(&plan.start(), |values| {
        let (evaluation, numbers) = at(values)?;
        known.push((values.to_vec(), numbers));
        Ok::<_, OptimumError>(evaluation)
    })?;
    let before = known[0].1.clone();
    let grains: Vec<f64> = plan.parameters.iter().map(|p| p.grain).collect();
    let values = rounded(&found.values, &grains, &bounds, &found.evaluation, &goal());
    let (evaluation, after) = match known.into_iter().find(|(own, _)| *own == values && values == found.values) {
        Some((_, numbers)) => (found.evaluation.clone(), numbers),
        None => at(&values)?,
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
) -> Result<(Evaluation, Vec<f64>), OptimumError> {
    let outputs = plan.outputs();
    let designs: Vec<(Vec<f64>, f64)> =
        std::iter::once((values.to_vec(), 0.0)).chain((0..values.len()).map(|k| plan.beside(values, k))).collect();
    let failed = Mutex::new(None);
    let solved = parallel_map(designs.len(), |i| {
        let (case, own) = (count * designs.len() + i, &designs[i].0);
        if let Some(known) = done.row(case).filter(|row| row.values == *own) {
            return known.outcome;
        }
        let outcome = plan
            .machine(own)
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
    let here = solved[0].clone();
    let rates = |k: usize| -> Vec<f64> {
        solved[1..].iter().zip(&designs[1..]).map(|(beside, (_, step))| (beside[k] - here[k]) / step).collect()
    };
    let still = vec![0.0; values.len()];
    let curve =
        |k: usize| Curve { sample: 0, weight: 1.0, values: vec![here[k], 0.0], rates: vec![rates(k), still.clone()] };
    let goals = plan.goals.len();
    let limited = |(k, limit): (usize, &scene::optimum::NumberLimit)| Limited {
        value: here[goals + k],
        rates: rates(goals + k),
        limit: limit.most,
    };
    let curves = (0..goals).map(curve).collect();
    let limited = plan.limits.iter().enumerate().map(limited).collect();
    Ok((Evaluation { curves, limited }, here))
}
