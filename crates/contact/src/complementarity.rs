//! g >= 0, p >= 0, p g = 0 at every point, and a rotation that balances the moment.
//!
//! ```text
//! g_i = g0_i + l_i dtheta + o_i(F) + d_i F_i,    sum_i l_i F_i = M
//! F_i >= 0,  g_i >= 0,  F_i g_i = 0
//! ```
//! With friction the moment of a force has a lever of its own, and the openings are those by normal and friction force together.
//! g0 undeformed gap, l lever, o opening by elastic deflection, d local compliance: 1/(k A_i) with the penalty law, 0
//! with exact contact. The problem is the optimality condition of a convex quadratic programme, so the answer
//! for the rotation and the gaps is unique.

use crate::{ContactError, ContactRow};

/// How a point resists penetration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// No penetration.
    Exact,
    /// Pressure = stiffness times penetration; stiffness in MPa/mm.
    Penalty(f64),
}

/// Elastic bodies with a linear answer to contact forces.
pub trait LinearContact {
    /// Forces and rotation with `g_i = 0` on the active rows alone (sign of the forces unchecked), and the
    /// elastic openings o_i at all rows.
    ///
    /// # Errors
    /// [`ContactError`] when the equations have no unique answer.
    fn solve(&mut self, active: &[usize], problem: &Problem) -> Result<Equality, ContactError>;

    /// Compliance of a typical row under its own force, mm/N.
    ///
    /// # Errors
    /// [`ContactError`] when the elastic model fails.
    fn self_compliance(&mut self) -> Result<f64, ContactError>;

    /// Displacements of both bodies' boundary nodes, three a node, mm, under the given row forces: those of the last
    /// answer of [`LinearContact::solve`].
    fn displacements(&self, forces: &[f64]) -> [Vec<f64>; 2];
}

/// Data of the complementarity problem, one entry a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// g0, mm.
    pub gaps: Vec<f64>,
    /// l, mm.
    pub levers: Vec<f64>,
    /// Moment of a unit normal force, friction included, mm: l without friction.
    pub torque_levers: Vec<f64>,
    /// d, mm/N.
    pub compliance: Vec<f64>,
    /// M, N mm.
    pub moment: f64,
}

/// Answer of the equality problem on an active set.
#[derive(Debug, Clone, PartialEq)]
pub struct Equality {
    /// Forces of the active rows, N.
    pub forces: Vec<f64>,
    /// dtheta, rad.
    pub rotation: f64,
    /// Elastic openings o_i of all rows, mm.
    pub openings: Vec<f64>,
    /// -dM/dtheta on this active set, N mm/rad: the tangent torsional stiffness of the mesh.
    pub stiffness: f64,
}

/// Solved contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Force of every row, N, >= 0.
    pub forces: Vec<f64>,
    /// Rows that carry force, ascending.
    pub active: Vec<usize>,
    /// dtheta, rad.
    pub rotation: f64,
    /// Elastic opening of every row, mm.
    pub openings: Vec<f64>,
    /// -dM/dtheta, N mm/rad.
    pub stiffness: f64,
    /// Active-set iterations.
    pub iterations: usize,
    /// Largest violation of the conditions: gap in mm over the largest approach, negative force over the largest force.
    pub residual: f64,
}

/// Row compliance of exact contact in the first proximal step, relative to a point's own compliance: large enough that
/// the active set settles in a few pivots from any start.
const FIRST_COMPLIANCE: f64 = 0.1;
/// Each proximal step's compliance relative to the one before: the set hardly changes from step to step.
const COMPLIANCE_DECAY: f64 = 0.1;
/// Smallest; below it rows of faces with more points than nodes are linearly dependent to round-off.
const LAST_COMPLIANCE: f64 = 1e-6;
/// Residual of a proximal step relative to the one before from which on it creeps.
const SLOW: f64 = 0.5;
/// Proximal steps before giving up.
const PROXIMAL_STEPS: usize = 60;
/// Newton steps on the local compliance of slices before giving up; five or six do.
const SLICE_STEPS: usize = 60;
/// Block pivots without progress before single steps take over.
const PATIENCE: usize = 10;
/// Violation below which a point does not change sides, relative to the largest approach or force: the round-off of a solve
/// with the last compliance.
const PIVOT_TOLERANCE: f64 = 2e-12;
/// The same at most, where single steps go round in circles; what is left is for the proximal steps, and the residual tells.
const LOOSEST_PIVOT: f64 = 1e-7;
/// Violation of the penalty law that is still an answer.
const PENALTY_TOLERANCE: f64 = 1e-9;
/// Violation that counts as solved, relative to approach and force.
const TOLERANCE: f64 = 1e-11;

