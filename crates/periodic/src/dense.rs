//! Solution of dense equations, real and complex, on one core: the same bits whatever the machine has.

use dyn_stack::{MemBuffer, MemStack};
use faer::{MatMut, MatRef, Par, linalg::lu::partial_pivoting as lu, perm::PermRef, traits::ComplexField};
use nalgebra::{DMatrix, DVector, Scalar};

/// Factors of a square matrix, rows exchanged.
pub(crate) struct Factors<T: Scalar> {
    both: DMatrix<T>,
    rows: [Vec<usize>; 2],
}

impl<T: ComplexField + Scalar> Factors<T> {
    /// `None` where there is no memory for them.
    pub fn new(mut matrix: DMatrix<T>) -> Option<Self> {
        let n = matrix.nrows();
        let mut scratch =
            MemBuffer::try_new(lu::factor::lu_in_place_scratch::<usize, T>(n, n, Par::Seq, Default::default())).ok()?;
        let (mut forward, mut backward) = (vec![0usize; n], vec![0usize; n]);
        let a = MatMut::from_column_major_slice_mut(matrix.as_mut_slice(), n, n);
        let stack = MemStack::new(&mut scratch);
        lu::factor::lu_in_place(a, &mut forward, &mut backward, Par::Seq, stack, Default::default());
        Some(Self { both: matrix, rows: [forward, backward] })
    }

    /// X of A X = B, without a check that it is finite.
    pub fn solve(&self, mut right: DMatrix<T>) -> Option<DMatrix<T>> {
        let (n, columns) = (self.both.nrows(), right.ncols());
        let mut scratch =
            MemBuffer::try_new(lu::solve::solve_in_place_scratch::<usize, T>(n, columns, Par::Seq)).ok()?;
        let factor = MatRef::from_column_major_slice(self.both.as_slice(), n, n);
        let permutation = PermRef::new_checked(&self.rows[0], &self.rows[1], n);
        let x = MatMut::from_column_major_slice_mut(right.as_mut_slice(), n, columns);
        let stack = MemStack::new(&mut scratch);
        lu::solve::solve_in_place(factor, factor, permutation, x, Par::Seq, stack);
        Some(right)
    }
}

/// x of A x = b; `None` where there is none.
pub(crate) fn solved(matrix: DMatrix<f64>, right: DVector<f64>) -> Option<DVector<f64>> {
    let right = DMatrix::from_column_slice(right.len(), 1, right.as_slice());
    let x = Factors::new(matrix)?.solve(right)?;
    x.iter().all(|v| v.is_finite()).then(|| x.column(0).into_owned())
}
