//! Blocks of columns of a matrix, for all threads.

use faer::{MatMut, MatRef};
use rayon::{prelude::*, vec::IntoIter};

/// A matrix that is read by blocks of its columns.
pub(crate) trait ColumnBlocks<'a> {
    /// Blocks of `width` columns (1 or more) from left to right; the last one may have fewer.
    fn par_col_chunks(self, width: usize) -> IntoIter<MatRef<'a, f64>>;
}

/// A matrix that is written by blocks of its columns.
pub(crate) trait ColumnBlocksMut<'a> {
    /// Blocks as in [`ColumnBlocks::par_col_chunks`].
    fn par_col_chunks_mut(self, width: usize) -> IntoIter<MatMut<'a, f64>>;
}

impl<'a> ColumnBlocks<'a> for MatRef<'a, f64> {
    fn par_col_chunks(self, width: usize) -> IntoIter<MatRef<'a, f64>> {
        let starts = (0..self.ncols()).step_by(width);
        let blocks: Vec<_> = starts.map(|start| self.subcols(start, width.min(self.ncols() - start))).collect();
        blocks.into_par_iter()
    }
}

impl<'a> ColumnBlocksMut<'a> for MatMut<'a, f64> {
    fn par_col_chunks_mut(self, width: usize) -> IntoIter<MatMut<'a, f64>> {
        let (mut rest, mut blocks) = (self, Vec::new());
        while rest.ncols() > 0 {
            let (block, others) = {
                let at = width.min(rest.ncols());
                rest.split_at_col_mut(at)
            };
            blocks.push(block);
            rest = others;
        }
        blocks.into_par_iter()
    }
}
