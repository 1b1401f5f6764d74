//! Contact conditions g >= 0, p >= 0, p g = 0 at every point, and a rotation that balances the moment. Theory (16),
//! (17).
//!
//! ```text
//! g_i = g0_i + l_i dtheta + o_i(F) + d_i F_i,    sum_i l_i F_i = M
//! F_i >= 0,  g_i >= 0,  F_i g_i = 0
//! ```
//! With friction the moment of a force has a separate lever, and the openings are those by normal and friction force
//! together. g0 is the undeformed gap, l the lever, o the opening by elastic deflection, d the local compliance: 1/(k
//! A_i) for the penalty law, 0 for exact contact. The problem is the optimality condition of a convex quadratic
//! programme, so rotation and gaps are unique.

mod active_set_fallback;
mod cholesky;
mod dense;
mod factor;
mod near;
mod opening;
mod pivots;
mod proximal;
mod slices;
mod tangent;

use crate::{ContactError, nodal::ContactRow};

pub use dense::{Balance, DenseProblem, DenseSolver, LocalApproach};
pub(crate) use near::SavedSolution;
pub(crate) use proximal::LAST_COMPLIANCE;
pub use proximal::solve;
pub(crate) use slices::solve_slices;

/// Resistance of a contact point to penetration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// No penetration.
    Exact,
    /// Pressure = stiffness times penetration; stiffness in MPa/mm.
    Penalty(f64),
}

/// Elastic bodies that respond linearly to contact forces.
pub trait LinearContact {
    /// Forces and rotation with `g_i = 0` on the active rows only (the sign of the forces is not checked), and the
    /// elastic openings o_i at all rows.
    ///
    /// # Errors
    /// [`ContactError`] if the equations have no unique solution.
    fn solve(&mut self, active: &[usize], problem: &Problem) -> Result<Equality, ContactError>;

    /// Compliance of a typical row under its own force, mm/N.
    ///
    /// # Errors
    /// [`ContactError`] if the elastic model fails.
    fn self_compliance(&mut self) -> Result<f64, ContactError>;

    /// Displacements of both bodies' boundary nodes, three per node, mm, under the given row forces. These must be the
    /// forces of the last solution of [`LinearContact::solve`].
    fn displacements(&self, forces: &[f64]) -> [Vec<f64>; 2];
}

/// Data of the complementarity problem, one entry per row.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Undeformed gaps g0, mm.
    pub gaps: Vec<f64>,
    /// Levers l, mm.
    pub levers: Vec<f64>,
    /// Moment per unit normal force, friction included, mm; equal to l without friction.
    pub torque_levers: Vec<f64>,
    /// Local compliance d, mm/N.
    pub compliance: Vec<f64>,
    /// Moment M, N mm.
    pub moment: f64,
    /// Whether the bodies do not move: then dtheta is 0 and M is ignored.
    pub held: bool,
}

/// Solution of the equality problem on an active set.
#[derive(Debug, Clone, PartialEq)]
pub struct Equality {
    /// Forces of the active rows, N.
    pub forces: Vec<f64>,
    /// Rotation dtheta, rad.
    pub rotation: f64,
    /// Elastic openings o_i of all rows, mm.
    pub openings: Vec<f64>,
    /// Tangent torsional stiffness of the mesh on this active set, -dM/dtheta, N mm/rad.
    pub stiffness: f64,
}

/// Solution of the contact problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Force of every row, N, >= 0.
    pub forces: Vec<f64>,
    /// Rows that carry force, ascending.
    pub active: Vec<usize>,
    /// Rotation dtheta, rad.
    pub rotation: f64,
    /// Elastic opening of every row, mm.
    pub openings: Vec<f64>,
    /// Torsional stiffness -dM/dtheta, N mm/rad.
    pub stiffness: f64,
    /// Number of active-set iterations.
    pub iterations: usize,
    /// Largest violation of the contact conditions: gap over the largest approach, negative force over the largest
    /// force.
    pub residual: f64,
}

/// Violation that counts as solved, relative to approach and force.
pub(crate) const TOLERANCE: f64 = 1e-11;

