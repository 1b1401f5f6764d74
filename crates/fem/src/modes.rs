//! Natural frequencies of small dense systems.

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

use crate::FemError;

/// Undamped natural frequencies and shapes of a small system.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Angular frequencies, rad/s, ascending; 0 for rigid-body modes.
    pub frequencies: Vec<f64>,
    /// Mode shapes, one column per frequency, normalised so that shape' M shape = 1.
    pub shapes: DMatrix<f64>,
}

/// Solves the symmetric eigenproblem of stiffness and mass.
///
/// ```text
/// K x = omega^2 M x,   M = L L',   (L^-1 K L^-T) y = omega^2 y,   x = L^-T y
/// ```
///
/// | name | shape | unit | meaning |
/// |------|-------|------|---------|
/// | `k`  | n x n | N/mm (N, N mm for turns) | symmetric, positive semi-definite |
/// | `m`  | n x n | t (t mm, t mm^2) | symmetric, positive definite |
///
/// An eigenvalue that is negative by round-off counts as 0. The solver is dense and suits up to some hundred unknowns.
///
/// # Errors
/// [`FemError::Shape`] if the sizes differ, [`FemError::NotFinite`], [`FemError::NotPositiveDefinite`] if a coordinate
/// has no mass.
pub fn natural_modes(k: &DMatrix<f64>, m: &DMatrix<f64>) -> Result<Modes, FemError> {
    let n = m.nrows();
    for (what, found) in [("columns of mass", m.ncols()), ("rows of stiffness", k.nrows()), ("its columns", k.ncols())]
    {
        if found != n {
            return Err(FemError::Shape { what, expected: n, found });
        }
    }
    for matrix in [k, m] {
        if let Some(i) = matrix.iter().position(|x| !x.is_finite()) {
            return Err(FemError::NotFinite { row: i % n, column: i / n });
        }
    }
    let no_mass = || {
        let dof = (0..n).min_by(|&i, &j| m[(i, i)].total_cmp(&m[(j, j)])).unwrap_or(0);
        FemError::NotPositiveDefinite { dof, pivot_ratio: m.get((dof, dof)).copied().unwrap_or(0.0) }
    };
    let lower = Cholesky::new(m.clone()).ok_or_else(no_mass)?.unpack();
    let half = lower.solve_lower_triangular(k).ok_or_else(no_mass)?;
    let mut a = lower.solve_lower_triangular(&half.transpose()).ok_or_else(no_mass)?;
    a = 0.5 * (&a + a.transpose());
    let eigen = SymmetricEigen::new(a);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let frequencies = order.iter().map(|&i| eigen.eigenvalues[i].max(0.0).sqrt()).collect();
    let sorted = DMatrix::from_fn(n, n, |i, j| eigen.eigenvectors[(i, order[j])]);
    let shapes = lower.transpose().solve_upper_triangular(&sorted).ok_or_else(no_mass)?;
    Ok(Modes { frequencies, shapes })
}

impl Modes {
    /// Mode shape number `mode`.
    pub fn shape(&self, mode: usize) -> DVector<f64> {
        self.shapes.column(mode).into_owned()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::dmatrix;

    use super::*;

    /// Two masses of 1 and 2 on a spring of 6: at rest, and omega^2 = k (1/m1 + 1/m2) = 9 against each other.
    #[test]
    fn two_masses_on_a_spring() {
        let (k, m) = (dmatrix![6.0, -6.0; -6.0, 6.0], dmatrix![1.0, 0.0; 0.0, 2.0]);
        let modes = natural_modes(&k, &m).unwrap();
        assert!(modes.frequencies[0] < 1e-7 && (modes.frequencies[1] - 3.0).abs() < 1e-12, "{:?}", modes.frequencies);
        let unit = modes.shapes.transpose() * &m * &modes.shapes;
        assert!((unit - DMatrix::identity(2, 2)).amax() < 1e-12);
    }

    #[test]
    fn systems_without_mass_or_sense_are_refused() {
        let k = dmatrix![1.0, 0.0; 0.0, 1.0];
        assert!(matches!(natural_modes(&k, &dmatrix![1.0]), Err(FemError::Shape { .. })));
        let m = dmatrix![1.0, 0.0; 0.0, 0.0];
        assert!(matches!(natural_modes(&k, &m), Err(FemError::NotPositiveDefinite { dof: 1, .. })));
        let nan = dmatrix![1.0, 0.0; 0.0, f64::NAN];
        assert!(matches!(natural_modes(&nan, &k), Err(FemError::NotFinite { row: 1, column: 1 })));
    }
}
