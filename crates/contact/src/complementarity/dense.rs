//! Slices whose compliance is given as a matrix: Newton's method on forces and active set at once, in reused memory.
//! Theory (37).

use std::ops::Range;

use dyn_stack::MemBuffer;
use faer::{
    MatRef, Par,
    linalg::{cholesky::llt, lu::partial_pivoting as lu},
};

use super::{TOLERANCE, cholesky::padded, pivots::PIVOT_TOLERANCE};
use crate::{ContactError, complementarity::opening::Opening, lanes};

/// Coordinates of two rigid bodies.
pub(super) const RIGID: usize = 12;

/// Condition on the bodies: equilibrium with a moment, or no motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Balance {
    /// The bodies do not move, whatever the forces.
    Held,
    /// One body rotates until contact carries this moment about its axis, N mm.
    Moment(f64),
}

impl Balance {
    /// The moment, N mm, and whether the bodies stand still.
    pub(super) fn moment(self) -> (f64, bool) {
        match self {
            Self::Moment(moment) => (moment, false),
            Self::Held => (0.0, true),
        }
    }
}

/// Contact of n rows that are coupled by a dense compliance.
///
/// ```text
/// g_i = g0_i + l_i dtheta + sum_j S_ij F_j + delta_i(F_i) >= 0,   F_i >= 0,   F_i g_i = 0
/// ```
#[derive(Debug, Clone, Copy)]
pub struct DenseProblem<'a> {
    /// Compliance S, mm/N, n x n, both triangles.
    pub compliance: MatRef<'a, f64>,
    /// Whether S is symmetric, which holds without friction.
    pub symmetric: bool,
    /// Undeformed gaps g0, mm.
    pub gaps: &'a [f64],
    /// Levers l, mm.
    pub levers: &'a [f64],
    /// Moment per unit normal force, friction included, mm.
    pub torque_levers: &'a [f64],
    /// Whether the rotation dtheta is held at 0 or balances a moment.
    pub balance: Balance,
}

/// Local compliance of the rows, nonlinear in their forces.
pub trait LocalApproach {
    /// Approach delta (mm) of a row under a force (N), and its slope (mm/N), which is positive.
    fn under(&self, row: usize, force: f64) -> (f64, f64);

    /// Approach and slope of the active rows under their forces; the values of other rows are not used.
    fn linearise(&self, active: &[usize], forces: &[f64], approach: &mut [f64], slopes: &mut [f64]) {
        active.iter().for_each(|&i| (approach[i], slopes[i]) = self.under(i, forces[i]));
    }
}

impl<F: Fn(usize, f64) -> (f64, f64)> LocalApproach for F {
    fn under(&self, row: usize, force: f64) -> (f64, f64) {
        self(row, force)
    }
}

/// Solver with memory for a given number of rows. [`DenseSolver::solve`] allocates nothing unless its Newton steps do
/// not converge.
pub struct DenseSolver {
    pub(super) forces: Vec<f64>,
    pub(super) openings: Vec<f64>,
    pub(super) approach: Vec<f64>,
    pub(super) slopes: Vec<f64>,
    pub(super) active: Vec<usize>,
    pub(super) order: Vec<usize>,
    /// Force with which each row entered the active set last, N; 0 of those that have not entered.
    pub(super) entered: Vec<f64>,
    pub(super) runs: Vec<Range<usize>>,
    pub(super) factor: Vec<f64>,
    pub(super) x: Vec<f64>,
    pub(super) column: Vec<f64>,
    /// Forces by a unit turn, and what they open.
    pub(super) refined: [Vec<f64>; 2],
    /// Forces on the active rows by a unit turn with the factor at hand; none where they are not known.
    pub(super) turned: Vec<f64>,
    /// What a solution leaves of its equations.
    pub(super) rest: Vec<f64>,
    pub(super) permutation: [Vec<usize>; 2],
    pub(super) scratch: MemBuffer,
    pub(super) arch: pulp::Arch,
    pub(super) symmetric: bool,
    /// Whether the factor is that of the active rows.
    pub(super) factored: bool,
    /// Whether the factor is that of a solution that was put away.
    pub(super) saved: bool,
    pub(super) rotation: f64,
    pub(super) stiffness: f64,
    pub(super) iterations: usize,
    pub(super) residual: f64,
}

/// Newton steps in which the active set may change as a whole; three to eight do.
const BLOCK_STEPS: usize = 24;

/// Violation of the conditions below which the factor at hand leads to a solution under a moment: it costs three times
/// what a step with it does. Tangents of bodies that are held are those of the last forces and want a factor of their own.
const CLOSE: f64 = 1e-5;

