//! Hertzian line contact in closed form. Theory (22).

use std::f64::consts::PI;

/// Effective modulus E* of two bodies, MPa: 1/E* = sum (1 - nu^2)/E.
pub fn effective_modulus(bodies: [(f64, f64); 2]) -> f64 {
    1.0 / bodies.iter().map(|(young, nu)| (1.0 - nu * nu) / young).sum::<f64>()
}

/// Largest pressure p0 (MPa) of a line load q (N/mm) between cylinders of relative radius rho (mm).
///
/// ```text
/// p0 = sqrt(q E* / (pi rho)),   1/rho = 1/rho_1 + 1/rho_2
/// ```
pub fn line_pressure(load: f64, radius: f64, effective_modulus: f64) -> f64 {
    (load * effective_modulus / (PI * radius)).sqrt()
}

/// Half-width a (mm) of the same contact: a = 2 q / (pi p0).
pub fn half_width(load: f64, radius: f64, effective_modulus: f64) -> f64 {
    if load > 0.0 { 2.0 * load / (PI * line_pressure(load, radius, effective_modulus)) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::{effective_modulus, half_width, line_pressure};

    /// NAFEMS CB1, cylinder R 50 mm on a block, 35 kN/mm, E 210 and 70 GPa: p0 3585.4 MPa, half-width 6.215 mm.
    #[test]
    fn cylinder_on_block() {
        let e = effective_modulus([(210e3, 0.3), (70e3, 0.3)]);
        assert!((line_pressure(35e3, 50.0, e) - 3585.4).abs() < 0.1, "{}", line_pressure(35e3, 50.0, e));
        assert!((half_width(35e3, 50.0, e) - 6.215).abs() < 1e-3, "{}", half_width(35e3, 50.0, e));
    }
}
