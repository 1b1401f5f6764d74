//! Tables that are kept with their gear: a later run of the same flanks need not make them.

use std::sync::Arc;

use reduction::{GearReducer, KeptTable, TableKey, Window};

use super::{DIRECTIONS, mirror};
use crate::{flank::FlankPatch, nodal::Support};

/// The code that makes a table and reads it: with any other, even in a comment, a table is made again.
const CODE: [&str; 3] = [include_str!("mod.rs"), include_str!("keep.rs"), include_str!("../bulk_grid.rs")];

/// The gear that keeps the tables of a window.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Keeper<'a> {
    pub gear: &'a GearReducer,
    pub window: &'a Window,
}

impl Keeper<'_> {
    /// Key of all that a table depends on beside the matrices of the gear: the code, teeth of the window, where the grid points
    /// stand on the nodes and along which directions, and the flanks on which the table's error is measured.
    pub(super) fn key(&self, supports: &[Option<[Support; DIRECTIONS]>], patches: &[FlankPatch]) -> TableKey {
        let mut content: Vec<u8> = Vec::new();
        for code in CODE {
            content.extend((code.len() as u64).to_le_bytes());
            content.extend(code.bytes());
        }
        let reduced = &self.window.reduced;
        content.extend((reduced.teeth.len() as u64).to_le_bytes());
        reduced.teeth.iter().for_each(|tooth| content.extend(tooth.to_le_bytes()));
        for patch in patches {
            patch.range().as_flattened().iter().for_each(|v| content.extend(v.to_le_bytes()));
        }
        content.extend((supports.len() as u64).to_le_bytes());
        for support in supports {
            content.push(u8::from(support.is_some()));
            let Some(along) = support else { continue };
            let Support { nodes, weights, count, .. } = &along[0];
            content.extend((*count as u64).to_le_bytes());
            nodes[..*count].iter().for_each(|node| content.extend(node.to_le_bytes()));
            weights[..*count].iter().for_each(|w| content.extend(w.to_le_bytes()));
            let directions = along.iter().flat_map(|s| s.direction.iter().chain(s.load.iter()));
            directions.for_each(|v| content.extend(v.to_le_bytes()));
        }
        TableKey::of(&content)
    }

    /// Error and entries of a table of `count` points along each direction, if it is kept.
    pub(super) fn table(&self, key: &TableKey, count: usize) -> Option<(f64, Vec<f64>)> {
        let KeptTable { error, values } = self.gear.kept_table(key)?;
        let mut left = &values[..];
        let mut table = vec![0.0; (DIRECTIONS * count).pow(2)];
        for (block, column) in columns(count) {
            let (own, rest) = left.split_at_checked(count - column)?;
            table[(block * count + column) * count + column..][..own.len()].copy_from_slice(own);
            left = rest;
        }
        mirror(&mut table, count);
        left.is_empty().then_some((error, table))
    }

    /// Keeps a table: of each block the lower triangle, which tells the rest.
    pub(super) fn keep(&self, key: TableKey, error: f64, table: &[f64], count: usize) {
        let mut values = Vec::with_capacity(DIRECTIONS * DIRECTIONS * count * (count + 1) / 2);
        for (block, column) in columns(count) {
            values.extend_from_slice(&table[(block * count + column) * count + column..][..count - column]);
        }
        self.gear.keep_table(key, &KeptTable { error, values: Arc::new(values) });
    }
}

/// Block and column of everything that is kept.
fn columns(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..DIRECTIONS * DIRECTIONS).flat_map(move |block| (0..count).map(move |column| (block, column)))
}
