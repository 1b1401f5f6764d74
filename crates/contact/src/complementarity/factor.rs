//! The factor of a tangent on the active rows, and solutions with it.

use dyn_stack::MemStack;
use faer::{
    Auto, MatMut, MatRef, Par, Spec,
    linalg::{cholesky::llt, lu::partial_pivoting as lu, triangular_solve},
    perm::PermRef,
};

use super::{DenseProblem, DenseSolver, dense::RIGID};
use crate::ContactError;

/// Right-hand sides up to which each is solved for by itself.
const FEW: usize = 2;

impl DenseSolver {
    /// Factor of S + diag(slopes) on the active rows.
    pub(super) fn factor(&mut self, problem: &DenseProblem<'_>) -> Result<(), ContactError> {
        let m = self.active.len();
        self.saved = false;
        self.factor.clear();
        for &j in &self.active {
            match problem.compliance.col(j).try_as_col_major() {
                Some(column) => gather(column.as_slice(), &self.active, &mut self.factor),
                None => self.factor.extend(self.active.iter().map(|&i| problem.compliance[(i, j)])),
            }
        }
        for (a, &i) in self.active.iter().enumerate() {
            self.factor[a * (m + 1)] += self.slopes[i];
        }
        let matrix = MatMut::from_column_major_slice_mut(&mut self.factor, m, m);
        let stack = MemStack::new(&mut self.scratch);
        if self.symmetric {
            llt::factor::cholesky_in_place(matrix, Default::default(), Par::Seq, stack, in_one_go())
                .map_err(|_| ContactError::NotPositiveDefinite { points: m })?;
        } else {
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
            return self.x[..m * columns].chunks_exact_mut(m).for_each(|x| solve_one(&self.factor, x));
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

/// Factors as large as contact has them without recursion, whose small blocks cost four times as much.
fn in_one_go() -> Spec<llt::factor::LltParams, f64> {
    let usual = <llt::factor::LltParams as Auto<f64>>::auto();
    Spec::new(llt::factor::LltParams { recursion_threshold: usual.block_size, ..usual })
}

/// The entries of the active rows: most of these follow each other.
fn gather(column: &[f64], active: &[usize], out: &mut Vec<f64>) {
    for run in active.chunk_by(|a, b| a + 1 == *b) {
        out.extend_from_slice(&column[run[0]..][..run.len()]);
    }
}

/// Solves L L' x = b for one right-hand side in place, L lower triangular, column by column: what a general solver
/// prepares costs more than this for some fifty rows.
fn solve_one(factor: &[f64], x: &mut [f64]) {
    let m = x.len();
    let below = |j: usize| &factor[j * m + j..(j + 1) * m];
    for j in 0..m {
        let column = below(j);
        let share = x[j] / column[0];
        x[j] = share;
        x[j + 1..].iter_mut().zip(&column[1..]).for_each(|(x, l)| *x -= share * l);
    }
    for j in (0..m).rev() {
        let column = below(j);
        x[j] = (x[j] - dot(&column[1..], &x[j + 1..])) / column[0];
    }
}

/// Eight sums side by side, so that they go on together.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    let mut sums = [0.0; LANES];
    for (a, b) in a.zip(b) {
        (0..LANES).for_each(|k| sums[k] += a[k] * b[k]);
    }
    rest + sums.iter().sum::<f64>()
}