/// Force of a row that comes back, over the one that it came with before.
const RETURNS_WITH: f64 = 0.1;
/// Force of a row that enters, over its overlap and its own stiffness: it shares its approach with some neighbours.
const ENTERS_WITH: f64 = 0.2;

impl std::fmt::Debug for DenseSolver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DenseSolver").field("active", &self.active).field("residual", &self.residual).finish()
    }
}

impl DenseSolver {
    /// Allocates memory for up to `most` rows.
    pub fn new(most: usize) -> Self {
        let lu = lu::factor::lu_in_place_scratch::<usize, f64>(most, most, Par::Seq, Default::default());
        let llt = llt::factor::cholesky_in_place_scratch::<f64>(most, Par::Seq, Default::default());
        let solve = lu::solve::solve_in_place_scratch::<usize, f64>(most, RIGID, Par::Seq);
        Self {
            forces: Vec::with_capacity(most),
            openings: Vec::with_capacity(most),
            approach: Vec::with_capacity(most),
            slopes: Vec::with_capacity(most),
            active: Vec::with_capacity(most),
            order: Vec::with_capacity(most),
            entered: Vec::with_capacity(most),
            runs: Vec::with_capacity(most),
            factor: Vec::with_capacity(padded(most).pow(2)),
            x: Vec::with_capacity(RIGID * most),
            column: Vec::with_capacity(padded(most)),
            refined: [Vec::with_capacity(most), Vec::with_capacity(most)],
            turned: Vec::with_capacity(most),
            rest: Vec::with_capacity(most),
            permutation: [Vec::with_capacity(most), Vec::with_capacity(most)],
            scratch: MemBuffer::new(lu.or(solve).or(llt)),
            arch: pulp::Arch::new(),
            symmetric: true,
            factored: false,
            saved: false,
            rotation: 0.0,
            stiffness: 0.0,
            iterations: 0,
            residual: 0.0,
        }
    }

    /// Force of every row, N, >= 0.
    pub fn forces(&self) -> &[f64] {
        &self.forces
    }

    /// Opening of every row by the total compliance, including its own, mm.
    pub fn openings(&self) -> &[f64] {
        &self.openings
    }

    /// Rows in contact, ascending.
    pub fn active(&self) -> &[usize] {
        &self.active
    }

    /// Rotation dtheta, rad.
    pub fn rotation(&self) -> f64 {
        self.rotation
    }

    /// Torsional stiffness -dM/dtheta, N mm/rad, if a moment is balanced.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Number of Newton steps of the last solve.
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// Largest violation of the contact conditions relative to the largest approach.
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// Solves the contact. `local(i, F)` gives delta_i (mm) and its slope (mm/N, positive). `start` is the initial
    /// force of row i; 0 if there is none.
    ///
    /// Newton's method on forces and active set at once (semi-smooth Newton; Hintermueller, Ito, Kunisch, SIAM J.
    /// Optim. 13(3), 2003). Rows with tensile force leave the active set and rows that overlap enter it, each with the
    /// tangent of its delta. If this cycles, tangents are frozen while the set is found by pivoting, which cannot
    /// cycle.
    ///
    /// # Errors
    /// [`ContactError::NotConverged`], [`ContactError::CannotCarryTorque`], [`ContactError::NotPositiveDefinite`].
    pub fn solve(
        &mut self,
        problem: &DenseProblem<'_>,
        local: impl LocalApproach,
        start: impl Fn(usize) -> f64,
    ) -> Result<(), ContactError> {
        self.solve_to(0.0, problem, local, start)
    }

    /// Solves the contact until the violation of the conditions, relative to the largest approach, is at most
    /// `accuracy`. The accuracy is never better than that of [`DenseSolver::solve`].
    ///
    /// # Errors
    /// The errors of [`DenseSolver::solve`].
    pub fn solve_to(
        &mut self,
        accuracy: f64,
        problem: &DenseProblem<'_>,
        local: impl LocalApproach,
        start: impl Fn(usize) -> f64,
    ) -> Result<(), ContactError> {
        self.forces.clear();
        self.forces.extend((0..problem.gaps.len()).map(start));
        self.newton(problem, local, accuracy)
    }

