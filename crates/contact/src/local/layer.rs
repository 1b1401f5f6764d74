//! A layer bonded to a rigid base: a half tooth without ends. Theory (19d).

/// Layer constant c_L of an elastic layer bonded to a rigid base, in plane strain.
///
/// ```text
/// c_L = int_0^inf [k(w) - 1 + exp(-w)] / w dw
/// k(w) = [x (1 - e^2) - 4 w e] / [x (1 + e^2) + (4 w^2 + x^2 + 1) e],   e = exp(-2 w),  x = 3 - 4 nu
/// ```
/// Far from its edges a layer of depth t is indented by a Hertzian line load q by K q [ln(2 t / a) + 1/2 + c_L]. A real
/// half tooth has a tip, a root and a varying depth: `reduction::LayerProfile` gives the constant at every position of
/// its flank.
pub fn layer_constant(poisson: f64) -> f64 {
    let x = 3.0 - 4.0 * poisson;
    let integrand = |w: f64| {
        let e = (-2.0 * w).exp();
        let k = (x * (1.0 - e * e) - 4.0 * w * e) / (x * (1.0 + e * e) + (4.0 * w * w + x * x + 1.0) * e);
        (k - 1.0 + (-w).exp()) / w
    };
    // The integrand is smooth and falls as exp(-w): Simpson to round-off. At w = 0 it is the limit of its neighbours.
    let (n, end) = (4000, 40.0);
    let h = end / f64::from(n);
    let at = |i: u32| integrand(if i == 0 { 1e-6 } else { f64::from(i) * h });
    let inner: f64 = (1..n).map(|i| if i % 2 == 1 { 4.0 * at(i) } else { 2.0 * at(i) }).sum();
    h / 3.0 * (at(0) + inner + at(n))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bonded layer, nu 0.3: -0.5266, given with the finite-element reference of the default pair.
    #[test]
    fn layer_of_steel() {
        assert!((layer_constant(0.3) + 0.5266).abs() < 1e-4, "{}", layer_constant(0.3));
    }
}
