//! Fewer modes for a range of frequencies. Theory (88).

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::{GearboxError, Rotors};

/// Share of the largest singular value from which directions of the rest are told apart.
const APART: f64 = 1e-10;

impl Rotors {
    /// Rotors in modes up to `highest` (rad/s without spin), plus the static shapes of `loads` (one column each, all
    /// coordinates) beyond these modes. The damping is the projection of the damping of all modes.
    ///
    /// ```text
    /// q = Phi_low eta + R y,   R = Phi_high W_high^-2 Phi_high' F,   made diagonal in mass and stiffness
    /// ```
    /// Static responses to these loads stay exact. At omega the error from a neglected mode of frequency W_r is about
    /// (omega/W_r)^4.
    ///
    /// # Errors
    /// [`GearboxError::Count`] for loads of another size.
    pub fn reduced(&self, highest: f64, loads: &DMatrix<f64>) -> Result<Self, GearboxError> {
        let (size, wanted) = (loads.nrows(), self.assembly.size());
        if size != wanted {
            return Err(GearboxError::Count { what: "coordinates of a load", found: size, wanted });
        }
        let all = self.rest.frequencies.len();
        let low = self.rest.frequencies.iter().take_while(|w| **w <= highest).count();
        if low + loads.ncols() >= all {
            return Ok(self.clone());
        }
        let high = self.rest.shapes.columns(low, all - low);
        let squares: Vec<f64> = self.rest.frequencies[low..].iter().map(|w| w * w).collect();
        let mut bent = high.transpose() * loads;
        for mut column in bent.column_iter_mut() {
            column.iter_mut().zip(&squares).for_each(|(x, s)| *x /= s);
            let norm = column.norm();
            if norm > 0.0 {
                column /= norm;
            }
        }
        // An orthonormal base of what they bend, none twice.
        let svd = bent.svd(true, false);
        let Some(u) = svd.u else { return Ok(self.clone()) };
        let most = svd.singular_values.max();
        let kept: Vec<usize> = (0..u.ncols()).filter(|&i| svd.singular_values[i] > APART * most).collect();
        let directions = u.select_columns(&kept);
        let stiff = DMatrix::from_fn(directions.nrows(), directions.ncols(), |i, j| squares[i] * directions[(i, j)]);
        let own = directions.transpose() * stiff;
        let eigen = SymmetricEigen::new(0.5 * (&own + own.transpose()));
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        let ways = directions * eigen.eigenvectors.select_columns(&order);
        let turned = high * &ways;
        let rated = DMatrix::from_fn(ways.nrows(), ways.ncols(), |i, j| 2.0 * squares[i].sqrt() * ways[(i, j)]);
        let mut reduced = self.clone();
        reduced.rest.frequencies.truncate(low);
        reduced.rest.frequencies.extend(order.iter().map(|&i| eigen.eigenvalues[i].max(0.0).sqrt()));
        let (rows, columns) = (wanted, low + order.len());
        let shapes = &self.rest.shapes;
        reduced.rest.shapes =
            DMatrix::from_fn(rows, columns, |i, j| if j < low { shapes[(i, j)] } else { turned[(i, j - low)] });
        reduced.unit_damping = DMatrix::from_diagonal(&DVector::from_fn(columns, |i, _| {
            if i < low { 2.0 * reduced.rest.frequencies[i] } else { 0.0 }
        }));
        reduced
            .unit_damping
            .view_mut((low, low), (columns - low, columns - low))
            .copy_from(&(ways.transpose() * rated));
        reduced.damping = reduced.rest.shapes.transpose() * self.assembly.damping() * &reduced.rest.shapes;
        Ok(reduced)
    }
}
