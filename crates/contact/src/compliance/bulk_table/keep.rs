//! Tables stored with their gear, so that a later run with the same flanks reads them.

use std::sync::Arc;

use reduction::{GearReducer, KeptTable, TableKey, Window};

use super::{
    BulkBody, DIRECTIONS,
    triangles::{packed, unpacked},
    whole::{Source, WholeEntries},
};
use crate::{flank::FlankPatch, nodal::Support};

/// The code that makes a table and reads it: with any other, even in a comment, a table is made again.
const CODE: [&str; 5] = [
    include_str!("mod.rs"),
    include_str!("keep.rs"),
    include_str!("triangles.rs"),
    include_str!("whole.rs"),
    include_str!("../bulk_grid.rs"),
];

/// The gear that keeps the tables of a window.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Keeper<'a> {
    pub gear: &'a GearReducer,
    pub window: &'a Window,
    pub body: &'a Arc<BulkBody>,
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

    /// Error and entries of a table of points at `supports`, if it is kept.
    pub(super) fn table(
        &self,
        key: &TableKey,
        supports: &[Option<[Support; DIRECTIONS]>],
    ) -> Option<(f64, WholeEntries)> {
        let KeptTable { error, normal, others } = self.gear.kept_table(key)?;
        let count = supports.len();
        let normal = unpacked(&normal, count, 0..1)?;
        let part = self.gear.table_part(key, others);
        let source = Source { part, body: self.body.clone(), supports: supports.to_vec() };
        Some((error, WholeEntries::kept(normal, source)))
    }

    /// Keeps a table: of each block the lower triangle, which tells the rest.
    pub(super) fn keep(&self, key: TableKey, error: f64, table: &[f64], count: usize) {
        let of = |blocks| Arc::new(packed(table, count, blocks));
        let (normal, others) = (of(0..1), Some(of(1..DIRECTIONS * DIRECTIONS)));
        self.gear.keep_table(key, &KeptTable { error, normal, others });
    }
}
