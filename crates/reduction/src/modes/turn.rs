//! Effect of a rotation of a cyclic gear by several teeth on the amplitudes of its modes.

use nalgebra::DMatrix;

use super::{GearModes, gear_modes::Shapes};

/// What the modes may leave of their turned selves: where a pair of one frequency was parted, all of a mode is left.
const LEFT: f64 = 1e-5;

impl GearModes {
    /// R of `Phi_k = Phi_(k-n) R`, m x m: expresses the shapes on tooth k by those on the tooth n = `teeth` before it,
    /// each in the frame of its own tooth.
    ///
    /// ```text
    /// Phi_k q = Phi_(k-n) (R q)
    /// ```
    /// If a gear has rotated counter-clockwise by n pitches (clockwise for n < 0) and has the same deformation seen
    /// from space, its amplitudes change from q to R q. R is orthogonal; it rotates the two modes of w waves into each
    /// other by 2 pi w n / z.
    ///
    /// `None` for a gear that is not condensed by sectors, whose teeth may differ, and if some modes of a repeated
    /// frequency are missing.
    pub fn turned_by_teeth(&self, teeth: i64) -> Option<DMatrix<f64>> {
        let (Shapes::Sector { phases, parts, .. }, Some(waves)) = (self.shapes(), self.waves()) else { return None };
        let rows = parts[0].nrows();
        let part = |p: usize, row: usize, j: usize| parts[p][(row, j)];
        // (x + i y) e^(i n psi)
        let turned = |p: usize, row: usize, j: usize| {
            let (sin, cos) = (teeth as f64 * phases[j]).sin_cos();
            let (x, y) = (part(0, row, j), part(1, row, j));
            if p == 0 { cos * x - sin * y } else { sin * x + cos * y }
        };
        let mut all = DMatrix::zeros(self.count(), self.count());
        let mut done = vec![false; self.count()];
        for first in 0..self.count() {
            if done[first] {
                continue;
            }
            let alike: Vec<usize> = (first..self.count()).filter(|&j| waves[j] == waves[first]).collect();
            alike.iter().for_each(|&j| done[j] = true);
            let stacked = |value: &dyn Fn(usize, usize, usize) -> f64| {
                DMatrix::from_fn(2 * rows, alike.len(), |i, j| value(i / rows, i % rows, alike[j]))
            };
            let (here, next) = (stacked(&part), stacked(&turned));
            let by = here.tr_mul(&here).cholesky()?.solve(&here.tr_mul(&next));
            if (&here * &by - &next).norm() > LEFT * next.norm() {
                return None;
            }
            for (i, &row) in alike.iter().enumerate() {
                alike.iter().enumerate().for_each(|(j, &column)| all[(row, column)] = by[(i, j)]);
            }
        }
        Some(all)
    }
}
