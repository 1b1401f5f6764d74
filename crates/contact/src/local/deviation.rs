//! Effect on a contact band of a flank's deviation from its smooth surface. Theory (26a).
//!
//! To first order, at a given load, a deviation f(x) along the profile changes the approach by the mean of f, weighted
//! with the pressure of a flat punch as wide as the band:
//!
//! ```text
//! m(a) = 1/pi int_-1^1 f(x_0 + a y) / sqrt(1 - y^2) dy,     cos(k x): m = J_0(k a) cos(k x_0)
//! ```
//! f is even in y under the integral, so m is a function of a^2, which is proportional to the load.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Distances from the place of contact at which deviations are taken, either way.
pub(crate) const SAMPLES: usize = 16;
/// Terms of m over (a/A)^2 beside the constant one: waves up to k A = 10 count to a thousandth.
const TERMS: usize = 10;
/// The widest band A over the relative radius of curvature: that of 3.5 GPa on steel.
const WIDEST: f64 = 1.0 / 16.0;
/// Least slope of the approach by the load, over what it is on the smooth surface: where the mean would fall faster, the
/// flanks touch in several bands, and the first order says nothing.
const LEAST_SLOPE: f64 = 0.5;
/// Loads, over that of the widest band, at which slopes are compared: squares of so many parts.
const LOADS: usize = 12;

/// Mean of the deviations of both flanks over bands of any width at one position.
///
/// ```text
/// m(a) = m(0) + sum_i c_i (a/A)^(2 i),   i = 1 .. 10,   m(a) = m(A) for a > A
/// ```
/// A is R/16. The c_i are the coefficients of the Chebyshev series of f over x_0 - A .. x_0 + A through 32 points,
/// truncated after its 20th term.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandMean {
    /// A, mm.
    widest: f64,
    at_rest: f64,
    terms: [f64; TERMS],
}

impl BandMean {
    /// Half-width A of the widest band, mm, for a relative radius of curvature (mm).
    pub fn widest(radius: f64) -> f64 {
        WIDEST * radius
    }

    /// Distances from the position, to both sides, at which deviations are sampled, divided by A.
    pub fn places() -> &'static [f64; SAMPLES] {
        &TABLES.0
    }

    /// Mean of the deviation over contact bands up to `widest` (mm). `samples` are the averages (mm) of the deviation
    /// on both sides of the position, at each of [`BandMean::places`].
    pub fn new(widest: f64, samples: &[f64; SAMPLES]) -> Self {
        let of = |weights: &[f64; SAMPLES]| weights.iter().zip(samples).map(|(w, f)| w * f).sum();
        let all = &TABLES.1;
        Self { widest, at_rest: of(&all[0]), terms: std::array::from_fn(|i| of(&all[i + 1])) }
    }

    /// This mean, limited so that the approach still grows with the load. `load` (N/mm) is that of the widest band,
    /// `slope` (mm^2/N) that of the approach on the smooth surface there. If the mean changes too fast, it is kept near
    /// its value over the widest band.
    #[must_use]
    pub fn kept_rising(mut self, load: f64, slope: f64) -> Self {
        let by_share =
            |t: f64| self.terms.iter().enumerate().rev().fold(0.0, |sum, (i, c)| sum * t + (i + 1) as f64 * c);
        let steepest = (0..=LOADS).map(|i| by_share((i as f64 / LOADS as f64).powi(2))).fold(0.0, f64::min);
        let most = LEAST_SLOPE * slope * load;
        if -steepest > most {
            let share = -most / steepest;
            let mean = self.at_rest + self.change(1.0).0;
            self.terms.iter_mut().for_each(|c| *c *= share);
            self.at_rest = mean - self.change(1.0).0;
        }
        self
    }

    /// m(0), its contribution to the gap, mm.
    pub fn at_rest(&self) -> f64 {
        self.at_rest
    }

    /// The ratio (a/A)^2.
    pub fn share(&self, half_width: f64) -> f64 {
        (half_width / self.widest).powi(2)
    }

    /// m - m(0) (mm) at t = (a/A)^2, and the product t dm/dt.
    pub fn change(&self, t: f64) -> (f64, f64) {
        let (mut value, mut slope) = (0.0, 0.0);
        let within = t.min(1.0);
        for (i, c) in self.terms.iter().enumerate().rev() {
            value = value * within + c;
            slope = slope * within + (i + 1) as f64 * c;
        }
        (within * value, if t < 1.0 { within * slope } else { 0.0 })
    }

    /// Mean of m - m(0) (mm) over loads from 0 to that of t = (a/A)^2.
    pub fn mean_change(&self, t: f64) -> f64 {
        let within = t.min(1.0);
        let value = self.terms.iter().enumerate().rev().fold(0.0, |sum, (i, c)| sum * within + c / (i + 2) as f64);
        let below = within * value;
        if t > 1.0 { below / t + (1.0 - 1.0 / t) * self.change(1.0).0 } else { below }
    }
}

