//! Node blocks of a symmetric matrix: its lower triangle, stored row by row.

/// Place of block (i, j), i >= j, in a lower triangle stored row by row.
pub(crate) const fn block_index(i: usize, j: usize) -> usize {
    i * (i + 1) / 2 + j
}
