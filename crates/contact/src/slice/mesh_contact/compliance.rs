//! Compliance between the rows.

use crate::{BulkTable, ContactSet, TablePoint, compliance::parts, nodal::ContactRow, slice::Slice};

use super::{MeshContact, PoseContact};

impl MeshContact {
    /// Computes S between the rows from the tables or matrices of both gears. It serves until modes open gaps by more
    /// than `by_modes` (mm).
    pub(super) fn compliance(&mut self, by_modes: f64) {
        let Self { set, contact, openings, loads, work, friction, modal, .. } = self;
        let PoseContact { rows, slices, compliance, modal: modal_rows, .. } = contact;
        let n = rows.len();
        let symmetric = friction.is_none();
        if let Some(modal) = modal {
            modal.begin(modal_rows, n, !symmetric, by_modes);
        }
        let Some(tables) = set.slices().and_then(|s| s.bulk()) else {
            set.exact_compliance(rows, compliance);
            if let Some(modal) = modal {
                modal.read_rows(modal_rows, rows);
                modal.take_from(modal_rows, n, compliance);
            }
            return;
        };
        compliance.resize(n * n, 0.0);
        for (j, column) in compliance.chunks_exact_mut(n.max(1)).enumerate() {
            column[if symmetric { j } else { 0 }..].fill(0.0);
        }
        for (b, table) in tables.iter().enumerate() {
            let of = (&rows[..], &slices[..]);
            places(set, (b, table), of, openings, false);
            if !symmetric {
                places(set, (b, table), of, loads, true);
            }
            table.add(openings, if symmetric { openings } else { loads }, symmetric, &mut work[b], compliance);
            if let Some(modal) = modal {
                modal.read_places(modal_rows, b, openings, false);
                modal.read_places(modal_rows, b, loads, true);
            }
        }
        if symmetric {
            mirror(compliance, n);
        }
        if let Some(modal) = modal {
            modal.take_from(modal_rows, n, compliance);
        }
    }
}

/// Takes the lower triangle of a matrix (n x n, column by column) for the upper one.
pub(in crate::slice) fn mirror(matrix: &mut [f64], n: usize) {
    for j in 1..n {
        let (before, own) = matrix.split_at_mut(j * n);
        for (entry, column) in own[..j].iter_mut().zip(before.chunks_exact(n)) {
            *entry = column[j];
        }
    }
}

/// Where rows open (`load`: where their loads stand) in the table of gear `b`.
pub(in crate::slice) fn places(
    set: &ContactSet,
    (b, table): (usize, &BulkTable),
    (rows, slices): (&[ContactRow], &[Slice]),
    out: &mut Vec<TablePoint>,
    load: bool,
) {
    out.clear();
    for (row, slice) in rows.iter().zip(slices) {
        let patch = [row.patches.0, row.patches.1][b];
        let support = &row.supports[b];
        let at = slice.at[b];
        let direction = if load { &support.load } else { &support.direction };
        // Into the flank.
        let parts = if slice.is_along_normals && *direction == support.direction {
            [-1.0, 0.0, 0.0]
        } else {
            parts(&set.patches()[b][patch], at, direction)
        };
        out.extend(table.at(patch, at, parts));
    }
}