    /// Solves the contact from the present forces.
    pub(super) fn newton(
        &mut self,
        problem: &DenseProblem<'_>,
        local: impl LocalApproach,
        accuracy: f64,
    ) -> Result<(), ContactError> {
        let (n, turns) = (problem.gaps.len(), problem.balance != Balance::Held);
        for list in [&mut self.openings, &mut self.approach, &mut self.slopes, &mut self.entered] {
            list.clear();
            list.resize(n, 0.0);
        }
        (self.rotation, self.stiffness, self.iterations, self.residual) = (0.0, 0.0, 0, 0.0);
        self.symmetric = problem.symmetric;
        self.factored = false;
        self.active.clear();
        self.active.extend((0..n).filter(|&i| self.forces[i] > 0.0));
        if self.active.is_empty() {
            self.first_guess(problem)?;
        }
        if self.active.is_empty() {
            self.factor.clear();
            self.factored = true;
            return Ok(());
        }
        self.linearise(&local);
        let mut kept = false;
        for _ in 0..BLOCK_STEPS {
            if self.active.is_empty() && problem.balance != Balance::Held {
                break;
            }
            self.step(problem)?;
            let changed = self.change_sides(problem);
            self.linearise(&local);
            if changed {
                continue;
            }
            self.residual = self.violation(problem);
            let mut solved = self.residual < accuracy.max(TOLERANCE);
            if solved {
                self.finish();
            } else if turns && !kept && self.residual < CLOSE {
                kept = true;
                let follow = |solver: &mut Self, step| {
                    if step > 0 {
                        solver.follow(problem, Some(&local))
                    }
                };
                solved = self.keeps_factor(problem, follow, accuracy);
                if !solved {
                    self.forces.iter_mut().for_each(|f| *f = f.max(0.0));
                    self.linearise(&local);
                }
            }
            if solved {
                // The factor has the slopes of some steps before.
                if turns && accuracy < TOLERANCE {
                    self.refine_stiffness(problem);
                }
                return Ok(());
            }
        }
        self.solve_by_active_set(problem, local)
    }

    /// Rows that touch first, with a force that is not far off.
    fn first_guess(&mut self, problem: &DenseProblem<'_>) -> Result<(), ContactError> {
        let n = problem.gaps.len();
        match problem.balance {
            Balance::Moment(moment) => {
                let driving = moment.signum();
                let lever_mm = problem.levers.iter().fold(0.0f64, |m, l| m.max(l * driving));
                if n == 0 || lever_mm <= 0.0 || !moment.is_finite() || moment == 0.0 {
                    return Err(ContactError::CannotCarryTorque { lever_mm });
                }
                let way = |i: usize| problem.gaps[i] / (problem.levers[i] * driving);
                self.order.clear();
                self.order.extend((0..n).filter(|&i| problem.levers[i] * driving > 0.0));
                self.order.sort_unstable_by(|&a, &b| way(a).total_cmp(&way(b)).then(a.cmp(&b)));
                self.order.truncate((n / 20).max(1));
                self.order.sort_unstable();
                self.active.extend(&self.order);
                // Tangents at a typical force: half of the rows share the load.
                let typical = 2.0 * moment.abs() / (lever_mm * n as f64);
                self.active.iter().for_each(|&i| self.forces[i] = typical);
            }
            Balance::Held => {
                let deepest = problem.gaps.iter().fold(0.0f64, |m, g| m.max(-g));
                let own = (0..n).map(|i| problem.compliance[(i, i)]).fold(f64::MIN_POSITIVE, f64::max);
                self.active.extend((0..n).filter(|&i| problem.gaps[i] < 0.0));
                // A row shares its approach with some ten neighbours.
                self.active.iter().for_each(|&i| self.forces[i] = 0.1 * deepest / own);
            }
        }
        Ok(())
    }

    /// Approach and slope of the local compliance of the active rows at the forces as they are.
    pub(super) fn linearise(&mut self, local: &impl LocalApproach) {
        local.linearise(&self.active, &self.forces, &mut self.approach, &mut self.slopes);
    }

    /// Forces, rotation and bulk openings of the linear problem on the active rows.
    pub(super) fn step(&mut self, problem: &DenseProblem<'_>) -> Result<(), ContactError> {
        self.iterations += 1;
        let m = self.active.len();
        if m == 0 {
            (self.rotation, self.stiffness) = (0.0, 0.0);
            [&mut self.forces, &mut self.openings].into_iter().for_each(|list| list.fill(0.0));
            return Ok(());
        }
        self.factor(problem)?;
        self.x.clear();
        for &i in &self.active {
            self.x.push(-(problem.gaps[i] + self.approach[i] - self.slopes[i] * self.forces[i]));
        }
        self.x.extend(self.active.iter().map(|&i| problem.levers[i]));
        let columns = if problem.balance == Balance::Held { 1 } else { 2 };
        self.back_substitute(m, columns);
        self.rotation = 0.0;
        if let Balance::Moment(moment) = problem.balance {
            self.keep_turned();
            let dot = |x: &[f64]| self.active.iter().zip(x).map(|(&i, x)| problem.torque_levers[i] * x).sum::<f64>();
            let (carried, stiffness) = (dot(&self.x[..m]), dot(&self.x[m..]));
            (self.rotation, self.stiffness) = ((carried - moment) / stiffness, stiffness);
        }
        self.forces.fill(0.0);
        for (a, &i) in self.active.iter().enumerate() {
            let force = self.x[a] - self.rotation * self.x[m + a];
            self.forces[i] = force;
        }
        self.open(problem);
        Ok(())
    }

