//! Sums over so few coordinates that calling a product or iterator of nalgebra takes longer than the computation.

use nalgebra::{DMatrix, DVector};

/// a . x.
#[inline]
pub(super) fn along(a: &DVector<f64>, x: &DVector<f64>) -> f64 {
    let mut sum = 0.0;
    for (a, x) in a.as_slice().iter().zip(x.as_slice()) {
        sum += a * x;
    }
    sum
}

/// out += scale a.
#[inline]
pub(super) fn add(scale: f64, a: &DVector<f64>, out: &mut DVector<f64>) {
    for (sum, a) in out.as_mut_slice().iter_mut().zip(a.as_slice()) {
        *sum += scale * a;
    }
}

/// out += scale a b'; nothing to do for a scale of 0.
#[inline]
pub(super) fn add_product(scale: f64, a: &DVector<f64>, b: &DVector<f64>, out: &mut DMatrix<f64>) {
    if scale == 0.0 {
        return;
    }
    // Columns stand one behind the other.
    for (column, b) in out.as_mut_slice().chunks_exact_mut(a.len().max(1)).zip(b.as_slice()) {
        for (sum, a) in column.iter_mut().zip(a.as_slice()) {
            *sum += scale * b * a;
        }
    }
}

/// Whether a matrix does nothing.
#[inline]
pub(super) fn is_zero(matrix: &DMatrix<f64>) -> bool {
    matrix.as_slice().iter().all(|x| *x == 0.0)
}
