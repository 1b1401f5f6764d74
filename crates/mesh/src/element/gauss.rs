//! Gauss-Legendre rules on [-1, 1].

/// Abscissas and weights of the n-point Gauss-Legendre rule on [-1, 1], ascending.
///
/// Works for any number of points, because faces in contact may need many. Newton's method on P_n from Chebyshev's
/// estimate; weights 2 / ((1 - x^2) P_n'^2).
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let polynomial = |x: f64| {
        let (mut before, mut now) = (1.0, x);
        for k in 2..=n {
            let k = k as f64;
            (before, now) = (now, ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k);
        }
        (now, n as f64 * (x * now - before) / (x * x - 1.0))
    };
    (0..n)
        .rev()
        .map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            for _ in 0..100 {
                let (p, slope) = polynomial(x);
                let step = p / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            let slope = polynomial(x).1;
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// The rule of 2, 3 or 4 points in closed form: volume elements.
///
/// [`gauss_legendre`] gives the same to some units in the last place; stiffness and mass keep the closed form to the
/// bit.
pub(super) fn line(count: usize) -> Vec<(f64, f64)> {
    match count {
        2 => {
            let x = 1.0 / 3f64.sqrt();
            vec![(-x, 1.0), (x, 1.0)]
        }
        3 => {
            let x = 0.6f64.sqrt();
            vec![(-x, 5.0 / 9.0), (0.0, 8.0 / 9.0), (x, 5.0 / 9.0)]
        }
        _ => {
            let spread = 2.0 / 7.0 * 1.2f64.sqrt();
            let (inner, outer) = ((3.0 / 7.0 - spread).sqrt(), (3.0 / 7.0 + spread).sqrt());
            let (heavy, light) = ((18.0 + 30f64.sqrt()) / 36.0, (18.0 - 30f64.sqrt()) / 36.0);
            vec![(-outer, light), (-inner, heavy), (inner, heavy), (outer, light)]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{gauss_legendre, line};

    /// n points integrate polynomials of degree 2n - 1 exactly.
    #[test]
    fn gauss_rule_has_its_degree() {
        for n in 1..=12 {
            let rule = gauss_legendre(n);
            for degree in 0..2 * n {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = if degree % 2 == 1 { 0.0 } else { 2.0 / (degree as f64 + 1.0) };
                assert!((sum - exact).abs() < 1e-13, "n {n}, degree {degree}: {sum} not {exact}");
            }
        }
    }

    /// The closed forms are the same rules.
    #[test]
    fn closed_forms_are_the_same_rules() {
        for n in 2..=4 {
            for ((x, w), (y, v)) in gauss_legendre(n).into_iter().zip(line(n)) {
                assert!((x - y).abs() < 1e-15 && (w - v).abs() < 1e-15, "{n} points: ({x}, {w}) and ({y}, {v})");
            }
        }
    }
}
