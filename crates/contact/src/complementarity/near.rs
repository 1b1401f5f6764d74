//! Contact after a small change of the gaps: Newton's method with the factor of an earlier tangent (modified Newton).
//!
//! ```text
//! F <- F - (S + diag delta'_0)^-1 (g0 + l dtheta + S F + delta(F)),   dtheta such that the moment is balanced
//! ```
//! Each step reduces the error by a factor of some thousandths: the relative change of the local slopes since the
//! tangent was factored. Convergence is checked with the same contact conditions as any solution. If it fails, or if
//! rows enter or leave the active set, full Newton steps continue from there.

use super::{Balance, DenseProblem, DenseSolver, LocalApproach, TOLERANCE, opening::Opening, pivots::PIVOT_TOLERANCE};
use crate::{ContactError, lanes};

/// A solution and the factor of its tangent, saved for later.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SavedSolution {
    forces: Vec<f64>,
    openings: Vec<f64>,
    approach: Vec<f64>,
    slopes: Vec<f64>,
    active: Vec<usize>,
    factor: Vec<f64>,
    permutation: [Vec<usize>; 2],
    symmetric: bool,
}

/// Steps with the saved tangent before full Newton steps; three or four are enough.
const STEPS: usize = 8;
/// Accuracy of the stiffness, relative.
const STIFFNESS_ACCURACY: f64 = 1e-10;
/// Largest ratio of two successive violations with which the saved tangent is kept.
const SLOW: f64 = 0.25;

impl SavedSolution {
    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        let doubles = [&self.forces, &self.openings, &self.approach, &self.slopes, &self.factor];
        doubles.iter().map(|list| list.len() * size_of::<f64>()).sum()
    }
}

impl DenseSolver {
    /// Saves the last solution with its factor.
    pub(crate) fn save(&mut self, saved: &mut SavedSolution) {
        saved.forces.clone_from(&self.forces);
        saved.openings.clone_from(&self.openings);
        saved.approach.clone_from(&self.approach);
        saved.slopes.clone_from(&self.slopes);
        saved.active.clone_from(&self.active);
        saved.factor.clone_from(&self.factor);
        saved.permutation.clone_from(&self.permutation);
        saved.symmetric = self.symmetric;
        self.saved = true;
    }

    /// Restores a saved solution, as if it had just been computed.
    pub(crate) fn restore(&mut self, saved: &SavedSolution) {
        self.forces.clone_from(&saved.forces);
        self.openings.clone_from(&saved.openings);
        self.approach.clone_from(&saved.approach);
        self.slopes.clone_from(&saved.slopes);
        self.active.clone_from(&saved.active);
        self.factor.clone_from(&saved.factor);
        self.permutation.clone_from(&saved.permutation);
        self.turned.clear();
        (self.symmetric, self.factored, self.saved) = (saved.symmetric, true, true);
        (self.rotation, self.stiffness, self.iterations, self.residual) = (0.0, 0.0, 0, 0.0);
    }

    /// Solves the contact of bodies that do not turn, starting from the last solution of the same rows with the same
    /// compliance. `accuracy` is the violation of the conditions, relative to the largest approach, that counts as
    /// solved; it is at least that of any solution.
    ///
    /// The factor is kept unless rows become active or inactive. So [`DenseSolver::tangent_of`] belongs to nearby
    /// forces.
    ///
    /// # Errors
    /// As [`DenseSolver::solve`].
    pub(crate) fn solve_near(
        &mut self,
        problem: &DenseProblem<'_>,
        local: impl LocalApproach,
        accuracy: f64,
    ) -> Result<(), ContactError> {
        if self.forces.len() != problem.gaps.len() || !self.factored {
            return self.solve(problem, local, |_| 0.0);
        }
        self.iterations = 0;
        // Local approach and slopes are still those of the last solution.
        if self.keeps_factor(problem, |solver, step| solver.follow(problem, (step > 0).then_some(&local)), accuracy) {
            return Ok(());
        }
        self.forces.iter_mut().for_each(|f| *f = f.max(0.0));
        let iterations = self.iterations;
        self.newton(problem, local, 0.0)?;
        self.iterations += iterations;
        Ok(())
    }

    pub(super) fn follow(&mut self, problem: &DenseProblem<'_>, local: Option<&impl LocalApproach>) {
        if let Some(local) = local {
            self.linearise(local);
        }
        self.open(problem);
    }

    /// Solves the contact of the same rows after a small motion, starting from the last solution with its factor.
    /// Returns whether this gave a solution with an unchanged active set. The stiffness is that of the old factor until
    /// `refine_stiffness` is called.
    pub fn solve_moved(&mut self, problem: &DenseProblem<'_>, local: impl LocalApproach) -> bool {
        if self.active.is_empty() || self.forces.len() != problem.gaps.len() || !self.factored {
            return false;
        }
        (self.rotation, self.iterations) = (0.0, 0);
        self.keeps_factor(problem, |solver, _| solver.follow(problem, Some(&local)), TOLERANCE)
    }

