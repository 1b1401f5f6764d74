//! Coordinates that follow statically are left out.

use nalgebra::{Cholesky, DMatrix};

use crate::LumpedError;

/// Stiffness, mass, damping and the like in the kept coordinates.
///
/// ```text
/// q = T q_k,   T = [I; -K_cc^-1 K_ck],   A^ = T' A T
/// ```
/// Exact for static loads on the kept coordinates; the others' inertia goes along with their static shapes (Guyan).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Condensation {
    /// T, in the order of all coordinates.
    pub map: DMatrix<f64>,
}

impl Condensation {
    /// From the stiffness of all coordinates and the numbers of those kept; `shaft` for the complaint.
    pub fn new(stiffness: &DMatrix<f64>, kept: &[usize], shaft: usize) -> Result<Self, LumpedError> {
        let n = stiffness.nrows();
        let left: Vec<usize> = (0..n).filter(|i| !kept.contains(i)).collect();
        let mut map = DMatrix::zeros(n, kept.len());
        for (j, &i) in kept.iter().enumerate() {
            map[(i, j)] = 1.0;
        }
        if !left.is_empty() {
            // Turns and displacements have stiffnesses of very different size: scaled, round-off cannot look like a
            // free motion.
            let scale: Vec<f64> =
                left.iter().map(|&i| stiffness[(i, i)].max(f64::MIN_POSITIVE).sqrt().recip()).collect();
            let of = |rows: &[usize], columns: &[usize]| {
                DMatrix::from_fn(rows.len(), columns.len(), |i, j| stiffness[(rows[i], columns[j])])
            };
            let mut k = of(&left, &left);
            let mut right = of(&left, kept);
            for i in 0..left.len() {
                for j in 0..left.len() {
                    k[(i, j)] *= scale[i] * scale[j];
                }
                right.row_mut(i).scale_mut(scale[i]);
            }
            let free = || LumpedError::Free { shaft };
            let factor = Cholesky::new(k).ok_or_else(free)?;
            let least = (0..left.len()).map(|i| factor.l_dirty()[(i, i)]).fold(f64::INFINITY, f64::min);
            if least < 1e-6 {
                return Err(free());
            }
            let follow = factor.solve(&right);
            for (i, &row) in left.iter().enumerate() {
                for j in 0..kept.len() {
                    map[(row, j)] = -scale[i] * follow[(i, j)];
                }
            }
        }
        Ok(Self { map })
    }

    /// T' A T.
    pub fn of(&self, a: &DMatrix<f64>) -> DMatrix<f64> {
        self.map.transpose() * a * &self.map
    }
}
