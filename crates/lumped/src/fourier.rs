//! Fourier series over a phase: mesh stiffness, transmission error, torque.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::LumpedError;

/// Fourier series of an angle.
///
/// ```text
/// f(phi) = f_0 + sum_n [a_n cos(n phi) + b_n sin(n phi)],   n = 1, 2, ...
/// ```
/// phi in rad, f in any unit. The lists may be of different lengths.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Fourier {
    /// f_0.
    pub mean: f64,
    /// a_1, a_2, ...
    #[serde(default)]
    pub cosine: Vec<f64>,
    /// b_1, b_2, ...
    #[serde(default)]
    pub sine: Vec<f64>,
}

impl Fourier {
    /// A constant: f_0 alone.
    pub fn constant(mean: f64) -> Self {
        Self { mean, ..Self::default() }
    }

    /// f_0 + a cos(phi) + b sin(phi).
    pub fn first_order(mean: f64, cosine: f64, sine: f64) -> Self {
        Self { mean, cosine: vec![cosine], sine: vec![sine] }
    }

    /// Trigonometric interpolation of `samples` at phi = 2 pi k / n, k = 0 .. n-1, up to order `orders`.
    ///
    /// With `orders` >= n/2 the series goes through every sample; with fewer it is their least-squares fit.
    ///
    /// # Errors
    /// [`LumpedError::Empty`] without samples, [`LumpedError::NotFinite`] when one is not a number.
    pub fn of_samples(quantity: &'static str, samples: &[f64], orders: usize) -> Result<Self, LumpedError> {
        let n = samples.len();
        if n == 0 {
            return Err(LumpedError::Empty { quantity });
        }
        if let Some(index) = samples.iter().position(|x| !x.is_finite()) {
            return Err(LumpedError::NotFinite { quantity, index, value: samples[index] });
        }
        // Steps of the angle are counted modulo n: no digits are lost at high orders.
        let sum = |order: usize, of: fn(f64) -> f64| -> f64 {
            samples.iter().enumerate().map(|(k, x)| x * of(TAU * ((order * k) % n) as f64 / n as f64)).sum()
        };
        let share = |order: usize| if 2 * order == n { 1.0 } else { 2.0 } / n as f64;
        let highest = orders.min(n / 2);
        Ok(Self {
            mean: samples.iter().sum::<f64>() / n as f64,
            cosine: (1..=highest).map(|o| share(o) * sum(o, f64::cos)).collect(),
            sine: (1..=highest).map(|o| share(o) * sum(o, f64::sin)).collect(),
        })
    }

    /// f(phi).
    pub fn at(&self, angle: f64) -> f64 {
        self.with_slope(angle)[0]
    }

    /// f(phi) and df/dphi.
    pub fn with_slope(&self, angle: f64) -> [f64; 2] {
        let (s, c) = angle.sin_cos();
        let (mut cos, mut sin) = (c, s);
        let (mut value, mut slope) = (self.mean, 0.0);
        for order in 1..=self.orders() {
            let n = order as f64;
            let [a, b] = self.coefficients(order);
            value += a * cos + b * sin;
            slope += n * (b * cos - a * sin);
            (cos, sin) = (cos * c - sin * s, sin * c + cos * s);
        }
        [value, slope]
    }

    /// Highest order.
    pub fn orders(&self) -> usize {
        self.cosine.len().max(self.sine.len())
    }

    /// a_n and b_n, 0 beyond the lists; n >= 1.
    pub fn coefficients(&self, order: usize) -> [f64; 2] {
        let of = |list: &[f64]| order.checked_sub(1).and_then(|i| list.get(i)).copied().unwrap_or(0.0);
        [of(&self.cosine), of(&self.sine)]
    }

    /// sqrt(a_n^2 + b_n^2).
    pub fn amplitude(&self, order: usize) -> f64 {
        let [a, b] = self.coefficients(order);
        a.hypot(b)
    }

