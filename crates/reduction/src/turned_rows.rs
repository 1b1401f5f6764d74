//! Rows of vectors in another frame.

use faer::Mat;

/// Turns triples of rows by an angle about z, rad.
pub(crate) fn turn_rows(matrix: &mut Mat<f64>, angle: f64) {
    let (sin, cos) = angle.sin_cos();
    for mut column in matrix.col_iter_mut() {
        for i in (0..column.nrows()).step_by(3) {
            let (x, y) = (column[i], column[i + 1]);
            column[i] = cos * x - sin * y;
            column[i + 1] = sin * x + cos * y;
        }
    }
}
