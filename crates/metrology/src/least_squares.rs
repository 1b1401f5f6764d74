//! Polynomials and other shapes through points by least squares.

use nalgebra::{DMatrix, DVector};

/// Coefficients of the shapes whose sum is nearest to the values; `None` where they cannot be told from each other.
/// `columns`: the value of each shape at each point.
pub(crate) fn fit(columns: &[Vec<f64>], values: &[f64]) -> Option<Vec<f64>> {
    let n = columns.len();
    if n == 0 || values.len() < n || columns.iter().any(|c| c.len() != values.len()) {
        return None;
    }
    let a = DMatrix::from_fn(values.len(), n, |i, j| columns[j][i]);
    let qr = a.qr();
    let r = qr.r();
    let largest = (0..n).map(|i| r[(i, i)].abs()).fold(0.0, f64::max);
    if (0..n).any(|i| r[(i, i)].abs() <= 1e-12 * largest || !r[(i, i)].is_finite()) {
        return None;
    }
    let mut b = DVector::from_column_slice(values);
    qr.q_tr_mul(&mut b);
    let x = r.solve_upper_triangular(&b.rows(0, n).into_owned())?;
    Some(x.iter().copied().collect())
}

/// Value in the middle, slope and half of the second derivative of the polynomial of degree 1 or 2 through points (x, y),
/// over t = (x - middle)/half of their range; `None` for too few of them.
pub(crate) fn polynomial(points: &[[f64; 2]], [from, to]: [f64; 2], degree: usize) -> Option<Vec<f64>> {
    let t = |x: f64| (2.0 * x - from - to) / (to - from);
    let columns: Vec<Vec<f64>> =
        (0..=degree).map(|k| points.iter().map(|[x, _]| t(*x).powi(k as i32)).collect()).collect();
    let values: Vec<f64> = points.iter().map(|[_, y]| *y).collect();
    fit(&columns, &values)
}
