//! Roots of functions of one variable.

use std::f64::consts::FRAC_PI_2;

/// Newton's steps at the most; from the start below, five or six are taken.
const MOST_STEPS: u32 = 40;

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

/// The angle (rad) whose involute is given, to round-off; `None` for a value not in 0 .. 10, both ends excluded.
///
/// ```text
/// inv a = v:   a' = a - (tan a - a - v) / tan^2 a,   from a = min[(3v)^(1/3), atan(v + pi/2)]
/// ```
/// The start is above the root, since tan a - a > a^3/3 and a < pi/2. The involute is convex, so Newton's steps go down
/// to the root; they end where round-off turns them.
pub(crate) fn inverse_involute(value: f64) -> Option<f64> {
    if !(value > 0.0 && value < 10.0) {
        return None;
    }
    let mut angle = (3.0 * value).cbrt().min((value + FRAC_PI_2).atan());
    for _ in 0..MOST_STEPS {
        let tan = angle.tan();
        let next = angle - (tan - angle - value) / (tan * tan);
        if next >= angle || next <= 0.0 {
            break;
        }
        angle = next;
    }
    Some(angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::involute;

    /// tan a - a is known to a few bits of a, so the angle to these over the slope tan^2 a.
    #[test]
    fn inverse_involute_undoes_the_involute() {
        for k in 1..=1480 {
            let angle = 1e-3 * f64::from(k);
            let found = inverse_involute(involute(angle)).unwrap();
            let tan = angle.tan();
            let bound = 4.0 * f64::EPSILON * (angle + tan / (tan * tan));
            assert!((found - angle).abs() <= bound, "{found}, not {angle}");
        }
    }

    /// No angle has them within a right angle, or none that a flank has.
    #[test]
    fn values_without_an_angle_have_none() {
        for value in [0.0, -1e-3, 10.0, f64::NAN, f64::INFINITY] {
            assert_eq!(inverse_involute(value), None, "{value}");
        }
        let least = inverse_involute(1e-300).unwrap();
        assert!(least > 0.0 && least < 1e-7, "{least}");
    }
}
