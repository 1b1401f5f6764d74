//! Slices of a solved contact at the positions of the gears, and their compliance under its forces, from which
//! derivatives of the solution are computed. Theory (77).

use faer::Mat;

use super::{
    SliceHint,
    flank_pair::FlankPair,
    flank_pair::Slice,
    mesh_contact::{mirror, places},
};
use crate::{BulkTable, ContactSet, Friction, Pose, TableWork, local::LocalLaws, nodal::ContactRow};

/// Slices and their rows, sorted by pair and height.
#[derive(Debug, Clone, Default)]
pub struct SameSlices {
    /// The rows with undeformed gaps.
    pub rows: Vec<ContactRow>,
    /// The slice of each row.
    pub slices: Vec<Slice>,
}

impl ContactSet {
    /// The slices at the heights of `like` with the gears' frames at `poses`; `None` if the flanks do not face each
    /// other at one of them.
    pub fn same_slices(&self, friction: Option<&Friction>, poses: &[Pose; 2], like: &SameSlices) -> Option<SameSlices> {
        let slice_set = self.slices()?;
        let patches = [&self.patches()[0][..], &self.patches()[1][..]];
        let mut found = SameSlices::default();
        let mut from = 0;
        for of_pair in like.rows.chunk_by(|a, b| a.patches == b.patches) {
            let numbers = of_pair[0].patches;
            let pair = FlankPair::new(slice_set.flanks(patches, numbers), poses);
            for (row, slice) in of_pair.iter().zip(&like.slices[from..]) {
                let mut hint = SliceHint::near(slice.at[0][0]);
                let point = pair.nearest_point(slice.z, &mut hint)?;
                let (mut row, slice) = pair.slice(&point, numbers, row.point, slice_set.length())?;
                if !slice_set.may_touch(&slice) {
                    return None;
                }
                // Tables of compliance do not use the nodes of a row.
                if slice_set.bulk().is_none() && !pair.support(&mut row, &slice, &mut hint) {
                    return None;
                }
                found.rows.push(friction.map_or(row, |f| f.on(poses, row)));
                found.slices.push(slice);
            }
            from += of_pair.len();
        }
        Some(found)
    }

    /// Memory to read the tables of both gears for up to `rows` rows; empty if there are no tables.
    pub fn table_work(&self, rows: usize) -> Vec<TableWork> {
        self.tables().map(|both| both.iter().map(|_| TableWork::new(rows)).collect()).unwrap_or_default()
    }

    fn tables(&self) -> Option<&[BulkTable; 2]> {
        self.slices().and_then(|s| s.bulk())
    }
}

impl SameSlices {
    /// Selected slices of a list of rows.
    pub fn of(rows: &[ContactRow], slices: &[Slice], which: &[usize]) -> Self {
        Self {
            rows: which.iter().map(|&i| rows[i]).collect(),
            slices: which.iter().map(|&i| slices[i].clone()).collect(),
        }
    }

    /// dR/dF under forces (N), mm/N. R is the distance of the flanks including their own deformation; it is 0 where
    /// they are in contact.
    ///
    /// ```text
    /// R_i = g_i + sum_j S_ij F_j + delta_i(F_i)
    /// ```
    /// `work` is [`ContactSet::table_work`] of this set or of one with the same tables.
    pub fn compliance(&self, set: &ContactSet, forces: &[f64], work: &mut [TableWork]) -> Mat<f64> {
        let n = self.rows.len();
        let matrix = self.bulk(set, work);
        let mut laws = LocalLaws::with_capacity(n);
        laws.take(self.slices.iter().map(|slice| (&slice.local, slice.length)));
        let [mut approaches, mut slopes] = [vec![0.0; n], vec![0.0; n]];
        laws.linearise(forces, &mut approaches, &mut slopes);
        Mat::from_fn(n, n, |i, j| matrix[j * n + i] + if i == j { slopes[i] } else { 0.0 })
    }

    /// Moment of forces (N) about the axis of gear `body`, N mm.
    pub fn moment(&self, body: usize, forces: &[f64]) -> f64 {
        self.rows.iter().zip(forces).map(|(row, f)| row.torque_levers[body] * f).sum()
    }

    /// Largest pressure of a slice under its force (N), MPa.
    pub fn pressure(&self, slice: usize, force: f64) -> f64 {
        let slice = &self.slices[slice];
        slice.local.under(force / slice.length).pressure
    }

    /// S between the rows, mm/N, column by column.
    fn bulk(&self, set: &ContactSet, work: &mut [TableWork]) -> Vec<f64> {
        let n = self.rows.len();
        let mut matrix = vec![0.0; n * n];
        let Some(tables) = set.tables() else {
            set.exact_compliance(&self.rows, &mut matrix);
            return matrix;
        };
        let symmetric = self.rows.iter().all(|row| row.traction == row.normal);
        let (mut openings, mut loads) = (Vec::new(), Vec::new());
        for (b, (table, work)) in tables.iter().zip(work).enumerate() {
            let of = (&self.rows[..], &self.slices[..]);
            places(set, (b, table), of, &mut openings, false);
            if !symmetric {
                places(set, (b, table), of, &mut loads, true);
            }
            table.add(&openings, &loads, symmetric, work, &mut matrix);
        }
        if symmetric {
            mirror(&mut matrix, n);
        }
        matrix
    }
}
