//! Dense kernels. Column blocks are computed in parallel, each block sequentially, so the bits are the same for any
//! number of threads.

use dyn_stack::{MemBuffer, MemStack};
use faer::{
    Accum, Mat, MatMut, MatRef, Par, Spec, c64,
    diag::Diag,
    linalg::{
        cholesky::llt::factor::{LltError, cholesky_in_place, cholesky_in_place_scratch},
        evd::{ComputeEigenvectors, evd_real, evd_scratch, self_adjoint_evd, self_adjoint_evd_scratch},
        matmul::matmul,
        triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place},
    },
    reborrow::ReborrowMut,
};
use rayon::prelude::*;

use crate::{
    FemError,
    column_blocks::{ColumnBlocks, ColumnBlocksMut},
};

/// Columns of a task: wide enough for fast products, narrow enough to spread evenly over the threads.
const BLOCK: usize = 96;

/// L of A = L L', n x n, with zeros above the diagonal. A is symmetric positive definite; only its lower triangle is
/// read.
///
/// # Errors
/// [`FemError::NotPositiveDefinite`] with the row of the pivot that is not positive; [`FemError::OutOfMemory`].
pub fn cholesky(a: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
    let n = a.nrows();
    let mut l = a.to_owned();
    let scratch = cholesky_in_place_scratch::<f64>(n, Par::Seq, Spec::default());
    let mut memory =
        MemBuffer::try_new(scratch).map_err(|_| FemError::OutOfMemory { bytes: scratch.unaligned_bytes_required() })?;
    let stack = MemStack::new(&mut memory);
    match cholesky_in_place(l.as_mut(), Default::default(), Par::Seq, stack, Spec::default()) {
        Err(LltError::NonPositivePivot { index }) => {
            Err(FemError::NotPositiveDefinite { dof: index, pivot_ratio: 0.0 })
        }
        Ok(_) if l.as_ref().diagonal().column_vector().iter().all(|d| d.is_finite()) => {
            // The kernel leaves other things there.
            (1..n).for_each(|j| l.as_mut().col_mut(j).subrows_mut(0, j).fill(0.0));
            Ok(l)
        }
        Ok(_) => Err(FemError::NotPositiveDefinite { dof: 0, pivot_ratio: f64::NAN }),
    }
}

/// Eigenvalues (ascending) and orthonormal eigenvectors (columns, in the same order) of a symmetric matrix. Only its
/// lower triangle is read.
///
/// # Errors
/// [`FemError::NotFinite`] if an entry is not a finite number, [`FemError::OutOfMemory`].
pub fn symmetric_eigen(a: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), FemError> {
    let n = a.nrows();
    if n == 0 {
        return Ok((Vec::new(), Mat::zeros(0, 0)));
    }
    let not_finite = (0..n).flat_map(|j| (j..n).map(move |i| (i, j))).find(|&(i, j)| !a[(i, j)].is_finite());
    if let Some((row, column)) = not_finite {
        return Err(FemError::NotFinite { row, column });
    }
    let scratch = self_adjoint_evd_scratch::<f64>(n, ComputeEigenvectors::Yes, Par::Seq, Default::default());
    let mut memory =
        MemBuffer::try_new(scratch).map_err(|_| FemError::OutOfMemory { bytes: scratch.unaligned_bytes_required() })?;
    let (mut values, mut vectors) = (Diag::<f64>::zeros(n), Mat::zeros(n, n));
    let stack = MemStack::new(&mut memory);
    // The iteration ends for every matrix of numbers; what it says otherwise is about the same thing.
    self_adjoint_evd(a, values.as_mut(), Some(vectors.as_mut()), Par::Seq, stack, Default::default())
        .map_err(|_| FemError::NotFinite { row: 0, column: 0 })?;
    Ok((values.column_vector().iter().copied().collect(), vectors))
}