/// The rows as the body sees them that is free to turn.
struct DrivenRows {
    levers: Vec<f64>,
    torque_levers: Vec<f64>,
    balance: Balance,
}

/// Levers of the rows on a body, which must be able to carry the moment.
///
/// # Errors
/// [`ContactError::CannotCarryTorque`].
fn driven_rows(rows: &[ContactRow], body: usize, balance: Balance) -> Result<DrivenRows, ContactError> {
    let levers = rows.iter().map(|r| r.levers[body]).collect();
    let torque_levers = rows.iter().map(|r| r.torque_levers[body]).collect();
    let driven = DrivenRows { levers, torque_levers, balance };
    let (moment, held) = balance.moment();
    let lever_mm = driven.longest();
    let carries = !rows.is_empty() && lever_mm > 0.0 && moment.is_finite() && moment != 0.0;
    if held || carries { Ok(driven) } else { Err(ContactError::CannotCarryTorque { lever_mm }) }
}

impl DrivenRows {
    /// The longest lever against the moment, mm.
    fn longest(&self) -> f64 {
        let driving = self.balance.moment().0.signum();
        self.levers.iter().fold(0.0f64, |m, l| m.max(l * driving))
    }

    /// Points that touch first when the body turns: the twentieth of them that is nearest. Of bodies that stand still,
    /// those that overlap.
    fn first_guess(&self, rows: &[ContactRow]) -> Vec<usize> {
        let (moment, held) = self.balance.moment();
        if held {
            return (0..rows.len()).filter(|&i| rows[i].gap < 0.0).collect();
        }
        let way = |i: usize| {
            let lever = self.levers[i];
            if lever * moment.signum() > 0.0 { rows[i].gap / lever.abs() } else { f64::INFINITY }
        };
        let mut order: Vec<usize> = (0..rows.len()).filter(|&i| way(i).is_finite()).collect();
        order.sort_by(|&a, &b| way(a).total_cmp(&way(b)));
        order.truncate((rows.len() / 20).max(1));
        order.sort_unstable();
        order
    }

    /// A typical force of one of `n` rows, N: half of them share the moment.
    fn typical_force(&self, n: usize) -> f64 {
        let (moment, held) = self.balance.moment();
        if held { 1.0 } else { 2.0 * moment.abs() / (self.longest() * n as f64) }
    }
}

impl Problem {
    /// Rows with these gaps (mm) and compliances of their own (mm/N).
    fn new(gaps: Vec<f64>, rows: &DrivenRows, compliance: Vec<f64>, balance: Balance) -> Self {
        let (moment, held) = balance.moment();
        let (levers, torque_levers) = (rows.levers.clone(), rows.torque_levers.clone());
        Self { gaps, levers, torque_levers, compliance, moment, held }
    }
}

fn finish(problem: &Problem, answer: Equality, active: Vec<usize>, iterations: usize) -> Solution {
    let mut forces = vec![0.0; problem.gaps.len()];
    for (&i, &f) in active.iter().zip(&answer.forces) {
        forces[i] = f.max(0.0);
    }
    let approach = problem
        .levers
        .iter()
        .fold(0.0f64, |m, l| m.max((l * answer.rotation).abs()))
        .max(answer.openings.iter().fold(0.0, |m: f64, o| m.max(o.abs())));
    let residual = (0..forces.len())
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
fn exact_residual(gaps: &[f64], levers: &[f64], s: &Solution) -> f64 {
    let approach = levers
        .iter()
        .fold(0.0f64, |m, l| m.max((l * s.rotation).abs()))
        .max(s.openings.iter().fold(0.0, |m: f64, o| m.max(o.abs())))
        .max(f64::MIN_POSITIVE);
    (0..gaps.len())
        .map(|i| {
            let gap = gaps[i] + levers[i] * s.rotation + s.openings[i];
            if s.forces[i] > 0.0 { gap.abs() / approach } else { (-gap).max(0.0) / approach }
        })
        .fold(0.0, f64::max)
}
