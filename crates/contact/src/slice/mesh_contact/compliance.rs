//! Compliance between the rows.

use crate::TablePlace;

use super::{Found, MeshContact};

impl MeshContact {
    /// S between the rows, from both gears' tables or matrices, to serve until modes open gaps by more than `by_modes` (mm).
    pub(super) fn compliance(&mut self, by_modes: f64) {
        let Self { set, found, openings, loads, work, friction, modal, .. } = self;
        let Found { rows, slices, compliance, modal: bent, .. } = found;
        let n = rows.len();
        let symmetric = friction.is_none();
        if let Some(modal) = modal {
            modal.begin(bent, n, !symmetric, by_modes);
        }
        let Some(tables) = set.slices().and_then(|s| s.bulk()) else {
            set.exact_compliance(rows, compliance);
            if let Some(modal) = modal {
                modal.read_rows(bent, rows);
                modal.take_from(bent, n, compliance);
            }
            return;
        };
        compliance.clear();
        compliance.resize(n * n, 0.0);
        for (b, table) in tables.iter().enumerate() {
            let places = |out: &mut Vec<TablePlace>, load: bool| {
                out.clear();
                out.extend(rows.iter().zip(slices.iter()).filter_map(|(row, slice)| {
                    let patch = [row.patches.0, row.patches.1][b];
                    let support = &row.supports[b];
                    let direction = if load { &support.load } else { &support.direction };
                    table.place(&set.patches()[b][patch], patch, slice.at[b], Some(direction))
                }));
            };
            places(openings, false);
            if symmetric {
                table.add(openings, openings, true, &mut work[b], compliance);
            } else {
                places(loads, true);
                table.add(openings, loads, false, &mut work[b], compliance);
            }
            if let Some(modal) = modal {
                modal.read_places(bent, b, openings, false);
                modal.read_places(bent, b, loads, true);
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
            modal.take_from(bent, n, compliance);
        }
    }
}
