//! Eigenvalues of the matrices that propagate disturbances in motions and steps.

use nalgebra::{Complex, DMatrix, DVector, Schur, linalg::balancing::balance_parlett_reinsch};

/// Iterations after which the search has failed: some ten an eigenvalue are usual. Without a bound it may go on for ever.
const ITERATIONS: usize = 10_000;
/// What counts as zero beside its neighbours, at first and where the search does not end with that.
const ROUND_OFF: [f64; 2] = [f64::EPSILON, 1e3 * f64::EPSILON];

/// Eigenvalues of a real square matrix, unordered; `None` if the matrix has entries that are not finite, or if the
/// iteration does not converge.
pub fn eigenvalues(mut matrix: DMatrix<f64>) -> Option<DVector<Complex<f64>>> {
    if matrix.iter().any(|x| !x.is_finite()) {
        return None;
    }
    // Coordinates of different units make rows and columns of very different size.
    balance_parlett_reinsch(&mut matrix);
    let mut found = ROUND_OFF.into_iter().filter_map(|small| Schur::try_new(matrix.clone(), small, ITERATIONS));
    Some(found.next()?.complex_eigenvalues())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Those of a companion matrix are the roots of its polynomial, whatever the units of its rows; what is no number
    /// has none.
    #[test]
    fn roots_come_out_in_any_units() {
        let roots = [0.5, -0.25, 2.0];
        // (x - 0.5) (x + 0.25) (x - 2) = x^3 - 2.25 x^2 + 0.375 x + 0.25
        let companion = DMatrix::from_row_slice(3, 3, &[2.25, -0.375, -0.25, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        for unit in [1.0, 1e6, 1e12] {
            let units = [1.0, unit, 1.0 / unit];
            let scaled = DMatrix::from_fn(3, 3, |i, j| companion[(i, j)] * units[j] / units[i]);
            let found = eigenvalues(scaled).unwrap();
            for root in roots {
                let near = found.iter().map(|x| (x - root).norm()).fold(f64::INFINITY, f64::min);
                assert!(near < 1e-12, "unit {unit:e}: {root} is not among {found}");
            }
        }
        assert!(eigenvalues(DMatrix::from_element(2, 2, f64::NAN)).is_none());
    }
}