    /// Series with all coefficients times a factor, as for another unit.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let all = |list: &[f64]| list.iter().map(|x| factor * x).collect();
        Self { mean: factor * self.mean, cosine: all(&self.cosine), sine: all(&self.sine) }
    }

    /// Smallest value on a grid of 16 angles an order (at least 64).
    pub fn least(&self) -> f64 {
        let n = (16 * self.orders()).max(64);
        (0..n).map(|k| self.at(TAU * k as f64 / n as f64)).fold(f64::INFINITY, f64::min)
    }

    /// Every coefficient is a number.
    pub(crate) fn check(&self, quantity: &'static str) -> Result<(), LumpedError> {
        let all = std::iter::once(&self.mean).chain(&self.cosine).chain(&self.sine);
        match all.enumerate().find(|(_, x)| !x.is_finite()) {
            Some((index, &value)) => Err(LumpedError::NotFinite { quantity, index, value }),
            None => Ok(()),
        }
    }

    /// A stiffness, a mass: every coefficient a number, and nowhere zero or less.
    pub(crate) fn check_positive(&self, quantity: &'static str) -> Result<(), LumpedError> {
        self.check(quantity)?;
        let least = self.least();
        if least > 0.0 { Ok(()) } else { Err(LumpedError::NotPositive { quantity, value: least }) }
    }
}

/// A torque that repeats in time: T(t) = f(omega t).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FourierTorque {
    /// Torque over its own angle, N mm.
    pub series: Fourier,
    /// omega, rad/s; of no meaning for a constant torque.
    #[serde(default)]
    pub angular_frequency: f64,
}

impl FourierTorque {
    /// Always the same, N mm.
    pub fn constant(torque: f64) -> Self {
        Self { series: Fourier::constant(torque), angular_frequency: 0.0 }
    }

    /// T_0 + T_a sin(omega t): N mm, N mm, rad/s.
    pub fn sine(mean: f64, amplitude: f64, angular_frequency: f64) -> Self {
        Self { series: Fourier::first_order(mean, 0.0, amplitude), angular_frequency }
    }

    /// T at time `t` (s), N mm.
    pub fn at(&self, t: f64) -> f64 {
        self.series.at(self.angular_frequency * t)
    }

    /// T_0, N mm.
    pub fn mean(&self) -> f64 {
        self.series.mean
    }

    /// Every number is one.
    pub(crate) fn check(&self, quantity: &'static str) -> Result<(), LumpedError> {
        self.series.check(quantity)?;
        if self.angular_frequency.is_finite() {
            Ok(())
        } else {
            Err(LumpedError::NotFinite { quantity, index: 0, value: self.angular_frequency })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Through every sample, for even and odd numbers of them.
    #[test]
    fn interpolation_goes_through_the_samples() {
        for n in [1usize, 2, 7, 12] {
            let samples: Vec<f64> = (0..n).map(|k| ((3 * k * k + 1) % 11) as f64).collect();
            let series = Fourier::of_samples("test", &samples, n).unwrap();
            for (k, x) in samples.iter().enumerate() {
                let at = series.at(TAU * k as f64 / n as f64);
                assert!((at - x).abs() < 1e-12, "sample {k} of {n}: {at}, not {x}");
            }
        }
    }

    #[test]
    fn slope_is_the_derivative() {
        let series = Fourier { mean: 2.0, cosine: vec![0.3, 0.0, -0.2], sine: vec![0.1, 0.7] };
        for k in 0..20 {
            let (phi, h) = (0.37 * f64::from(k), 1e-5);
            let difference = (series.at(phi + h) - series.at(phi - h)) / (2.0 * h);
            assert!((series.with_slope(phi)[1] - difference).abs() < 1e-8, "at {phi} rad");
        }
    }

    /// A hundred orders by rotation of one angle, against a cosine each.
    #[test]
    fn high_orders_keep_their_digits() {
        let series = Fourier { mean: 0.0, cosine: vec![1.0; 100], sine: vec![] };
        let direct: f64 = (1..=100).map(|n| (f64::from(n) * 1.2345).cos()).sum();
        assert!((series.at(1.2345) - direct).abs() < 1e-11);
    }

    #[test]
    fn what_is_no_series_is_refused() {
        assert!(matches!(Fourier::of_samples("k", &[], 3), Err(LumpedError::Empty { quantity: "k" })));
        let bad = Fourier::of_samples("k", &[1.0, f64::NAN], 3);
        assert!(matches!(bad, Err(LumpedError::NotFinite { index: 1, .. })));
        let soft = Fourier::first_order(1.0, 0.0, 2.0).check_positive("k");
        assert!(matches!(soft, Err(LumpedError::NotPositive { .. })));
    }
}
