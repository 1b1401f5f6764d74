//! The top: the separators between the pieces, and the boundary.

use faer::{
    Mat,
    sparse::{SparseColMat, SymbolicSparseColMat},
};

use super::{
    super::BoundaryLastFactor,
    pieces::{Pieces, Place, named},
};
use crate::{FemError, SymmetricMatrix};

impl Pieces {
    /// Factor of S with the last `boundary` rows of the top last; `shares`: what each piece adds to it.
    pub(super) fn top_factor(
        &self,
        stiffness: &SymmetricMatrix,
        shares: &[Mat<f64>],
        boundary: usize,
    ) -> Result<BoundaryLastFactor, FemError> {
        let n = self.top().len();
        let (mut own, mut diagonal) = (vec![Vec::new(); n], vec![0.0; n]);
        let (starts, rows, values) = stiffness.arrays();
        for (&dof, i) in self.top().iter().zip(0..) {
            for k in starts[dof]..starts[dof + 1] {
                if let Place::Top { row: j } = self.places()[rows[k]] {
                    own[i.min(j)].push((i.max(j), values[k]));
                    if i == j {
                        diagonal[i] = values[k];
                    }
                }
            }
        }
        // Pieces about each row, and its place in their borders.
        let mut about = vec![Vec::new(); n];
        for piece in 0..self.count() {
            for (at, &row) in self.border(piece).iter().enumerate() {
                about[row].push((piece, at));
            }
        }
        let (mut sum, mut meets) = (vec![0.0; n], vec![false; n]);
        let (mut column_starts, mut column_rows, mut column_values) = (vec![0], Vec::new(), Vec::new());
        for column in 0..n {
            let first = column_rows.len();
            let mut add = |row: usize, value: f64| {
                if !std::mem::replace(&mut meets[row], true) {
                    column_rows.push(row);
                }
                sum[row] += value;
            };
            own[column].iter().for_each(|&(row, value)| add(row, value));
            for &(piece, at) in &about[column] {
                let border = self.border(piece);
                (at..border.len()).for_each(|i| add(border[i], shares[piece][(i, at)]));
            }
            for &row in &column_rows[first..] {
                column_values.push(std::mem::take(&mut sum[row]));
                meets[row] = false;
            }
            column_starts.push(column_rows.len());
        }
        let symbolic = SymbolicSparseColMat::new_unsorted_checked(n, n, column_starts, None, column_rows);
        let lower = SparseColMat::new(symbolic, column_values);
        BoundaryLastFactor::in_order(lower, n - boundary, &diagonal).map_err(|e| named(e, |row| self.top()[row]))
    }
}