/// Eigenvalues and eigenvectors (columns in the same order, each of length 1) of a real square matrix. Complex
/// eigenvalues come in consecutive conjugate pairs.
///
/// # Errors
/// [`FemError::Shape`], [`FemError::NotFinite`], [`FemError::OutOfMemory`], [`FemError::NoEigenvalues`] if the
/// iteration does not converge.
pub fn general_eigen(a: MatRef<'_, f64>) -> Result<(Vec<c64>, Mat<c64>), FemError> {
    let n = a.nrows();
    if a.ncols() != n {
        return Err(FemError::Shape { what: "columns of a square matrix", expected: n, found: a.ncols() });
    }
    if n == 0 {
        return Ok((Vec::new(), Mat::zeros(0, 0)));
    }
    let not_finite = (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).find(|&(i, j)| !a[(i, j)].is_finite());
    if let Some((row, column)) = not_finite {
        return Err(FemError::NotFinite { row, column });
    }
    let (none, right) = (ComputeEigenvectors::No, ComputeEigenvectors::Yes);
    let scratch = evd_scratch::<f64>(n, none, right, Par::Seq, Default::default());
    let mut memory =
        MemBuffer::try_new(scratch).map_err(|_| FemError::OutOfMemory { bytes: scratch.unaligned_bytes_required() })?;
    let (mut re, mut im, mut u) = (Diag::<f64>::zeros(n), Diag::<f64>::zeros(n), Mat::zeros(n, n));
    let stack = MemStack::new(&mut memory);
    evd_real(a, re.as_mut(), im.as_mut(), None, Some(u.as_mut()), Par::Seq, stack, Default::default())
        .map_err(|_| FemError::NoEigenvalues { size: n })?;
    let (re, im) = (re.column_vector(), im.column_vector());
    let values: Vec<c64> = (0..n).map(|i| c64::new(re[i], im[i])).collect();
    let mut vectors = Mat::<c64>::zeros(n, n);
    let mut j = 0;
    while j < n {
        // The columns of a pair are real and imaginary part of the first one's vector.
        let pair = im[j] != 0.0 && j + 1 < n;
        for i in 0..n {
            let (x, y) = (u[(i, j)], if pair { u[(i, j + 1)] } else { 0.0 });
            vectors[(i, j)] = c64::new(x, y);
            if pair {
                vectors[(i, j + 1)] = c64::new(x, -y);
            }
        }
        j += 1 + usize::from(pair);
    }
    for j in 0..n {
        let length = (0..n).map(|i| vectors[(i, j)].norm_sqr()).sum::<f64>().sqrt();
        if length > 0.0 {
            (0..n).for_each(|i| vectors[(i, j)] /= length);
        }
    }
    Ok((values, vectors))
}

/// Computes L^-1 B in place for a lower triangle L, n x n; B is n x k.
pub fn solve_lower(l: MatRef<'_, f64>, rhs: MatMut<'_, f64>) {
    rhs.par_col_chunks_mut(BLOCK).for_each(|rhs| solve_lower_triangular_in_place(l, rhs, Par::Seq));
}

/// Computes L^-T B in place for a lower triangle L, n x n; B is n x k.
pub fn solve_lower_transposed(l: MatRef<'_, f64>, rhs: MatMut<'_, f64>) {
    rhs.par_col_chunks_mut(BLOCK).for_each(|rhs| solve_upper_triangular_in_place(l.transpose(), rhs, Par::Seq));
}

/// Product A B, m x k.
pub fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut result = Mat::zeros(a.nrows(), b.ncols());
    result.as_mut().par_col_chunks_mut(BLOCK).zip(b.par_col_chunks(BLOCK)).for_each(|(result, b)| {
        matmul(result, Accum::Replace, a, b, 1.0, Par::Seq);
    });
    result
}

/// Z' Z for Z of size m x n, both triangles.
pub fn gram(z: MatRef<'_, f64>) -> Mat<f64> {
    by_lower_blocks(z.ncols(), |start, width, below| {
        let (rows, own) = (z.subcols(start, z.ncols() - start), z.subcols(start, width));
        matmul(below, Accum::Replace, rows.transpose(), own, 1.0, Par::Seq);
    })
}

/// S = L L' for a lower triangle L, both triangles of S.
pub fn times_transpose(l: MatRef<'_, f64>) -> Mat<f64> {
    by_lower_blocks(l.nrows(), |start, width, below| {
        // rows from `start` on: row i of L times the block's own rows of L, which end at its last column
        let end = start + width;
        let (rows, own) = (l.get(start.., ..end), l.get(start..end, ..end));
        matmul(below, Accum::Replace, rows, own.transpose(), 1.0, Par::Seq);
    })
}

/// C = (L L')^-1 for a lower triangle L, both triangles of C.
///
/// Rows and columns from j on need only the part of L below and to the right of (j, j).
pub fn inverse_of_product(l: MatRef<'_, f64>) -> Mat<f64> {
    by_lower_blocks(l.nrows(), |start, width, mut below| {
        let l = l.get(start.., start..);
        for c in 0..width {
            below[(c, c)] = 1.0;
        }
        solve_lower_triangular_in_place(l, below.rb_mut(), Par::Seq);
        solve_upper_triangular_in_place(l.transpose(), below, Par::Seq);
    })
}

/// A symmetric matrix from its lower triangle, computed by blocks: `fill(start, width, rows from start on)`.
fn by_lower_blocks(n: usize, fill: impl Fn(usize, usize, MatMut<'_, f64>) + Sync) -> Mat<f64> {
    let mut result = Mat::zeros(n, n);
    result.as_mut().par_col_chunks_mut(BLOCK).enumerate().for_each(|(k, block)| {
        let (start, width) = (k * BLOCK, block.ncols());
        fill(start, width, block.subrows_mut(start, n - start));
    });
    for j in 0..n {
        for i in j + 1..n {
            result[(j, i)] = result[(i, j)];
        }
    }
    result
}
