//! Stores blocks of a table as their lower triangles.

use std::ops::Range;

use super::mirror;

/// Lower triangles of some blocks of a table, column by column.
pub(super) fn packed(table: &[f64], count: usize, blocks: Range<usize>) -> Vec<f64> {
    let mut values = Vec::with_capacity(blocks.len() * count * (count + 1) / 2);
    for (block, column) in columns(blocks, count) {
        values.extend_from_slice(&table[(block * count + column) * count + column..][..count - column]);
    }
    values
}

/// Blocks of a table from their lower triangles; those before them are left empty. `None` where there are more or less.
pub(super) fn unpacked(values: &[f64], count: usize, blocks: Range<usize>) -> Option<Vec<f64>> {
    let mut left = values;
    let mut table = vec![0.0; blocks.end * count * count];
    for (block, column) in columns(blocks.clone(), count) {
        let (own, rest) = left.split_at_checked(count - column)?;
        table[(block * count + column) * count + column..][..own.len()].copy_from_slice(own);
        left = rest;
    }
    mirror(&mut table, count, blocks.start);
    left.is_empty().then_some(table)
}

/// Block and column of everything that is kept of some blocks.
fn columns(blocks: Range<usize>, count: usize) -> impl Iterator<Item = (usize, usize)> {
    blocks.flat_map(move |block| (0..count).map(move |column| (block, column)))
}
