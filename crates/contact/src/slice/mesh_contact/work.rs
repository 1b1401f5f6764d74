//! Computational cost of an evaluation.

use crate::{
    SlicePoint, TablePoint,
    nodal::ContactRow,
    slice::{Slice, SliceHint},
};

use super::MeshContact;

/// Memory traffic and operations of one evaluation; see [`MeshContact::work`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactWork {
    /// Data that it reads or writes at least once, bytes.
    pub bytes: f64,
    /// Floating-point operations of its linear algebra. Search and local compliance, a few hundred operations per
    /// slice, are not counted.
    pub flops: f64,
}

impl MeshContact {
    /// Memory traffic and operations of the last evaluation, from the sizes of its arrays.
    pub fn work(&self) -> ContactWork {
        let (n, m) = (self.contact.rows.len() as f64, self.solver.active().len() as f64);
        let steps = self.solver.iterations() as f64;
        let touched = self.work.each_ref().map(|w| w.touched() as f64);
        let table_points: f64 =
            self.openings.iter().chain(&self.loads).map(|p| p.points() as f64).sum::<f64>() / n.max(1.0);
        let of_row = size_of::<ContactRow>() + size_of::<Slice>() + 2 * size_of::<TablePoint>();
        let of_station = size_of::<SliceHint>() + size_of::<(usize, SlicePoint)>();
        let doubles = touched.iter().map(|t| t * t).sum::<f64>() + n * n + m * m + 12.0 * m;
        let tables: f64 = touched.iter().map(|t| 2.0 * table_points * n * t + table_points * n * n).sum();
        let newton = steps * (m * m * m / 3.0 + 2.0 * m * m + 2.0 * n * m);
        let tangent = 12.0 * m * m + 156.0 * m;
        ContactWork {
            bytes: 8.0 * doubles + n * of_row as f64 + (self.hints.len() * of_station) as f64,
            flops: tables + newton + tangent,
        }
    }
}
