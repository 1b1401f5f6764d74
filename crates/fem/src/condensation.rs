//! Static condensation: eliminates coordinates that follow the kept ones statically.

use nalgebra::{Cholesky, DMatrix};

use crate::FemError;

/// Map from the kept coordinates to all coordinates; it reduces stiffness, mass, damping and similar matrices.
///
/// ```text
/// q = T q_k,   T = [I; -K_cc^-1 K_ck],   A^ = T' A T
/// ```
/// Exact for static loads on the kept coordinates. The inertia of the eliminated coordinates moves with their static
/// shapes (Guyan).
#[derive(Debug, Clone, PartialEq)]
pub struct Condensation {
    /// T; its rows are in the order of all coordinates.
    pub map: DMatrix<f64>,
}

impl Condensation {
    /// Makes the map from the symmetric stiffness of all coordinates and the indices of the kept ones.
    ///
    /// # Errors
    /// [`FemError::Shape`], [`FemError::BadDof`], [`FemError::NotFinite`]; [`FemError::NotPositiveDefinite`] if the
    /// eliminated coordinates can move freely.
    pub fn new(stiffness: &DMatrix<f64>, kept: &[usize]) -> Result<Self, FemError> {
        check(stiffness, kept)?;
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
            let free = |i: usize, pivot_ratio| FemError::NotPositiveDefinite { dof: left[i], pivot_ratio };
            let factor = Cholesky::new(k).ok_or_else(|| free(0, 0.0))?;
            let pivot = |i: &usize| factor.l_dirty()[(*i, *i)].powi(2);
            let least = (0..left.len()).min_by(|a, b| pivot(a).total_cmp(&pivot(b)));
            if let Some(i) = least.filter(|i| pivot(i) < 1e-12) {
                return Err(free(i, pivot(&i)));
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

    /// The reduced matrix T' A T.
    pub fn of(&self, a: &DMatrix<f64>) -> DMatrix<f64> {
        self.map.transpose() * a * &self.map
    }
}

fn check(stiffness: &DMatrix<f64>, kept: &[usize]) -> Result<(), FemError> {
    let n = stiffness.nrows();
    if stiffness.ncols() != n {
        return Err(FemError::Shape { what: "columns of stiffness", expected: n, found: stiffness.ncols() });
    }
    if let Some((_, &dof)) = kept.iter().enumerate().find(|(i, dof)| **dof >= n || kept[..*i].contains(dof)) {
        return Err(FemError::BadDof { dof, count: n });
    }
    match stiffness.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(FemError::NotFinite { row: i % n, column: i / n }),
        None => Ok(()),
    }
}
