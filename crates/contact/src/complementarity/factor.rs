//! The factor of a tangent on the active rows, and solutions with it.

use dyn_stack::MemStack;
use faer::{
    MatMut, MatRef, Par,
    linalg::{lu::partial_pivoting as lu, triangular_solve},
    perm::PermRef,
};

use super::{
    DenseProblem, DenseSolver,
    cholesky::{Cholesky, Substitution},
    dense::RIGID,
};
use crate::ContactError;

/// Right-hand sides up to which each is solved for by itself.
const FEW: usize = 2;

impl DenseSolver {
    /// Factor of S + diag(slopes) on the active rows.
    pub(super) fn factor(&mut self, problem: &DenseProblem<'_>) -> Result<(), ContactError> {
        let m = self.active.len();
        self.saved = false;
        self.factor.clear();
        for (a, &j) in self.active.iter().enumerate() {
            // The lower triangle is enough where S is symmetric.
            let from = if self.symmetric { a } else { 0 };
            self.factor.resize(a * m + from, 0.0);
            let rows = &self.active[from..];
            match problem.compliance.col(j).try_as_col_major() {
                Some(column) => gather(column.as_slice(), rows, &mut self.factor),
                None => self.factor.extend(rows.iter().map(|&i| problem.compliance[(i, j)])),
            }
        }
        for (a, &i) in self.active.iter().enumerate() {
            self.factor[a * (m + 1)] += self.slopes[i];
        }
        if self.symmetric {
            let factored = self.arch.dispatch(Cholesky { matrix: &mut self.factor, order: m });
            factored.then_some(()).ok_or(ContactError::NotPositiveDefinite { points: m })?;
        } else {
            let matrix = MatMut::from_column_major_slice_mut(&mut self.factor, m, m);
            let stack = MemStack::new(&mut self.scratch);
            let [forward, backward] = &mut self.permutation;
            for list in [&mut *forward, &mut *backward] {
                list.clear();
                list.resize(m, 0);
            }
            lu::factor::lu_in_place(matrix, forward, backward, Par::Seq, stack, Default::default());
        }
        Ok(())
    }

    /// Solves with the factor for the first `columns` columns of `x`, m rows each.
    pub(super) fn back_substitute(&mut self, m: usize, columns: usize) {
        if self.symmetric && columns <= FEW {
            let Self { x, factor, arch, .. } = self;
            return x[..m * columns].chunks_exact_mut(m).for_each(|x| arch.dispatch(Substitution { factor, x }));
        }
        let factor = MatRef::from_column_major_slice(&self.factor, m, m);
        if self.symmetric {
            let mut x = MatMut::from_column_major_slice_mut(&mut self.x[..m * columns], m, columns);
            triangular_solve::solve_lower_triangular_in_place(factor, x.as_mut(), Par::Seq);
            triangular_solve::solve_upper_triangular_in_place(factor.transpose(), x, Par::Seq);
        } else {
            let [forward, backward] = &self.permutation;
            // As many columns as the scratch memory is for.
            for x in self.x[..m * columns].chunks_mut(m * RIGID) {
                let columns = x.len() / m;
                let x = MatMut::from_column_major_slice_mut(x, m, columns);
                let permutation = PermRef::new_checked(forward, backward, m);
                let stack = MemStack::new(&mut self.scratch);
                lu::solve::solve_in_place(factor, factor, permutation, x, Par::Seq, stack);
            }
        }
    }
}

/// The entries of the active rows: most of these follow each other.
fn gather(column: &[f64], active: &[usize], out: &mut Vec<f64>) {
    for run in active.chunk_by(|a, b| a + 1 == *b) {
        out.extend_from_slice(&column[run[0]..][..run.len()]);
    }
}
