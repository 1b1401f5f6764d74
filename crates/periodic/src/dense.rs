//! Solution of the dense equations of a Newton step, on one core: the same bits whatever the machine has.

use dyn_stack::{MemBuffer, MemStack};
use faer::{MatMut, MatRef, Par, linalg::lu::partial_pivoting as lu, perm::PermRef};
use nalgebra::{DMatrix, DVector};

/// x of A x = b; `None` where there is none.
pub(crate) fn solved(mut matrix: DMatrix<f64>, mut right: DVector<f64>) -> Option<DVector<f64>> {
    let n = matrix.nrows();
    let factoring = lu::factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
    let solving = lu::solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
    let mut scratch = MemBuffer::try_new(factoring.or(solving)).ok()?;
    let stack = MemStack::new(&mut scratch);
    let (mut forward, mut backward) = (vec![0usize; n], vec![0usize; n]);
    let a = MatMut::from_column_major_slice_mut(matrix.as_mut_slice(), n, n);
    lu::factor::lu_in_place(a, &mut forward, &mut backward, Par::Seq, stack, Default::default());
    let factor = MatRef::from_column_major_slice(matrix.as_slice(), n, n);
    let permutation = PermRef::new_checked(&forward, &backward, n);
    let x = MatMut::from_column_major_slice_mut(right.as_mut_slice(), n, 1);
    lu::solve::solve_in_place(factor, factor, permutation, x, Par::Seq, stack);
    right.iter().all(|v| v.is_finite()).then_some(right)
}
