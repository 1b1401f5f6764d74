//! Points in contact on a mesh, whose forces need not be unique, by proximal continuation. Theory (19).

use super::{
    Balance, Law, LinearContact, Problem, Solution, TOLERANCE, driven_rows, exact_residual, finish, pivots::pivot,
};
use crate::{ContactError, nodal::ContactRow};

/// Row compliance of exact contact in the first proximal step, relative to a point's own compliance: large enough that
/// the active set settles in a few pivots from any start.
const FIRST_COMPLIANCE: f64 = 0.1;
/// Each proximal step's compliance relative to the one before: the set hardly changes from step to step.
const COMPLIANCE_DECAY: f64 = 0.1;
/// Smallest; below it rows of faces with more points than nodes are linearly dependent to round-off.
pub(crate) const LAST_COMPLIANCE: f64 = 1e-6;
/// Residual of a proximal step relative to the one before from which on it creeps.
const SLOW: f64 = 0.5;
/// Proximal steps before giving up.
const PROXIMAL_STEPS: usize = 300;
/// Violation that is still an answer: of the penalty law, and of exact contact where forces drift too slowly to wait.
const ANSWER_TOLERANCE: f64 = 1e-9;
/// Proximal steps without extrapolation after one that made things worse.
const PATIENCE: usize = 12;

/// l' S^-1 l of exact contact on the active rows, N mm/rad, whichever of rows that are linearly dependent are among them: that of
/// the smallest row compliance, [`LAST_COMPLIANCE`] of itself too small at the most. `relative`: compliance of the step that found
/// the solution.
fn exact_stiffness(
    bodies: &mut dyn LinearContact,
    problem: &mut Problem,
    (rows, own, relative): (&[ContactRow], f64, f64),
    solution: &Solution,
) -> Result<f64, ContactError> {
    if problem.held || relative <= LAST_COMPLIANCE {
        return Ok(solution.stiffness);
    }
    // About its own forces the solution stays the same, and so do the displacements.
    about(problem, rows, LAST_COMPLIANCE * own, &solution.forces);
    Ok(bodies.solve(&solution.active, problem)?.stiffness)
}

/// Gives all rows a compliance about forces at which it is without effect.
fn about(problem: &mut Problem, rows: &[ContactRow], compliance: f64, forces: &[f64]) {
    problem.compliance.fill(compliance);
    for ((gap, row), force) in problem.gaps.iter_mut().zip(rows).zip(forces) {
        *gap = row.gap - compliance * force;
    }
}

/// Solves the contact of `rows`; `balance` acts about the axis of body number `body`.
///
/// The method is block principal pivoting: all violated points change at once. If it stops making progress, the primal
/// active-set method takes over; it terminates because every step lowers the energy. Exact contact with more points
/// than nodes has no unique forces and a singular matrix. The proximal-point method (a local compliance about the
/// forces of the preceding step, smaller from step to step) still converges to zero penetration. `start` has the forces
/// of an earlier solution at these rows, or zeros.
///
/// # Errors
/// [`ContactError::NotConverged`], [`ContactError::CannotCarryTorque`].
pub fn solve(
    bodies: &mut dyn LinearContact,
    rows: &[ContactRow],
    body: usize,
    balance: Balance,
    law: Law,
    start: &[f64],
) -> Result<Solution, ContactError> {
    let gaps: Vec<f64> = rows.iter().map(|r| r.gap).collect();
    let driven = driven_rows(rows, body, balance)?;
    let compliance = match law {
        Law::Penalty(k) => rows.iter().map(|r| 1.0 / (k * r.area)).collect(),
        Law::Exact => vec![0.0; rows.len()],
    };
    let mut problem = Problem::new(gaps.clone(), &driven, compliance, balance);
    let mut active: Vec<usize> = (0..rows.len()).filter(|&i| start[i] > 0.0).collect();
    if active.is_empty() {
        active = driven.first_guess(rows);
    }
    let Law::Exact = law else {
        let (answer, active, iterations) = pivot(bodies, &problem, active)?;
        let solution = finish(&problem, answer, active, iterations);
        if solution.residual > ANSWER_TOLERANCE {
            let infeasible = solution.active.len();
            return Err(ContactError::NotConverged { iterations, infeasible, points: rows.len() });
        }
        return Ok(solution);
    };
    let own = bodies.self_compliance()?;
    let mut before = start.to_vec();
    let mut total = 0;
    let mut relative = FIRST_COMPLIANCE;
    let mut residual = f64::INFINITY;
    let mut best: Option<Solution> = None;
    let mut patience = 0usize;
    for _ in 0..PROXIMAL_STEPS {
        about(&mut problem, rows, relative * own, &before);
        let (answer, settled, iterations) = pivot(bodies, &problem, active)?;
        total += iterations;
        let mut solution = finish(&problem, answer, settled.clone(), total);
        solution.residual = exact_residual(&gaps, &driven.levers, &solution);
        if solution.residual < TOLERANCE {
            solution.stiffness = exact_stiffness(bodies, &mut problem, (rows, own, relative), &solution)?;
            return Ok(solution);
        }
        // Extrapolations that overshoot would go round in circles: after one that makes things worse, plain steps, each
        // of which comes nearer.
        patience = if solution.residual > residual { PATIENCE } else { patience.saturating_sub(1) };
        let slow = relative <= LAST_COMPLIANCE && solution.residual > SLOW * residual && patience == 0;
        let further = if slow { extrapolation(&before, &solution.forces, solution.residual / residual) } else { 0.0 };
        for (b, f) in before.iter_mut().zip(&solution.forces) {
            *b = (f + further * (f - *b)).max(0.0);
        }
        residual = solution.residual;
        if best.as_ref().is_none_or(|b| residual < b.residual) {
            best = Some(solution);
        }
        active = settled;
        relative = (relative * COMPLIANCE_DECAY).max(LAST_COMPLIANCE);
    }
    match best.filter(|solution| solution.residual <= ANSWER_TOLERANCE) {
        Some(mut solution) => {
            // The best step may have had another compliance than the last one.
            solution.stiffness = exact_stiffness(bodies, &mut problem, (rows, own, f64::INFINITY), &solution)?;
            Ok(solution)
        }
        None => Err(ContactError::NotConverged { iterations: total, infeasible: active.len(), points: rows.len() }),
    }
}

/// How many steps like the last one proximal continuation may go at once where it creeps.
///
/// Where more points press than the faces can tell apart, forces drift from one to the other at a rate that the
/// proximal compliance sets, until one of them is free. As far as the residual would take to vanish at its `ratio` from
/// step to step (Aitken), and not past the first force that becomes zero. Any forces are a fair start of the next
/// proximal step.
fn extrapolation(before: &[f64], now: &[f64], ratio: f64) -> f64 {
    let to_zero = |(b, f): (&f64, &f64)| if f < b && *f > 0.0 { f / (b - f) } else { f64::INFINITY };
    let first = before.iter().zip(now).map(to_zero).fold(f64::INFINITY, f64::min);
    let vanishes = if ratio < 1.0 { ratio / (1.0 - ratio) } else { f64::INFINITY };
    let steps = first.min(vanishes);
    if steps.is_finite() { steps } else { 0.0 }
}
