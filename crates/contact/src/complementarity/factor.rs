//! Factor of a tangent on the active rows, and solutions with it.

use dyn_stack::MemStack;
use faer::{
    MatMut, MatRef, Par,
    linalg::{cholesky::llt, lu::partial_pivoting as lu, triangular_solve},
    perm::PermRef,
};

use super::{
    DenseProblem, DenseSolver,
    cholesky::{Cholesky, Substitution, padded},
    dense::RIGID,
};
use crate::{ContactError, lanes};

/// Active rows from which on a factor in blocks for large orders is the faster one: those of joined contacts.
const LARGE: usize = 256;
/// Right-hand sides up to which each is solved for by itself.
const FEW: usize = 2;

impl DenseSolver {
    /// Factor of S + diag(slopes) on the active rows.
    pub(super) fn factor(&mut self, problem: &DenseProblem<'_>) -> Result<(), ContactError> {
        let m = self.active.len();
        let order = padded(m);
        (self.factored, self.saved) = (false, false);
        self.turned.clear();
        if m == 0 {
            // Nothing presses: there is nothing to factor, and nothing to solve for.
            self.factored = true;
            return Ok(());
        }
        // Most of the active rows follow each other.
        self.runs.clear();
        self.runs.extend(self.active.chunk_by(|a, b| a + 1 == *b).map(|run| run[0]..run[0] + run.len()));
        self.factor.resize(order * order, 0.0);
        let (columns, rest) = self.factor.split_at_mut(m * order);
        for ((a, &j), entries) in self.active.iter().enumerate().zip(columns.chunks_exact_mut(order)) {
            // The lower triangle is enough where S is symmetric.
            let from = if self.symmetric { a } else { 0 };
            let (mut own, below) = entries[from..].split_at_mut(m - from);
            below.fill(0.0);
            match problem.compliance.col(j).try_as_col_major() {
                Some(column) => {
                    let start = self.active[from];
                    for run in self.runs.iter().filter(|run| run.end > start) {
                        let part = &column.as_slice()[run.start.max(start)..run.end];
                        let (now, after) = own.split_at_mut(part.len());
                        now.copy_from_slice(part);
                        own = after;
                    }
                }
                None => own.iter_mut().zip(&self.active[from..]).for_each(|(x, &i)| *x = problem.compliance[(i, j)]),
            }
            entries[a] += self.slopes[j];
        }
        for (a, entries) in (m..order).zip(rest.chunks_exact_mut(order)) {
            entries.fill(0.0);
            entries[a] = 1.0;
        }
        if self.symmetric && m >= LARGE {
            let matrix = MatMut::from_column_major_slice_with_stride_mut(&mut self.factor, m, m, order);
            let stack = MemStack::new(&mut self.scratch);
            let factored =
                llt::factor::cholesky_in_place(matrix, Default::default(), Par::Seq, stack, Default::default());
            factored.map_err(|_| ContactError::NotPositiveDefinite { points: m })?;
        } else if self.symmetric {
            let factored = lanes::run(self.arch, Cholesky { matrix: &mut self.factor, order });
            factored.then_some(()).ok_or(ContactError::NotPositiveDefinite { points: m })?;
        } else {
            let matrix = MatMut::from_column_major_slice_with_stride_mut(&mut self.factor, m, m, order);
            let stack = MemStack::new(&mut self.scratch);
            let [forward, backward] = &mut self.permutation;
            for list in [&mut *forward, &mut *backward] {
                list.clear();
                list.resize(m, 0);
            }
            lu::factor::lu_in_place(matrix, forward, backward, Par::Seq, stack, Default::default());
        }
        self.factored = true;
        Ok(())
    }

    /// The factor of the active rows.
    pub(super) fn factored(factor: &[f64], m: usize) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice_with_stride(factor, m, m, padded(m))
    }

    /// Solves with the factor for the first `columns` columns of `x`, m rows each.
    pub(super) fn back_substitute(&mut self, m: usize, columns: usize) {
        if m == 0 {
            return;
        }
        if self.symmetric && columns <= FEW {
            let Self { x, factor, arch, column, .. } = self;
            for x in x[..m * columns].chunks_exact_mut(m) {
                column.clear();
                column.extend_from_slice(x);
                column.resize(padded(m), 0.0);
                lanes::run(*arch, Substitution { factor, x: column });
                x.copy_from_slice(&column[..m]);
            }
            return;
        }
        let factor = Self::factored(&self.factor, m);
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