/// Places over A, and for each power of (a/A)^2 the weights of the samples.
static TABLES: LazyLock<([f64; SAMPLES], [[f64; SAMPLES]; TERMS + 1])> = LazyLock::new(|| {
    let angle = |j: usize| (2 * j + 1) as f64 * PI / (4 * SAMPLES) as f64;
    let places = std::array::from_fn(|j| angle(j).cos());
    // Coefficients of T_2k(y) by powers of y^2: T_2k = T_k(2 y^2 - 1).
    let mut polynomials = vec![vec![1.0], vec![-1.0, 2.0]];
    for k in 2..=TERMS {
        let (last, before) = (&polynomials[k - 1], &polynomials[k - 2]);
        let at = |p: &Vec<f64>, i: usize| p.get(i).copied().unwrap_or(0.0);
        let next = (0..=k).map(|i| {
            let twice = if i > 0 { 4.0 * at(last, i - 1) } else { 0.0 };
            twice - 2.0 * at(last, i) - at(before, i)
        });
        polynomials.push(next.collect());
    }
    let mut weights = [[0.0; SAMPLES]; TERMS + 1];
    // Mean of y^(2 i) over -1 .. 1 with 1/sqrt(1 - y^2).
    let mut mean = 1.0;
    for (i, row) in weights.iter_mut().enumerate() {
        if i > 0 {
            mean *= (2 * i - 1) as f64 / (2 * i) as f64;
        }
        for (k, polynomial) in polynomials.iter().enumerate().skip(i) {
            let scale = if k == 0 { 1.0 } else { 2.0 } / SAMPLES as f64;
            for (j, w) in row.iter_mut().enumerate() {
                *w += mean * polynomial[i] * scale * (2.0 * k as f64 * angle(j)).cos();
            }
        }
    }
    (places, weights)
});

#[cfg(test)]
mod tests {
    use super::*;

    fn of_wave(by_widest: f64) -> BandMean {
        BandMean::new(1.0, &BandMean::places().map(|x| (by_widest * x).cos()))
    }

    /// Bessel's function by its integral.
    fn bessel(x: f64) -> f64 {
        let n = 400;
        (0..n).map(|j| (x * (PI * (f64::from(j) + 0.5) / f64::from(n)).cos()).cos()).sum::<f64>() / f64::from(n)
    }

    /// A wave counts with J_0(k a), whatever the band.
    #[test]
    fn a_wave_counts_with_bessels_function() {
        for (by_widest, off) in [(0.5, 1e-9), (3.0, 1e-9), (6.0, 1e-7), (10.0, 1e-3)] {
            let mean = of_wave(by_widest);
            for i in 0..=20 {
                let a = f64::from(i) / 20.0;
                let found = mean.at_rest() + mean.change(mean.share(a)).0;
                assert!((found - bessel(by_widest * a)).abs() < off, "k A {by_widest}, a/A {a}: {found}");
            }
        }
    }

    /// The slope is the derivative, and the mean over loads the integral; beyond the widest band nothing changes.
    #[test]
    fn slope_and_mean_follow_the_value() {
        let mean = of_wave(4.0);
        for t in [0.05, 0.3, 0.9, 1.7] {
            let h = 1e-6;
            let difference = (mean.change(t + h).0 - mean.change(t - h).0) / (2.0 * h);
            assert!((mean.change(t).1 - t * difference).abs() < 1e-8, "t {t}");
            let n = 20_000;
            let sum: f64 = (0..n).map(|i| mean.change(t * (f64::from(i) + 0.5) / f64::from(n)).0).sum();
            assert!((mean.mean_change(t) - sum / f64::from(n)).abs() < 1e-8, "t {t}");
        }
        assert_eq!(mean.change(1.7).0, mean.change(1.0).0);
    }

    /// Waves that would make the approach fall as the load grows do not.
    #[test]
    fn the_approach_keeps_rising() {
        let (load, slope) = (100.0, 1e-5);
        let kept = BandMean { terms: of_wave(8.0).terms.map(|c| 0.01 * c), ..of_wave(8.0) }.kept_rising(load, slope);
        for i in 1..100 {
            let t = f64::from(i) / 100.0;
            assert!(kept.change(t).1 / (t * load) > -0.55 * slope, "t {t}");
        }
        let gentle = of_wave(0.1);
        assert_eq!(gentle.kept_rising(1e6, 1.0), gentle);
    }
}
