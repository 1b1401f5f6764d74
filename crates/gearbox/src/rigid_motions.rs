//! Number of rigid motions of shafts that are not held, counted from the connections and not from the magnitude of
//! eigenvalues. Theory (80).

use std::ops::Range;

use nalgebra::{DMatrix, SymmetricEigen};

use crate::Assembly;

/// Eigenvalue of a stiffness whose diagonal is 1, up to which it is round-off: springs that differ by thirteen decades do
/// not meet in one machine.
pub(crate) const NOTHING: f64 = 1e-13;

impl Assembly {
    /// Number of independent motions of all shafts, each rigid, that bearings, housing and (`with_meshes`) meshes do not
    /// resist: as many natural frequencies are 0. `axes`: which displacements (0 .. 2) and turns (3 .. 5) a shaft has.
    ///
    /// ```text
    /// n = dim ker R' (K - K_shafts) R,   q = R (motions of the shafts about their middles)
    /// ```
    /// The shafts' own stiffness, whose round-off would look like a spring, is left out: rigid motions do not strain it.
    pub(crate) fn rigid_motions(&self, axes: impl Fn(usize) -> Range<usize>, with_meshes: bool) -> usize {
        let r = self.motions_of_rigid_shafts(axes);
        let k = r.tr_mul(&(self.holding(with_meshes) * &r));
        let resisted: Vec<usize> = (0..k.nrows()).filter(|&i| k[(i, i)] > 0.0).collect();
        let scaled = DMatrix::from_fn(resisted.len(), resisted.len(), |i, j| {
            let (i, j) = (resisted[i], resisted[j]);
            0.5 * (k[(i, j)] + k[(j, i)]) / (k[(i, i)] * k[(j, j)]).sqrt()
        });
        let free = k.nrows() - resisted.len();
        if resisted.is_empty() {
            return free;
        }
        free + SymmetricEigen::new(scaled).eigenvalues.iter().filter(|x| **x < NOTHING).count()
    }

    /// R: a column for each way in which a shaft can move as a whole.
    fn motions_of_rigid_shafts(&self, axes: impl Fn(usize) -> Range<usize>) -> DMatrix<f64> {
        let mut columns: Vec<Vec<(usize, f64)>> = Vec::new();
        for (shaft, (first, line)) in self.lines().enumerate() {
            let heights = self.heights(shaft);
            let middle = 0.5 * line.positions().last().copied().unwrap_or(0.0);
            for axis in axes(shaft) {
                let of_node = |(i, z): (usize, &f64)| {
                    let (at, arm) = (first + 6 * i, z - middle);
                    let along = match axis {
                        3 => vec![(at + 1, -arm)],
                        4 => vec![(at, arm)],
                        _ => Vec::new(),
                    };
                    along.into_iter().chain([(at + axis, 1.0)])
                };
                columns.push(heights.iter().enumerate().flat_map(of_node).collect());
            }
        }
        let mut r = DMatrix::zeros(self.size(), columns.len());
        columns.iter().enumerate().for_each(|(j, own)| own.iter().for_each(|&(i, value)| r[(i, j)] = value));
        r
    }
}