/// Solves the contact of `rows` under `moment` (N mm) about the axis of body number `body`.
///
/// Block principal pivoting (all violated points change at once); where that stops making progress, the primal active-set
/// method, which ends because every step lowers the energy. Exact contact with more points than nodes has no unique forces and no
/// regular matrix; the proximal-point method (a local compliance about the forces of the step before, smaller from step to step)
/// converges to zero penetration all the same. `start`: forces of an earlier solution at these rows, or zeros.
///
/// # Errors
/// [`ContactError::NotConverged`], [`ContactError::NoLever`].
pub fn solve(
    bodies: &mut dyn LinearContact,
    rows: &[ContactRow],
    body: usize,
    moment: f64,
    law: Law,
    start: &[f64],
) -> Result<Solution, ContactError> {
    let gaps: Vec<f64> = rows.iter().map(|r| r.gap).collect();
    let [levers, torque_levers] = levers_of(rows, body);
    let driving = moment.signum();
    let lever_mm = levers.iter().fold(0.0f64, |m, l| m.max(l * driving));
    if rows.is_empty() || lever_mm <= 0.0 || !moment.is_finite() || moment == 0.0 {
        return Err(ContactError::NoLever { lever_mm });
    }
    let compliance = match law {
        Law::Penalty(k) => rows.iter().map(|r| 1.0 / (k * r.area)).collect(),
        Law::Exact => vec![0.0; rows.len()],
    };
    let mut problem = Problem { gaps, levers: levers.clone(), torque_levers, compliance, moment };
    let mut active: Vec<usize> = (0..rows.len()).filter(|&i| start[i] > 0.0).collect();
    if active.is_empty() {
        active = first_guess(rows, &levers, driving);
    }
    let Law::Exact = law else {
        let (answer, active, iterations) = pivot(bodies, &problem, active)?;
        let solution = finish(rows, &problem, answer, active, iterations);
        if solution.residual > PENALTY_TOLERANCE {
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
    for _ in 0..PROXIMAL_STEPS {
        problem.compliance.fill(relative * own);
        for (i, row) in rows.iter().enumerate() {
            problem.gaps[i] = row.gap - problem.compliance[i] * before[i];
        }
        let (answer, settled, iterations) = pivot(bodies, &problem, active)?;
        total += iterations;
        let mut solution = finish(rows, &problem, answer, settled.clone(), total);
        solution.residual = exact_residual(rows, &levers, &solution);
        if solution.residual < TOLERANCE {
            return Ok(solution);
        }
        let slow = relative <= LAST_COMPLIANCE && solution.residual > SLOW * residual;
        let further = if slow { extrapolation(&before, &solution.forces, solution.residual / residual) } else { 0.0 };
        for (b, f) in before.iter_mut().zip(&solution.forces) {
            *b = (f + further * (f - *b)).max(0.0);
        }
        residual = solution.residual;
        active = settled;
        relative = (relative * COMPLIANCE_DECAY).max(LAST_COMPLIANCE);
    }
    Err(ContactError::NotConverged { iterations: total, infeasible: active.len(), points: rows.len() })
}

/// How many steps like the last one proximal continuation may go at once where it creeps.
///
/// Where more points press than the faces can tell apart, forces drift from one to the other at a rate that the proximal compliance sets,
/// until one of them is free. As far as the residual would take to vanish at its `ratio` from step to step (Aitken), and not
/// past the first force that becomes zero. Any forces are a fair start of the next proximal step.
fn extrapolation(before: &[f64], now: &[f64], ratio: f64) -> f64 {
    let to_zero = |(b, f): (&f64, &f64)| if f < b && *f > 0.0 { f / (b - f) } else { f64::INFINITY };
    let first = before.iter().zip(now).map(to_zero).fold(f64::INFINITY, f64::min);
    let vanishes = if ratio < 1.0 { ratio / (1.0 - ratio) } else { f64::INFINITY };
    let steps = first.min(vanishes);
    if steps.is_finite() { steps } else { 0.0 }
}

/// Solves the contact of slices: each row has a compliance of its own besides the bodies', not linear in its force.
///
/// ```text
/// g_i = g0_i + l_i dtheta + o_i(F) + delta_i(F_i)
/// ```
/// Newton on the complementarity: delta is replaced by its tangent at the last forces, the resulting linear problem is solved
/// exactly, active set and all; the tangents are exact, so the error falls quadratically. delta grows slower and slower with the load, so the steps
/// approach from below and need no damping. `local(i, F)` gives delta_i (mm) and its slope (mm/N); slopes are positive.
///
/// # Errors
/// [`ContactError::NotConverged`], [`ContactError::NoLever`].
pub fn solve_slices(
    bodies: &mut dyn LinearContact,
    rows: &[ContactRow],
    body: usize,
    moment: f64,
    local: impl Fn(usize, f64) -> (f64, f64),
    start: &[f64],
) -> Result<Solution, ContactError> {
    let [levers, torque_levers] = levers_of(rows, body);
    let driving = moment.signum();
    let lever_mm = levers.iter().fold(0.0f64, |m, l| m.max(l * driving));
    if rows.is_empty() || lever_mm <= 0.0 || !moment.is_finite() || moment == 0.0 {
        return Err(ContactError::NoLever { lever_mm });
    }
    let n = rows.len();
    let gaps = vec![0.0; n];
    let mut problem = Problem { gaps, levers: levers.clone(), torque_levers, compliance: vec![0.0; n], moment };
    let mut active: Vec<usize> = (0..n).filter(|&i| start[i] > 0.0).collect();
    let mut forces = start.to_vec();
    if active.is_empty() {
        active = first_guess(rows, &levers, driving);
        // Tangents at a typical force: half of the rows share the load.
        forces.fill(2.0 * moment.abs() / (lever_mm * n as f64));
    }
    let mut total = 0;
    for _ in 0..SLICE_STEPS {
        for (i, row) in rows.iter().enumerate() {
            let (approach, slope) = local(i, forces[i]);
            problem.compliance[i] = slope;
            problem.gaps[i] = row.gap + approach - slope * forces[i];
        }
        let (answer, settled, iterations) = pivot(bodies, &problem, active)?;
        total += iterations;
        let mut solution = finish(rows, &problem, answer, settled, total);
        for (i, o) in solution.openings.iter_mut().enumerate() {
            *o += local(i, solution.forces[i]).0;
        }
        solution.residual = exact_residual(rows, &levers, &solution);
        if solution.residual < TOLERANCE {
            return Ok(solution);
        }
        forces.clone_from(&solution.forces);
        active = solution.active;
    }
    Err(ContactError::NotConverged { iterations: total, infeasible: active.len(), points: n })
}

fn levers_of(rows: &[ContactRow], body: usize) -> [Vec<f64>; 2] {
    [rows.iter().map(|r| r.levers[body]).collect(), rows.iter().map(|r| r.torque_levers[body]).collect()]
}

/// Points that touch first when the body turns: those within a hundredth of the way of the nearest.
fn first_guess(rows: &[ContactRow], levers: &[f64], driving: f64) -> Vec<usize> {
    let way = |i: usize| if levers[i] * driving > 0.0 { rows[i].gap / levers[i].abs() } else { f64::INFINITY };
    let mut order: Vec<usize> = (0..rows.len()).filter(|&i| way(i).is_finite()).collect();
    order.sort_by(|&a, &b| way(a).total_cmp(&way(b)));
    order.truncate((rows.len() / 20).max(1));
    order.sort_unstable();
    order
}

/// The active set on which no inactive row is penetrated and no active row pulls: block pivots while they make progress,
/// then single steps that cannot cycle.
fn pivot(
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
        if next.is_empty() {
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
    if carried(&force) * driving <= 0.0 {
        let best = (0..n).max_by(|&a, &b| (problem.levers[a] * driving).total_cmp(&(problem.levers[b] * driving)));
        force.fill(0.0);
        best.into_iter().for_each(|i| force[i] = 1.0);
    }
    let scale = problem.moment / carried(&force);
    force.iter_mut().for_each(|f| *f *= scale);
    let mut working: Vec<usize> = (0..n).filter(|&i| force[i] > 0.0).collect();
    let (mut tolerance, mut steps) = (PIVOT_TOLERANCE, 0);
    while tolerance <= LOOSEST_PIVOT {
        // Rows that neither press nor gape (all gaps alike, more points than nodes) change sides by round-off: let them be.
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

fn finish(rows: &[ContactRow], problem: &Problem, answer: Equality, active: Vec<usize>, iterations: usize) -> Solution {
    let mut forces = vec![0.0; rows.len()];
    for (&i, &f) in active.iter().zip(&answer.forces) {
        forces[i] = f.max(0.0);
    }
    let approach = problem
        .levers
        .iter()
        .fold(0.0f64, |m, l| m.max((l * answer.rotation).abs()))
        .max(answer.openings.iter().fold(0.0, |m: f64, o| m.max(o.abs())));
    let residual = (0..rows.len())
        .map(|i| {
            let gap = problem.gaps[i]
                + problem.levers[i] * answer.rotation
                + answer.openings[i]
                + problem.compliance[i] * forces[i];
            if forces[i] > 0.0 { gap.abs() / approach } else { (-gap).max(0.0) / approach }
        })
        .fold(0.0, f64::max);
    let Equality { rotation, openings, stiffness, .. } = answer;
    Solution { forces, active, rotation, openings, stiffness, iterations, residual }
}

/// Violation of exact contact by a proximal iterate, without the proximal compliance.
fn exact_residual(rows: &[ContactRow], levers: &[f64], s: &Solution) -> f64 {
    let approach = levers
        .iter()
        .fold(0.0f64, |m, l| m.max((l * s.rotation).abs()))
        .max(s.openings.iter().fold(0.0, |m: f64, o| m.max(o.abs())));
    (0..rows.len())
        .map(|i| {
            let gap = rows[i].gap + levers[i] * s.rotation + s.openings[i];
            if s.forces[i] > 0.0 { gap.abs() / approach } else { (-gap).max(0.0) / approach }
        })
        .fold(0.0, f64::max)
}
