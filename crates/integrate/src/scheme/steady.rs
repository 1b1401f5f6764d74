//! Effect of time steps on the steady response of an oscillator to a harmonic force.
//!
//! ```text
//! x'' + 2 zeta w x' + w^2 x = F cos(W t),   z = exp(i W h)
//! midpoint           |X| = |H(W_h)| F / cos(W h / 2),   W_h = (2 / h) tan(W h / 2),   H(W) = 1 / (w^2 - W^2 + 2 i zeta w W)
//! generalised-alpha  X = x F / (1 + 2 zeta w v + w^2 x),   v = r h A / (z - 1),   x = (h v + r h^2 B) / (z - 1)
//! A = 1 - gamma + gamma z,   B = 1/2 - beta + beta z,   r = [(1 - a_f) z + a_f] / [(1 - a_m) z + a_m]
//! ```
//! The Runge-Kutta method treats each root l of l^2 + 2 zeta w l + w^2 separately: y' = l y + F exp(i W t), one step
//! from 0 divided by z - R(l h), where R is its growth without a force. The error of Dormand-Prince is not larger and
//! is taken to be equal.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::{Coefficients, Scheme};

impl Scheme {
    /// Amplitude of the steady response of an oscillator with steps of equal length, divided by that of the exact
    /// response. Theory (66a).
    ///
    /// `angle` is W h, rad, the phase of the force per step, above 0; `ratio` is W / w, the frequency of the force
    /// divided by the natural frequency of the oscillator; `damping` is its damping ratio. Infinite if a step contains
    /// half a period or more.
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
            Self::DormandPrince | Self::RungeKutta4 => of_runge_kutta([angle, ratio, damping]) / exact,
        }
    }
}

/// Steps of equal length in a periodic steady motion of an oscillator.
#[derive(Debug, Clone, Copy)]
pub struct SteadySteps {
    /// Number of steps per period.
    pub per_period: f64,
    /// Integration method.
    pub scheme: Scheme,
    /// Natural frequency of the oscillator divided by the frequency of the period; 0: no stiffness.
    pub resonance: f64,
    /// Damping ratio of the oscillator.
    pub damping: f64,
}

/// Places of a resonance on either side that are looked at.
const SHIFTS: i32 = 5;

impl SteadySteps {
    /// Largest relative change that the steps may cause in the response to an order of the period, if the natural
    /// frequency is known only to a relative accuracy `share`: max |G - 1|, theory (66a). It is 1 if the steps do not
    /// resolve the order.
    pub fn gain_error(&self, order: f64, share: f64) -> f64 {
        let angle = TAU * order / self.per_period;
        let off = |by: i32| {
            let resonance = self.resonance * (1.0 + share * f64::from(by) / f64::from(SHIFTS));
            // Far above the resonance inertia alone answers.
            let ratio = order / resonance.max(1e-6);
            (self.scheme.steady_gain(angle, ratio, self.damping) - 1.0).abs().min(1.0)
        };
        (-SHIFTS..=SHIFTS).map(off).fold(0.0, f64::max)
    }
}

/// Distance of a damping ratio from 1 below which both roots lie in one place.
const TWO_ROOTS: f64 = 1e-6;

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

/// |X| of Runge and Kutta's classical method.
fn of_runge_kutta([angle, ratio, damping]: [f64; 3]) -> f64 {
    let h = angle / ratio;
    let [middle, z] = [0.5 * angle, angle].map(|angle| Complex::from_polar(1.0, angle));
    // Two roots in one place have no parts by themselves.
    let damping = if (damping - 1.0).abs() < TWO_ROOTS { 1.0 + TWO_ROOTS } else { damping };
    let apart = Complex::from(damping * damping - 1.0).sqrt();
    let part = |root: Complex<f64>| {
        let step = |y: Complex<f64>, force: f64| {
            let k1 = root * y + force;
            let k2 = root * (y + k1 * (0.5 * h)) + middle * force;
            let k3 = root * (y + k2 * (0.5 * h)) + middle * force;
            let k4 = root * (y + k3 * h) + z * force;
            y + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0)
        };
        step(Complex::from(0.0), 1.0) / (z - step(Complex::from(1.0), 0.0))
    };
    let [one, two] = [apart - damping, -apart - damping];
    ((part(one) - part(two)) / (one - two)).norm()
}
