//! Products of a sampled function with the harmonics, projected onto them: by one Fourier transform of the function.

use std::sync::Arc;

use nalgebra::DMatrix;
use realfft::{RealFftPlanner, RealToComplex, num_complex::Complex};

/// cos or sin of a multiple of the phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Wave {
    order: usize,
    sine: bool,
}

impl Wave {
    /// Wave of a column of coefficients: 1, cos, sin, cos 2, sin 2 and so on.
    pub fn of(column: usize) -> Self {
        Self { order: column.div_ceil(2), sine: column > 0 && column.is_multiple_of(2) }
    }

    /// Derivative of the wave with respect to the phase: a factor and the other wave.
    pub fn rate(self) -> (f64, Self) {
        let factor = if self.sine { self.order as f64 } else { -(self.order as f64) };
        (factor, Self { sine: !self.sine, ..self })
    }
}

/// Fourier transforms of entries of sampled matrices.
pub(crate) struct SeriesTransform {
    plan: Arc<dyn RealToComplex<f64>>,
    samples: Vec<f64>,
}

/// Sums of a sampled function with all waves.
pub(crate) struct WaveSums {
    /// sum of s exp(-i m tau).
    sums: Vec<Complex<f64>>,
    count: f64,
}

impl SeriesTransform {
    /// Transform of `samples` samples a period.
    pub fn new(samples: usize) -> Self {
        Self { plan: RealFftPlanner::new().plan_fft_forward(samples), samples: vec![0.0; samples] }
    }

    /// Sums of an entry of matrices, one a sample, times a factor; `None` where the entry is zero in all of them.
    pub fn of(&mut self, matrices: &[DMatrix<f64>], entry: (usize, usize), factor: f64) -> Option<WaveSums> {
        if matrices.iter().all(|m| m[entry] == 0.0) {
            return None;
        }
        let sums = self.sums(matrices.iter().map(|m| factor * m[entry]))?;
        Some(WaveSums { sums, count: self.samples.len() as f64 })
    }

    /// sum of s exp(-i m tau) over all samples s, m = 0 .. N/2.
    pub fn sums(&mut self, samples: impl Iterator<Item = f64>) -> Option<Vec<Complex<f64>>> {
        self.samples.iter_mut().zip(samples).for_each(|(own, s)| *own = s);
        let mut sums = self.plan.make_output_vec();
        // Both lists have the lengths that the plan itself gave.
        self.plan.process(&mut self.samples, &mut sums).ok()?;
        Some(sums)
    }
}

impl WaveSums {
    /// Sums with cos m tau and sin m tau, m of either sign.
    fn cos_sin(&self, order: isize) -> [f64; 2] {
        let sum = self.sums[order.unsigned_abs()];
        [sum.re, if order < 0 { sum.im } else { -sum.im }]
    }

    /// Coefficient `row` of the function times a wave: of the products, cos a cos b = [cos (a - b) + cos (a + b)] / 2
    /// and its kin.
    pub fn projected(&self, row: usize, wave: Wave) -> f64 {
        let own = Wave::of(row);
        let (a, b) = (own.order as isize, wave.order as isize);
        let [difference, sum] = [self.cos_sin(a - b), self.cos_sin(a + b)];
        let product = match (own.sine, wave.sine) {
            (false, false) => difference[0] + sum[0],
            (true, true) => difference[0] - sum[0],
            (true, false) => sum[1] + difference[1],
            (false, true) => sum[1] - difference[1],
        };
        product / if row == 0 { 2.0 * self.count } else { self.count }
    }
}
