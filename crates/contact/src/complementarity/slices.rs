//! Slices: rows with a local compliance of their own, nonlinear in the force.

use super::{Balance, LinearContact, Problem, Solution, TOLERANCE, driven_rows, exact_residual, finish, pivots::pivot};
use crate::{ContactError, nodal::ContactRow};

/// Newton steps on the local compliance of slices before giving up; five or six do.
const SLICE_STEPS: usize = 60;

/// Solves the contact of slices: each row has a compliance of its own besides the bodies', not linear in its force.
///
/// ```text
/// g_i = g0_i + l_i dtheta + o_i(F) + delta_i(F_i)
/// ```
/// Newton on the complementarity: delta is replaced by its tangent at the last forces, the resulting linear problem is
/// solved exactly, active set and all; the tangents are exact, so the error falls quadratically. delta grows slower and
/// slower with the load, so the steps approach from below and need no damping. `local(i, F)` gives delta_i (mm) and its
/// slope (mm/N); slopes are positive.
///
/// # Errors
/// [`ContactError::NotConverged`], [`ContactError::CannotCarryTorque`].
pub(crate) fn solve_slices(
    bodies: &mut dyn LinearContact,
    rows: &[ContactRow],
    body: usize,
    balance: Balance,
    local: impl Fn(usize, f64) -> (f64, f64),
    start: &[f64],
) -> Result<Solution, ContactError> {
    let driven = driven_rows(rows, body, balance)?;
    let n = rows.len();
    let mut active: Vec<usize> = (0..n).filter(|&i| start[i] > 0.0).collect();
    let mut forces = start.to_vec();
    if active.is_empty() {
        active = driven.first_guess(rows);
        forces.fill(driven.typical_force(n));
    }
    let gaps: Vec<f64> = rows.iter().map(|r| r.gap).collect();
    let rows = Rows { gaps: &gaps, levers: &driven.levers, torque_levers: &driven.torque_levers, balance };
    newton(bodies, &rows, local, forces, active)
}

/// What Newton's method sees of the rows.
pub(super) struct Rows<'a> {
    pub gaps: &'a [f64],
    pub levers: &'a [f64],
    pub torque_levers: &'a [f64],
    pub balance: Balance,
}

/// Newton steps from `forces`, each with the active set found exactly for the tangents of its start.
pub(super) fn newton(
    bodies: &mut dyn LinearContact,
    rows: &Rows<'_>,
    local: impl Fn(usize, f64) -> (f64, f64),
    mut forces: Vec<f64>,
    mut active: Vec<usize>,
) -> Result<Solution, ContactError> {
    let n = rows.gaps.len();
    let (moment, held) = rows.balance.moment();
    let mut problem = Problem {
        gaps: vec![0.0; n],
        levers: rows.levers.to_vec(),
        torque_levers: rows.torque_levers.to_vec(),
        compliance: vec![0.0; n],
        moment,
        held,
    };
    let mut total = 0;
    for _ in 0..SLICE_STEPS {
        for (i, &force) in forces.iter().enumerate() {
            let (approach, slope) = local(i, force);
            problem.compliance[i] = slope;
            problem.gaps[i] = rows.gaps[i] + approach - slope * force;
        }
        let (answer, settled, iterations) = pivot(bodies, &problem, active)?;
        total += iterations;
        let mut solution = finish(&problem, answer, settled, total);
        for (i, o) in solution.openings.iter_mut().enumerate() {
            *o += local(i, solution.forces[i]).0;
        }
        solution.residual = exact_residual(rows.gaps, rows.levers, &solution);
        if solution.residual < TOLERANCE {
            return Ok(solution);
        }
        forces.clone_from(&solution.forces);
        active = solution.active;
    }
    Err(ContactError::NotConverged { iterations: total, infeasible: active.len(), points: n })
}
