//! The search for the optimum.

use std::ops::ControlFlow;

use design::{Evaluated, Evaluation, Goal, Search, SearchResult, rounded};
use scene::optimum::Optimisation;
use serde::Serialize;

use super::evaluate::{PressureLimits, evaluate, slices};
use crate::{AnalysisError, SharedModels};

/// The optimum of a plan.
#[derive(Debug, Clone)]
pub struct Optimum {
    /// The plan as it was searched, with its number of slices.
    pub plan: Optimisation,
    /// Result of the search.
    pub found: SearchResult,
    /// Parameter values rounded to machine settings; those of the search if every value can be set.
    pub values: Vec<f64>,
    /// Evaluation of these values.
    pub evaluation: Evaluation,
    /// Optima with lower pressure limits, starting from the highest.
    pub front: Vec<FrontPoint>,
}

/// An optimum with a pressure limit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrontPoint {
    /// The limit, MPa; `None` for the optimum itself.
    pub limit_mpa: Option<f64>,
    /// Largest pressure, MPa.
    pub max_pressure_mpa: f64,
    /// Value of the goal that is minimised, um.
    pub goal_um: f64,
    /// Values of the parameters.
    pub values: Vec<f64>,
}

/// Share of the optimum's pressure by which the front goes down where the start's pressure is no lower.
const FRONT: f64 = 0.1;
/// Evaluations for each point of the front.
const FRONT_EVALUATIONS: usize = 8;

/// Searches the optimum. `seen` receives the number and the goal (um) of every evaluation; if it breaks, no more
/// designs are evaluated.
///
/// # Errors
/// [`AnalysisError`] at the start, or at the rounded optimum.
pub fn optimise(
    models: &SharedModels<'_>,
    plan: &Optimisation,
    mut seen: impl FnMut(Evaluated, Option<f64>) -> ControlFlow<()>,
) -> Result<Optimum, AnalysisError> {
    let plan = Optimisation { slices: plan.slices.or_else(|| slices(plan)), ..plan.clone() };
    let bounds: Vec<[f64; 2]> = plan.parameters.iter().map(|p| p.bounds).collect();
    let search = Search { goal: plan.goal.clone(), bounds: bounds.clone(), evaluations: plan.evaluations as usize };
    let (mut count, mut goes_on) = (0, true);
    let mut at = |which: Evaluated, values: &[f64], anywhere: Option<f64>| {
        if !goes_on {
            return Err(AnalysisError::Cancelled);
        }
        let limits = PressureLimits { anywhere, at_edges: plan.max_edge_pressure_mpa };
        let found = evaluate(models, &plan, values, limits);
        goes_on = seen(which, found.as_ref().ok().map(|e| plan.goal.value(&e.curves))).is_continue();
        found
    };
    let found = search.run(&plan.start(), |values| {
        count += 1;
        at(Evaluated::Step(count), values, plan.max_pressure_mpa)
    })?;
    let grains: Vec<f64> = plan.parameters.iter().map(|p| p.grain).collect();
    let values = rounded(&found.values, &grains, &bounds, &found.evaluation, &plan.goal);
    let evaluation = if values == found.values {
        found.evaluation.clone()
    } else {
        at(Evaluated::Rounded, &values, plan.max_pressure_mpa)?
    };
    let mut front = Vec::new();
    if plan.front > 0 {
        // Limits far above make the pressure known and bind nothing.
        let unbound = at(Evaluated::Front, &found.values, Some(UNBOUND))?;
        let mut last = point(&plan.goal, &unbound, None, &found.values);
        let highest = last.max_pressure_mpa;
        let at_start = point(&plan.goal, &at(Evaluated::Front, &plan.start(), Some(UNBOUND))?, None, &plan.start())
            .max_pressure_mpa;
        let lowest = if at_start < highest { at_start } else { (1.0 - FRONT) * highest };
        front.push(last.clone());
        for k in 1..=plan.front {
            let limit = highest + (lowest - highest) * f64::from(k) / f64::from(plan.front);
            let search = Search { evaluations: FRONT_EVALUATIONS, ..search.clone() };
            let below = search.run(&last.values, |values| at(Evaluated::Front, values, Some(limit)))?;
            // Below the least pressure that there is, no further point is one.
            if below.evaluation.over_limits() > HELD {
                break;
            }
            last = point(&plan.goal, &below.evaluation, Some(limit), &below.values);
            front.push(last.clone());
        }
    }
    Ok(Optimum { plan: plan.clone(), found, values, evaluation, front })
}

/// A pressure that no gear stands, MPa.
const UNBOUND: f64 = 1e6;
/// Share by which a limit may be passed.
const HELD: f64 = 2e-3;

fn point(goal: &Goal, evaluation: &Evaluation, limit_mpa: Option<f64>, values: &[f64]) -> FrontPoint {
    let max_pressure_mpa = evaluation.limited.iter().map(|l| l.value).fold(0.0, f64::max);
    FrontPoint { limit_mpa, max_pressure_mpa, goal_um: goal.value(&evaluation.curves), values: values.to_vec() }
}
