//! Hertz contact of a ball and a groove. Theory (97).

use std::f64::consts::{FRAC_PI_2, PI};

use super::STEEL;

/// Point contact of two steel bodies: their approach and pressure under a force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointContact {
    /// Constant c of Q = c delta^(3/2), N/mm^1.5.
    pub stiffness: f64,
    /// Pressure in the middle of the ellipse at 1 N, MPa; it grows with the cube root of the force.
    pub unit_pressure: f64,
    /// Ratio of the long to the short semi-axis of the ellipse.
    pub ellipse: f64,
}

/// Halvings that leave a ratio of axes without error.
const HALVINGS: usize = 120;

impl PointContact {
    /// Contact of two bodies with principal curvatures (1/mm, negative if concave) in one plane and in the
    /// perpendicular plane.
    ///
    /// ```text
    /// F = |rho_a - rho_b|/(rho_a + rho_b) = [(k^2 + 1) E - 2 K]/[(k^2 - 1) E],   m = 1 - 1/k^2
    /// delta = K [(9/2) S/E]^(1/3) [Q/(pi k E')]^(2/3),   a = [6 k^2 E Q/(pi E' S)]^(1/3),   p = 3 Q k/(2 pi a^2)
    /// ```
    /// rho_a and rho_b are the sums over both bodies in the two planes; S = rho_a + rho_b; E' = E_steel/(1 - nu^2);
    /// K(m), E(m): complete elliptic integrals. Source: Hertz 1881, as in Harris and Kotzalas, Rolling Bearing
    /// Analysis, chapter 6. `None` if the bodies do not touch at a point.
    pub fn new([along, across]: [[f64; 2]; 2]) -> Option<Self> {
        let (a, b): (f64, f64) = (along.iter().sum(), across.iter().sum());
        if !(a > 0.0 && b > 0.0 && a.is_finite() && b.is_finite()) {
            return None;
        }
        let sum = a + b;
        let ratio = axes((a - b).abs() / sum);
        let (k, e) = complete(1.0 - ratio.powi(-2));
        let [young, nu] = STEEL;
        let modulus = young / (1.0 - nu * nu);
        let approach = k * (4.5 * sum / e).cbrt() * (PI * ratio * modulus).powf(-2.0 / 3.0);
        let semi_axis = (6.0 * ratio * ratio * e / (PI * modulus * sum)).cbrt();
        let unit_pressure = 1.5 * ratio / (PI * semi_axis * semi_axis);
        Some(Self { stiffness: approach.powf(-1.5), unit_pressure, ellipse: ratio })
    }

    /// Pressure in the middle of the ellipse under a force, MPa.
    pub fn pressure(&self, force: f64) -> f64 {
        self.unit_pressure * force.cbrt()
    }

    /// Force (N) under which the pressure in the middle of the ellipse is `pressure` (MPa).
    pub fn force(&self, pressure: f64) -> f64 {
        (pressure / self.unit_pressure).powi(3)
    }
}

/// Long over short semi-axis of the ellipse whose curvatures differ by a share `f` of their sum.
fn axes(f: f64) -> f64 {
    let share = |k: f64| {
        let (k1, e1) = complete(1.0 - k.powi(-2));
        ((k * k + 1.0) * e1 - 2.0 * k1) / ((k * k - 1.0) * e1)
    };
    // Below this the difference of two ones is round-off, and so is the ellipse.
    let (mut low, mut high): (f64, f64) = (1.0 + 1e-4, 1e8);
    if f <= share(low) {
        return 1.0;
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if share(middle) < f { low = middle } else { high = middle }
    }
    low
}

/// Complete elliptic integrals K(m) and E(m), 0 <= m < 1, by the arithmetic-geometric mean.
fn complete(m: f64) -> (f64, f64) {
    let (mut a, mut b, mut c) = (1.0, (1.0 - m).sqrt(), m.sqrt());
    let (mut power, mut sum) = (0.5, 0.5 * c * c);
    while c > 1e-17 && power < 1e6 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
        sum += power * c * c;
    }
    let k = FRAC_PI_2 / a;
    (k, k * (1.0 - sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two balls press on a circle: delta^3 = (9/8) S (Q/E')^2 in closed form (Johnson, Contact Mechanics, 4.2).
    #[test]
    fn balls_touch_on_a_circle() {
        let found = PointContact::new([[0.1, 0.2], [0.1, 0.2]]).unwrap();
        let modulus = STEEL[0] / (1.0 - STEEL[1] * STEEL[1]);
        // a = (3 Q R/(4 E*))^(1/3), delta = a^2/R, R = 1/0.3, E* = E'/2.
        let (r, star) = (1.0 / 0.3, 0.5 * modulus);
        let a = (0.75 * r / star).cbrt();
        let stiffness = (a * a / r).powf(-1.5);
        assert!((found.stiffness / stiffness - 1.0).abs() < 1e-7, "{} beside {stiffness}", found.stiffness);
        let pressure = 1.5 / (PI * a * a);
        assert!((found.unit_pressure / pressure - 1.0).abs() < 1e-7, "{} beside {pressure}", found.unit_pressure);
    }

    /// Known values: Abramowitz and Stegun, table 17.1.
    #[test]
    fn elliptic_integrals_are_those_of_the_tables() {
        for (m, k, e) in
            [(0.0, FRAC_PI_2, FRAC_PI_2), (0.5, 1.854_074_677, 1.350_643_881), (0.99, 3.695_637_363, 1.015_993_546)]
        {
            let (own_k, own_e) = complete(m);
            assert!((own_k - k).abs() < 1e-9 && (own_e - e).abs() < 1e-9, "m = {m}: {own_k}, {own_e}");
        }
    }

    /// The ellipse against the fit of Hamrock and Brewe, J. Lubr. Technol. 105 (1983), which is off by up to 4 % itself, and
    /// at a ratio of 60 against the elliptic integrals of SciPy.
    #[test]
    fn ellipses_are_near_the_known_fits() {
        for ratio in [1.5, 3.0, 8.0, 20.0, 60.0] {
            let found = PointContact::new([[0.2, 0.0], [0.2 / ratio, 0.0]]).unwrap();
            let fit = 1.0339 * f64::powf(ratio, 0.636);
            assert!((found.ellipse / fit - 1.0).abs() < 0.04, "{} beside {fit} at {ratio}", found.ellipse);
            if ratio == 60.0 {
                let of_scipy = 13.455_675_854_659_956;
                assert!((found.ellipse / of_scipy - 1.0).abs() < 1e-12, "{} beside {of_scipy}", found.ellipse);
            }
        }
    }
}
