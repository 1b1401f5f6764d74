//! Bisection for zeros and for limits of conditions.

/// Evaluations of a bracketed zero before it is taken as it is; bisection alone needs 50.
const BRACKET_STEPS: usize = 120;

/// The position nearest to `outside` at which `holds` is still true, found by at most `steps` bisections, or until the
/// bracket is at most `width` wide. `holds` is true at `inside` and false at `outside`.
pub fn last_inside(holds: impl Fn(f64) -> bool, [mut inside, mut outside]: [f64; 2], steps: usize, width: f64) -> f64 {
    for _ in 0..steps {
        if (outside - inside).abs() <= width {
            break;
        }
        let middle = 0.5 * (inside + outside);
        if holds(middle) { inside = middle } else { outside = middle }
    }
    inside
}

/// Shrinks a bracket of a zero of `f`, or of a jump through zero, to round-off.
///
/// Chandrupatla's method (Adv. Eng. Software 28(3), 1997): inverse quadratic interpolation where three points say that
/// it is safe, bisection otherwise.
pub(crate) fn bracket_zero(f: impl FnMut(f64) -> f64, ends: [f64; 2], values: [f64; 2]) -> [f64; 2] {
    bracket_zero_within(f, ends, values, 0.0)
}

/// Shrinks a bracket of a zero of `f` to a width of `within`, or to round-off ([`bracket_zero`]).
pub(crate) fn bracket_zero_within(
    mut f: impl FnMut(f64) -> f64,
    [a, b]: [f64; 2],
    [fa, fb]: [f64; 2],
    within: f64,
) -> [f64; 2] {
    if fa == 0.0 {
        return [a, a];
    }
    // x1: newest, x2: the other end of the bracket, x3: the one before.
    let (mut x1, mut x2, mut f1, mut f2) = (b, a, fb, fa);
    let mut t: f64 = 0.5;
    for _ in 0..BRACKET_STEPS {
        if f1 == 0.0 {
            return [x1, x1];
        }
        let width = x2 - x1;
        let resolution = (2.0 * f64::EPSILON * x1.abs().max(x2.abs())).max(0.5 * within);
        if width.abs() <= 2.0 * resolution {
            break;
        }
        let least = resolution / width.abs();
        let x = x1 + t.clamp(least, 1.0 - least) * width;
        let fx = f(x);
        let (x3, f3) = if (fx > 0.0) == (f1 > 0.0) { (x1, f1) } else { (x2, f2) };
        if (fx > 0.0) != (f1 > 0.0) {
            (x2, f2) = (x1, f1);
        }
        (x1, f1) = (x, fx);
        let (xi, phi) = ((x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2));
        t = if phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
            f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        } else {
            0.5
        };
        if t.is_nan() {
            t = 0.5;
        }
    }
    [x1, x2]
}

#[cfg(test)]
mod tests {
    use super::bracket_zero;

    /// Smooth, flat, steep and broken functions: the bracket holds the place and is round-off wide.
    #[test]
    fn brackets_close_on_zeros_and_jumps() {
        type Case = (&'static str, fn(f64) -> f64, f64);
        let functions: [Case; 5] = [
            ("line", |x| x - 0.3, 0.3),
            ("cubic", |x| (x - 0.3).powi(3), 0.3),
            ("exponential", |x| (20.0 * x).exp() - 7.0, 7f64.ln() / 20.0),
            ("jump", |x| if x < 0.7 { -1.0 } else { 1e-3 }, 0.7),
            ("kink", |x| if x < 0.7 { x - 0.7 } else { 50.0 * (x - 0.7) }, 0.7),
        ];
        for (name, f, point) in functions {
            let mut count = 0;
            let counted = |x: f64| {
                count += 1;
                f(x)
            };
            let [a, b] = bracket_zero(counted, [0.0, 1.0], [f(0.0), f(1.0)]);
            let flat = if name == "cubic" { 1e-5 } else { 1e-15 };
            assert!((a - point).abs() <= flat && (b - point).abs() <= flat, "{name}: {a} .. {b}, not {point}");
            assert!(count <= 110, "{name}: {count} evaluations");
        }
    }
}