    /// Bulk openings of all rows by the forces on the active ones.
    pub(super) fn open(&mut self, problem: &DenseProblem<'_>) {
        lanes::run(
            self.arch,
            Opening {
                compliance: problem.compliance,
                active: &self.active,
                forces: &self.forces,
                out: &mut self.openings,
            },
        );
    }

    /// Rows that pull leave, rows that overlap enter; whether any did. The tangent of a local approach at too large a force
    /// makes a row pull that ought to press lightly: one that comes back does so with less.
    fn change_sides(&mut self, problem: &DenseProblem<'_>) -> bool {
        let scale = self.scale(problem);
        let Self { forces, active, openings, order, entered, rotation, factored, .. } = self;
        let largest = forces.iter().fold(0.0f64, |m, f| m.max(f.abs()));
        order.clear();
        let (mut changed, mut before) = (false, active.iter().peekable());
        for i in 0..problem.gaps.len() {
            if before.next_if(|active| **active == i).is_some() {
                if forces[i] >= -PIVOT_TOLERANCE * largest {
                    order.push(i);
                } else {
                    changed = true;
                }
                forces[i] = forces[i].max(0.0);
                continue;
            }
            let gap = problem.gaps[i] + problem.levers[i] * *rotation + openings[i];
            if gap < -PIVOT_TOLERANCE * scale {
                order.push(i);
                changed = true;
                // Its tangent is that of a force that is not far off.
                let force = -ENTERS_WITH * gap / problem.compliance[(i, i)].max(f64::MIN_POSITIVE);
                forces[i] = if entered[i] > 0.0 { force.min(RETURNS_WITH * entered[i]) } else { force };
                entered[i] = forces[i];
            }
        }
        std::mem::swap(active, order);
        *factored &= !changed;
        changed
    }

    /// Largest approach, mm.
    pub(super) fn scale(&self, problem: &DenseProblem<'_>) -> f64 {
        let turned = problem.levers.iter().fold(0.0f64, |m, l| m.max((l * self.rotation).abs()));
        let opened = self.openings.iter().fold(turned, |m, o| m.max(o.abs()));
        if problem.balance == Balance::Held { problem.gaps.iter().fold(opened, |m, g| m.max(-g)) } else { opened }
    }

    /// Violation of the conditions by the forces as they are.
    pub(super) fn violation(&self, problem: &DenseProblem<'_>) -> f64 {
        let gap = |i: usize| problem.gaps[i] + problem.levers[i] * self.rotation + self.openings[i];
        let of = |i: usize| {
            if self.forces[i] > 0.0 { (gap(i) + self.approach[i]).abs() } else { (-gap(i)).max(0.0) }
        };
        let worst = (0..problem.gaps.len()).map(of).fold(0.0, f64::max);
        let scale = self.scale(problem);
        if scale > 0.0 { worst / scale } else { worst }
    }

    /// Takes the solution of some of the rows of a problem that this one's is a part of. It has no factor.
    pub(crate) fn take_part(&mut self, whole: &Self, rows: Range<usize>) {
        self.forces.clear();
        self.forces.extend_from_slice(&whole.forces[rows.clone()]);
        self.openings.clear();
        self.openings.extend_from_slice(&whole.openings[rows.clone()]);
        self.active.clear();
        self.active.extend(whole.active.iter().filter(|row| rows.contains(row)).map(|row| row - rows.start));
        (self.factored, self.saved, self.symmetric) = (false, false, whole.symmetric);
        (self.rotation, self.stiffness) = (0.0, 0.0);
        (self.iterations, self.residual) = (whole.iterations, whole.residual);
    }

    pub(super) fn finish(&mut self) {
        for &i in &self.active {
            if self.forces[i] > 0.0 {
                self.openings[i] += self.approach[i];
            }
        }
    }
}
