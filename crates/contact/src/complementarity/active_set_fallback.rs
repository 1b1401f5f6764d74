//! Fallback for Newton's method on forces and active set when it cycles: tangents are frozen while the active set is
//! found.

use super::{
    DenseProblem, DenseSolver, Equality, LinearContact, LocalApproach, Problem,
    slices::{Rows, newton},
};
use crate::ContactError;

impl DenseSolver {
    /// Solves the same problem by an active-set method with frozen tangents.
    pub(super) fn solve_by_active_set(
        &mut self,
        problem: &DenseProblem<'_>,
        local: impl LocalApproach,
    ) -> Result<(), ContactError> {
        let before = self.iterations;
        let rows = Rows {
            gaps: problem.gaps,
            levers: problem.levers,
            torque_levers: problem.torque_levers,
            balance: problem.balance,
        };
        let active = self.active.clone();
        let mut bodies = DenseBodies { problem: *problem, solver: Self::new(problem.gaps.len()) };
        let solution = newton(&mut bodies, &rows, |i, force| local.under(i, force), self.forces.clone(), active)?;
        self.forces.copy_from_slice(&solution.forces);
        self.openings.copy_from_slice(&solution.openings);
        self.active = solution.active;
        (self.rotation, self.stiffness, self.residual) = (solution.rotation, solution.stiffness, solution.residual);
        self.iterations = before + solution.iterations;
        // Factors the last tangents: [`DenseSolver::tangent_of`] needs the factor.
        let inner = bodies.solver;
        for &i in &self.active {
            self.slopes[i] = inner.slopes[i];
            self.approach[i] = local.under(i, self.forces[i]).0;
        }
        self.factor(problem)
    }
}

/// The dense compliance as elastic bodies, for the pivots.
struct DenseBodies<'a> {
    problem: DenseProblem<'a>,
    solver: DenseSolver,
}

impl LinearContact for DenseBodies<'_> {
    fn solve(&mut self, active: &[usize], p: &Problem) -> Result<Equality, ContactError> {
        let n = p.gaps.len();
        let solver = &mut self.solver;
        let linear = DenseProblem { gaps: &p.gaps, ..self.problem };
        for list in [&mut solver.forces, &mut solver.openings, &mut solver.approach] {
            list.clear();
            list.resize(n, 0.0);
        }
        solver.symmetric = self.problem.symmetric;
        solver.slopes.clone_from(&p.compliance);
        solver.active.clear();
        solver.active.extend(active);
        solver.step(&linear)?;
        Ok(Equality {
            forces: active.iter().map(|&i| solver.forces[i]).collect(),
            rotation: solver.rotation,
            openings: solver.openings.clone(),
            stiffness: solver.stiffness,
        })
    }

    fn self_compliance(&mut self) -> Result<f64, ContactError> {
        let s = self.problem.compliance;
        Ok((0..s.nrows()).map(|i| s[(i, i)]).sum::<f64>() / s.nrows().max(1) as f64)
    }

    fn displacements(&self, _: &[f64]) -> [Vec<f64>; 2] {
        Default::default()
    }
}
