//! Finds the active set, the rows in contact: block principal pivoting, and single steps that cannot cycle.

use super::{Equality, LinearContact, Problem};
use crate::ContactError;

/// Block pivots without progress before single steps take over.
const PATIENCE: usize = 10;
/// Violation below which a point does not change sides, relative to the largest approach or force: the round-off of a
/// solve with the last compliance.
pub(super) const PIVOT_TOLERANCE: f64 = 2e-12;
/// Loosest violation below which a point does not change sides, where single steps go round in circles. The proximal
/// steps take what is left, and the residual reports it.
const LOOSEST_PIVOT: f64 = 1e-7;

/// The active set on which no inactive row is penetrated and no active row pulls: block pivots while they make
/// progress, then single steps that cannot cycle.
pub(super) fn pivot(
    bodies: &mut dyn LinearContact,
    problem: &Problem,
    mut active: Vec<usize>,
) -> Result<(Equality, Vec<usize>, usize), ContactError> {
    let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
    let mut iterations = 0;
    loop {
        let answer = bodies.solve(&active, problem)?;
        iterations += 1;
        let pulling: Vec<usize> = pulling(&active, &answer.forces, PIVOT_TOLERANCE);
        let penetrated = penetrated(problem, &active, &answer, PIVOT_TOLERANCE);
        let wrong = pulling.len() + penetrated.len();
        if wrong == 0 {
            return Ok((answer, active, iterations));
        }
        if wrong < fewest {
            (fewest, patience) = (wrong, PATIENCE);
        } else if patience == 0 {
            return single_steps(bodies, problem, &active, &answer, iterations);
        } else {
            patience -= 1;
        }
        let mut next: Vec<usize> = active.iter().copied().filter(|i| pulling.binary_search(i).is_err()).collect();
        next.extend(penetrated);
        if next.is_empty() && !problem.held {
            // A load must rest on something.
            return single_steps(bodies, problem, &active, &answer, iterations);
        }
        next.sort_unstable();
        active = next;
    }
}

/// Active rows with a negative force, ascending.
fn pulling(active: &[usize], forces: &[f64], tolerance: f64) -> Vec<usize> {
    let largest = forces.iter().fold(0.0f64, |m, f| m.max(f.abs()));
    active.iter().zip(forces).filter(|(_, f)| **f < -tolerance * largest).map(|(&i, _)| i).collect()
}

/// Inactive rows with a negative gap, ascending.
fn penetrated(problem: &Problem, active: &[usize], answer: &Equality, tolerance: f64) -> Vec<usize> {
    let approach = answer.openings.iter().fold(0.0f64, |m, o| m.max(o.abs()));
    (0..problem.gaps.len())
        .filter(|i| active.binary_search(i).is_err() && open_gap(problem, answer, *i) < -tolerance * approach)
        .collect()
}

fn open_gap(problem: &Problem, answer: &Equality, i: usize) -> f64 {
    problem.gaps[i] + problem.levers[i] * answer.rotation + answer.openings[i]
}

/// Primal active-set method of the quadratic programme: from forces >= 0 that balance the moment, each step lowers the
/// energy, so no set comes twice.
fn single_steps(
    bodies: &mut dyn LinearContact,
    problem: &Problem,
    active: &[usize],
    answer: &Equality,
    mut iterations: usize,
) -> Result<(Equality, Vec<usize>, usize), ContactError> {
    let n = problem.gaps.len();
    let driving = problem.moment.signum();
    let mut force = vec![0.0; n];
    active.iter().zip(&answer.forces).filter(|(_, f)| **f > 0.0).for_each(|(&i, &f)| force[i] = f);
    let carried = |force: &[f64]| force.iter().zip(&problem.torque_levers).map(|(f, l)| f * l).sum::<f64>();
    if !problem.held && carried(&force) * driving <= 0.0 {
        let best = (0..n).max_by(|&a, &b| (problem.levers[a] * driving).total_cmp(&(problem.levers[b] * driving)));
        force.fill(0.0);
        best.into_iter().for_each(|i| force[i] = 1.0);
    }
    if !problem.held {
        let scale = problem.moment / carried(&force);
        force.iter_mut().for_each(|f| *f *= scale);
    }
    let mut working: Vec<usize> = (0..n).filter(|&i| force[i] > 0.0).collect();
    let (mut tolerance, mut steps) = (PIVOT_TOLERANCE, 0);
    while tolerance <= LOOSEST_PIVOT {
        // Rows that neither press nor gape (all gaps alike, more points than nodes) change sides by round-off: let them
        // be.
        steps += 1;
        if steps > 50 + 2 * n {
            (tolerance, steps) = (10.0 * tolerance, 0);
        }
        let answer = bodies.solve(&working, problem)?;
        iterations += 1;
        let pulls = pulling(&working, &answer.forces, tolerance);
        if pulls.is_empty() {
            let deepest = penetrated(problem, &working, &answer, tolerance)
                .into_iter()
                .min_by(|&a, &b| open_gap(problem, &answer, a).total_cmp(&open_gap(problem, &answer, b)));
            let Some(deepest) = deepest else { return Ok((answer, working, iterations)) };
            force.fill(0.0);
            working.iter().zip(&answer.forces).for_each(|(&i, &f)| force[i] = f.max(0.0));
            working.push(deepest);
            working.sort_unstable();
            continue;
        }
        // As far towards the answer as no force turns negative; the rows that stop the step leave.
        let reach = |i: usize, target: f64| {
            if target < 0.0 && force[i] >= 0.0 { force[i] / (force[i] - target) } else { f64::INFINITY }
        };
        let share = working.iter().zip(&answer.forces).map(|(&i, &t)| reach(i, t)).fold(1.0, f64::min);
        let stopped: Vec<usize> =
            working.iter().zip(&answer.forces).filter(|(i, t)| reach(**i, **t) <= share).map(|(&i, _)| i).collect();
        working.iter().zip(&answer.forces).for_each(|(&i, &t)| force[i] += share * (t - force[i]));
        stopped.iter().for_each(|&i| force[i] = 0.0);
        working.retain(|i| stopped.binary_search(i).is_err());
    }
    Err(ContactError::NotConverged { iterations, infeasible: working.len(), points: n })
}
