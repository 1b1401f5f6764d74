//! Products with a dense lower triangle, column blocks in parallel, each block sequential.

use faer::{
    Accum, Mat, MatMut, MatRef, Par,
    linalg::{
        matmul::matmul,
        triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place},
    },
    reborrow::ReborrowMut,
};
use rayon::prelude::*;

/// Columns of a task: wide enough for fast products, narrow enough to spread evenly over the threads.
const BLOCK: usize = 96;

/// S = L L' for a lower triangle L, both triangles of S.
pub(super) fn times_transpose(l: MatRef<'_, f64>) -> Mat<f64> {
    by_lower_blocks(l.nrows(), |start, width, below| {
        // rows from `start` on: row i of L times the block's own rows of L, which end at its last column
        let end = start + width;
        let (rows, own) = (l.get(start.., ..end), l.get(start..end, ..end));
        matmul(below, Accum::Replace, rows, own.transpose(), 1.0, Par::Seq);
    })
}

/// C = (L L')^-1 for a lower triangle L, both triangles of C.
///
/// Rows from j on of columns from j on need only the part of L below and right of (j, j).
pub(super) fn inverse_of_product(l: MatRef<'_, f64>) -> Mat<f64> {
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