    /// Makes the stiffness l_t' A^-1 l, A = S + D, that of the last solution, whose factor M is of some steps before.
    ///
    /// ```text
    /// y = M^-1 l (that of the last balance),   r = l - A y,   z = M^-1 r
    /// l' A^-1 l = l' y + y' r + r' A^-1 r  ~  l' y + y' r + r' z
    /// ```
    /// Without friction one step is enough where r' z is small beside the sum: what is left out is less than it. With friction,
    /// and where M is too far off, y + z is the next y. Where slopes have changed so much that these steps
    /// creep, by a factor of its own.
    pub(crate) fn refine_stiffness(&mut self, problem: &DenseProblem<'_>) {
        let m = self.active.len();
        let (levers, torque_levers) = (problem.levers, problem.torque_levers);
        if self.turned.len() != m {
            self.x.clear();
            self.x.extend(self.active.iter().map(|&i| levers[i]));
            self.back_substitute(m, 1);
            self.turned.clear();
            self.turned.extend_from_slice(&self.x[..m]);
        }
        let [mut found, mut opened] = std::mem::take(&mut self.refined);
        for list in [&mut found, &mut opened] {
            list.clear();
            list.resize(problem.gaps.len(), 0.0);
        }
        self.active.iter().zip(&self.turned).for_each(|(&i, y)| found[i] = *y);
        let mut settled = None;
        for _ in 0..STEPS {
            lanes::run(
                self.arch,
                Opening { compliance: problem.compliance, active: &self.active, forces: &found, out: &mut opened },
            );
            self.x.clear();
            let left = |&i: &usize| levers[i] - opened[i] - self.slopes[i] * found[i];
            self.x.extend(self.active.iter().map(left));
            self.rest.clone_from(&self.x);
            self.back_substitute(m, 1);
            let (mut stiffness, mut change, mut second) = (0.0, 0.0, 0.0);
            for ((&i, z), r) in self.active.iter().zip(&self.x).zip(&self.rest) {
                stiffness += torque_levers[i] * found[i];
                change += if self.symmetric { found[i] * r } else { torque_levers[i] * z };
                second += r * z;
                found[i] += z;
            }
            let told = stiffness + change + if self.symmetric { second } else { 0.0 };
            let off = if self.symmetric { (second / told).abs() } else { (change / told).abs() };
            if off <= STIFFNESS_ACCURACY {
                settled = Some(told);
                break;
            }
        }
        self.refined = [found, opened];
        if settled.is_none() && self.factor(problem).is_ok() {
            self.x.clear();
            self.x.extend(self.active.iter().map(|&i| levers[i]));
            self.back_substitute(m, 1);
            settled = Some(self.active.iter().zip(&self.x).map(|(&i, x)| torque_levers[i] * x).sum());
        }
        self.stiffness = settled.unwrap_or(self.stiffness);
    }

    /// Steps with the factor at hand, until the conditions hold to `accuracy`; false where rows become active or
    /// inactive, or where it leads to nothing. `follow` computes approach and openings of the forces as they are.
    pub(super) fn keeps_factor(
        &mut self,
        problem: &DenseProblem<'_>,
        mut follow: impl FnMut(&mut Self, usize),
        accuracy: f64,
    ) -> bool {
        let accuracy = accuracy.max(TOLERANCE);
        let mut before = f64::INFINITY;
        for step in 0..STEPS {
            follow(self, step);
            if self.takes_sides(problem) {
                return false;
            }
            self.residual = self.violation(problem);
            // A moment is balanced by a step, whatever the levers were before.
            if self.residual < accuracy && (step > 0 || problem.balance == Balance::Held) {
                self.finish();
                return true;
            }
            if self.residual > SLOW * before {
                return false;
            }
            before = self.residual;
            self.correct(problem);
        }
        false
    }

    /// One step with the factor at hand.
    fn correct(&mut self, problem: &DenseProblem<'_>) {
        self.iterations += 1;
        let m = self.active.len();
        self.x.clear();
        for &i in &self.active {
            self.x.push(problem.gaps[i] + problem.levers[i] * self.rotation + self.approach[i] + self.openings[i]);
        }
        let mut turn = 0.0;
        if let Balance::Moment(moment) = problem.balance {
            // Forces by a unit turn are those of the factor, too: the levers of any pose nearby balance the moment.
            if self.turned.len() == m {
                self.x.extend_from_slice(&self.turned);
                self.back_substitute(m, 1);
            } else {
                self.x.extend(self.active.iter().map(|&i| problem.levers[i]));
                self.back_substitute(m, 2);
                self.keep_turned();
            }
            let (mut carried, mut stiffness) = (0.0, 0.0);
            for (a, &i) in self.active.iter().enumerate() {
                carried += problem.torque_levers[i] * (self.forces[i] - self.x[a]);
                stiffness += problem.torque_levers[i] * self.x[m + a];
            }
            turn = (carried - moment) / stiffness;
            self.rotation += turn;
            self.stiffness = stiffness;
        } else {
            self.x.resize(2 * m, 0.0);
            self.back_substitute(m, 1);
        }
        for (a, &i) in self.active.iter().enumerate() {
            self.forces[i] -= self.x[a] + turn * self.x[m + a];
        }
    }

    /// Keeps the second of two columns of solutions.
    pub(super) fn keep_turned(&mut self) {
        self.turned.clear();
        self.turned.extend_from_slice(&self.x[self.active.len()..]);
    }

    /// Whether an active row pulls, or another one overlaps.
    fn takes_sides(&self, problem: &DenseProblem<'_>) -> bool {
        if self.active.iter().any(|&i| self.forces[i] <= 0.0) {
            return true;
        }
        let least = -PIVOT_TOLERANCE * self.scale(problem);
        let gap = |i: usize| problem.gaps[i] + problem.levers[i] * self.rotation + self.openings[i];
        let mut active = self.active.iter().peekable();
        (0..problem.gaps.len()).any(|i| active.next_if(|a| **a == i).is_none() && gap(i) < least)
    }

    /// Whether the factor is that of a saved or restored solution: the set of active rows has not changed since.
    pub(crate) fn has_saved_factor(&self) -> bool {
        self.saved
    }
}
