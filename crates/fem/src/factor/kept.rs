//! A factor as plain lists and numbers, to be saved and restored.

use super::{BoundaryLastFactor, structure::Structure};
use crate::ordering::{Ordering, try_zeroed};

/// Content of a [`BoundaryLastFactor`].
#[derive(Debug, Clone, PartialEq)]
pub struct KeptFactor {
    /// Matrix rows in the order of elimination, the boundary last.
    pub order: Vec<u32>,
    /// Number of interior rows, those not on the boundary.
    pub interior: u32,
    /// Number of columns of each supernode.
    pub widths: Vec<u32>,
    /// Rows of L below the triangle of each supernode, ascending.
    pub rows: Vec<Vec<u32>>,
    /// Entries of each column of L from the diagonal down, including explicit zeros inside supernodes.
    pub values: Vec<f64>,
}

impl BoundaryLastFactor {
    /// Content of the factor; `None` if a row number does not fit into 32 bits.
    pub fn to_kept(&self) -> Option<KeptFactor> {
        u32::try_from(self.n()).ok()?;
        let narrow = |rows: &[usize]| rows.iter().map(|&row| row as u32).collect::<Vec<u32>>();
        let mut values = Vec::with_capacity(self.nonzeros());
        for node in self.supernodes() {
            for c in 0..node.columns {
                match node.values.col(c).try_as_col_major() {
                    Some(column) => values.extend_from_slice(&column.as_slice()[c..]),
                    None => values.extend(node.values.col(c).iter().skip(c)),
                }
            }
        }
        Some(KeptFactor {
            order: narrow(&self.ordering.forward),
            interior: self.ordering.interior as u32,
            widths: self.supernodes().map(|node| node.columns as u32).collect(),
            rows: self.supernodes().map(|node| narrow(node.pattern)).collect(),
            values,
        })
    }

    /// Restores a factor with the same bits; `None` if the parts are inconsistent.
    pub fn from_kept(kept: &KeptFactor) -> Option<Self> {
        let KeptFactor { order, interior, widths, rows, values: packed } = kept;
        let (n, interior) = (order.len(), *interior as usize);
        let structure = Structure::new(widths, rows, n).filter(|_| interior <= n)?;
        let (forward, mut inverse) = (order.iter().map(|&row| row as usize).collect::<Vec<_>>(), vec![n; n]);
        for (new, &old) in forward.iter().enumerate() {
            // Each row once.
            let place = inverse.get_mut(old).filter(|place| **place == n)?;
            *place = new;
        }
        let mut values: Vec<f64> = try_zeroed(structure.values()).ok()?;
        let mut left = &packed[..];
        let mut blocks = &mut values[..];
        for (k, &width) in widths.iter().enumerate() {
            let (width, height) = (width as usize, width as usize + structure.below(k).len());
            let (block, rest) = blocks.split_at_mut_checked(width * height)?;
            for (c, column) in block.chunks_exact_mut(height).enumerate() {
                let (own, after) = left.split_at_checked(height - c)?;
                column[c..].copy_from_slice(own);
                left = after;
            }
            blocks = rest;
        }
        let ordering = Ordering { forward, inverse, interior };
        left.is_empty().then(|| Self::assembled(ordering, structure, values))
    }
}
