//! Roots of functions of one number.

use crate::involute;

/// Root of `f` between `a` (f > 0) and `b` (f <= 0), to round-off.
pub(crate) fn bisect(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (a + b);
        if middle == a || middle == b {
            break;
        }
        if f(middle) > 0.0 { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}

/// The angle whose involute is given; `None` for what is none.
pub(crate) fn inverse_involute(value: f64) -> Option<f64> {
    if !(value > 0.0 && value < 10.0) {
        return None;
    }
    // inv a = tan a - a: monotone, and steep only near a right angle.
    let (mut low, mut high) = (0.0, 1.56);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if involute(middle) < value { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}
