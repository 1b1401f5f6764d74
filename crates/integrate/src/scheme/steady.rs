//! What steps make of the steady answer of an oscillator to a harmonic force.
//!
//! ```text
//! x'' + 2 zeta w x' + w^2 x = F cos(W t),   z = exp(i W h)
//! midpoint           |X| = |H(W_h)| F / cos(W h / 2),   W_h = (2 / h) tan(W h / 2),   H(W) = 1 / (w^2 - W^2 + 2 i zeta w W)
//! generalised-alpha  X = x F / (1 + 2 zeta w v + w^2 x),   v = r h A / (z - 1),   x = (h v + r h^2 B) / (z - 1)
//! A = 1 - gamma + gamma z,   B = 1/2 - beta + beta z,   r = [(1 - a_f) z + a_f] / [(1 - a_m) z + a_m]
//! ```
//! Explicit methods of fourth order and above are taken as exact: within their stability they are off by (W h)^4 / 120.

use nalgebra::Complex;

use super::{Coefficients, Scheme};

impl Scheme {
    /// Amplitude of the steady answer of an oscillator with steps of one length, over that of the exact answer. Theory (66a).
    ///
    /// `angle`: W h, rad, the force's phase in a step, above 0; `ratio`: W / w, the force's frequency over the
    /// oscillator's own; `damping`: its damping ratio. Infinite where half a period or more falls into a step.
    pub fn steady_gain(&self, angle: f64, ratio: f64, damping: f64) -> f64 {
        if angle >= std::f64::consts::PI {
            return f64::INFINITY;
        }
        // In units of the own frequency: w = 1, W = ratio, h = angle / ratio.
        let exact = answer(ratio, damping);
        match self {
            Self::Energy => {
                let half = 0.5 * angle;
                answer(ratio * half.tan() / half, damping) / half.cos() / exact
            }
            Self::Newmark => of_family(Coefficients::newmark(0.25, 0.5), [angle, ratio, damping]) / exact,
            Self::GeneralisedAlpha { rho } => {
                of_family(Coefficients::generalised_alpha(*rho), [angle, ratio, damping]) / exact
            }
            Self::DormandPrince | Self::RungeKutta4 => 1.0,
        }
    }
}

/// |H| of an oscillator of frequency 1.
fn answer(ratio: f64, damping: f64) -> f64 {
    1.0 / (1.0 - ratio * ratio).hypot(2.0 * damping * ratio).max(f64::MIN_POSITIVE)
}

/// |X| of the generalised-alpha family, whose forces are those at the ends of steps.
fn of_family(c: Coefficients, [angle, ratio, damping]: [f64; 3]) -> f64 {
    let h = angle / ratio;
    let z = Complex::from_polar(1.0, angle);
    let between = |end: f64| Complex::from(1.0 - end) + z * end;
    // v (z - 1) = h b A,   x (z - 1) = h v + h^2 b B,   b ((1 - a_m) z + a_m) = a ((1 - a_f) z + a_f)
    let step = z - 1.0;
    let b_over_a = between(1.0 - c.a_f) / between(1.0 - c.a_m);
    let v = b_over_a * between(c.gamma) * h / step;
    let shifted = Complex::from(0.5 - c.beta) + z * c.beta;
    let x = (v * h + b_over_a * shifted * (h * h)) / step;
    // F = a + 2 zeta v + x
    (x / (Complex::from(1.0) + v * (2.0 * damping) + x)).norm()
}
