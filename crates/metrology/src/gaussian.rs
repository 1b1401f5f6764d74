//! The Gaussian low pass of ISO 16610-21.

use std::f64::consts::{LN_2, PI};

/// Beyond so many cut-off wavelengths the weight is cut off: less than 1e-9 of its middle.
const TAIL: f64 = 1.25;

/// Values of points (x, y), ascending in x, that a Gaussian low pass leaves, with half of a wave of the length `cutoff`.
///
/// ```text
/// w(x) = exp(-pi (x / (alpha lambda_c))^2),   alpha = sqrt(ln 2 / pi)
/// ```
/// The value at a point is that of the straight line fitted to its neighbours with these weights: far from the ends of
/// evenly spaced points the plain weighted mean, and straight lines stay as they are up to the ends (ISO 16610-28, moments
/// up to the first).
pub fn low_pass(points: &[[f64; 2]], cutoff: f64) -> Vec<f64> {
    if cutoff <= 0.0 || !cutoff.is_finite() {
        return points.iter().map(|[_, y]| *y).collect();
    }
    let width = (LN_2 / PI).sqrt() * cutoff;
    let reach = TAIL * cutoff;
    let mut first = 0;
    let value = |&[x, own]: &[f64; 2]| {
        while points[first][0] < x - reach {
            first += 1;
        }
        let mut m = [0.0; 3];
        let mut f = [0.0; 2];
        for &[at, y] in points[first..].iter().take_while(|[at, _]| *at <= x + reach) {
            let d = (at - x) / width;
            let w = (-PI * d * d).exp();
            (m[0], m[1], m[2]) = (m[0] + w, m[1] + w * d, m[2] + w * d * d);
            // About the own value, so that a straight line keeps its digits.
            (f[0], f[1]) = (f[0] + w * (y - own), f[1] + w * d * (y - own));
        }
        let whole = m[0] * m[2] - m[1] * m[1];
        if whole > 1e-12 * m[0] * m[0] { own + (m[2] * f[0] - m[1] * f[1]) / whole } else { own }
    };
    points.iter().map(value).collect()
}
