//! Compliance between the rows.

use crate::TablePoint;

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
        compliance.clear();
        compliance.resize(n * n, 0.0);
        for (b, table) in tables.iter().enumerate() {
            let table_points = |out: &mut Vec<TablePoint>, load: bool| {
                out.clear();
                out.extend(rows.iter().zip(slices.iter()).filter_map(|(row, slice)| {
                    let patch = [row.patches.0, row.patches.1][b];
                    let support = &row.supports[b];
                    let direction = if load { &support.load } else { &support.direction };
                    table.at(&set.patches()[b][patch], patch, slice.at[b], Some(direction))
                }));
            };
            table_points(openings, false);
            if symmetric {
                table.add(openings, openings, true, &mut work[b], compliance);
            } else {
                table_points(loads, true);
                table.add(openings, loads, false, &mut work[b], compliance);
            }
            if let Some(modal) = modal {
                modal.read_places(modal_rows, b, openings, false);
                modal.read_places(modal_rows, b, loads, true);
            }
        }
        if symmetric {
            for j in 0..n {
                for i in j + 1..n {
                    compliance[i * n + j] = compliance[j * n + i];
                }
            }
        }
        if let Some(modal) = modal {
            modal.take_from(modal_rows, n, compliance);
        }
    }
}
