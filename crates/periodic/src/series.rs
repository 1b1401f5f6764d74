//! Truncated Fourier series of a periodic motion, and the table that takes it to samples and back.

use nalgebra::{DMatrix, DVector};

/// Motion of n coordinates over the phase tau (2 pi a period). Theory (69).
///
/// ```text
/// q(tau) = c_0 + sum_(k = 1 .. H) (a_k cos k tau + b_k sin k tau)
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FourierSeries {
    /// n x (2 H + 1), columns c_0, a_1, b_1, a_2, b_2, ...
    coefficients: DMatrix<f64>,
}

impl FourierSeries {
    /// No motion at a place, with room for so many harmonics.
    pub fn at_rest(place: &DVector<f64>, harmonics: usize) -> Self {
        let mut coefficients = DMatrix::zeros(place.len(), 2 * harmonics + 1);
        coefficients.set_column(0, place);
        Self { coefficients }
    }

    /// Series of samples at the phases 2 pi i / N, i = 0 .. N - 1, a column each. `None` with fewer than 2 H + 1
    /// samples.
    pub fn of_samples(samples: &DMatrix<f64>, harmonics: usize) -> Option<Self> {
        (samples.ncols() > 2 * harmonics)
            .then(|| Self { coefficients: samples * Basis::new(harmonics, samples.ncols()).projection() })
    }

    pub(crate) fn from_coefficients(coefficients: DMatrix<f64>) -> Self {
        Self { coefficients }
    }

    pub(crate) fn coefficients(&self) -> &DMatrix<f64> {
        &self.coefficients
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.coefficients.nrows()
    }

    /// H.
    pub fn harmonics(&self) -> usize {
        self.coefficients.ncols() / 2
    }

    /// Amplitude of harmonic `k` of a coordinate; of k = 0 the mean.
    pub fn amplitude(&self, coordinate: usize, k: usize) -> f64 {
        match k {
            0 => self.coefficients[(coordinate, 0)],
            _ if k > self.harmonics() => 0.0,
            _ => self.coefficients[(coordinate, 2 * k - 1)].hypot(self.coefficients[(coordinate, 2 * k)]),
        }
    }

    /// Coordinates at a phase, rad.
    pub fn at(&self, phase: f64) -> DVector<f64> {
        self.sum(phase, |k, cos, sin| [cos, sin].map(|x| if k == 0 { 1.0 } else { x }))
    }

    /// dq/dtau at a phase; velocity is that times 2 pi over the period.
    pub fn rate(&self, phase: f64) -> DVector<f64> {
        self.sum(phase, |k, cos, sin| [-(k as f64) * sin, k as f64 * cos])
    }

    /// d^2 q/dtau^2 at a phase; acceleration is that times (2 pi over the period)^2.
    pub fn acceleration(&self, phase: f64) -> DVector<f64> {
        self.sum(phase, |k, cos, sin| [cos, sin].map(|x| -((k * k) as f64) * x))
    }

    fn sum(&self, phase: f64, of: impl Fn(usize, f64, f64) -> [f64; 2]) -> DVector<f64> {
        let mut sum = self.coefficients.column(0) * of(0, 1.0, 0.0)[0];
        for k in 1..=self.harmonics() {
            let (sin, cos) = (k as f64 * phase).sin_cos();
            let [a, b] = of(k, cos, sin);
            sum += self.coefficients.column(2 * k - 1) * a + self.coefficients.column(2 * k) * b;
        }
        sum
    }

    /// Peak to peak of a linear combination of the coordinates: the largest of many samples, each refined by a parabola
    /// through its neighbours.
    pub fn peak_to_peak(&self, of: &DVector<f64>) -> f64 {
        let samples = (16 * self.harmonics().max(4)).next_power_of_two();
        let row = Basis::new(self.harmonics(), samples).values() * self.coefficients.tr_mul(of);
        let at = |i: usize| row[i % samples];
        let top = |sign: f64| {
            let best = (0..samples).max_by(|&a, &b| (sign * at(a)).total_cmp(&(sign * at(b)))).unwrap_or(0);
            let [before, here, after] = [best + samples - 1, best, best + 1].map(|i| sign * at(i));
            let bend = 2.0 * here - before - after;
            if bend > 0.0 { here + (after - before).powi(2) / (8.0 * bend) } else { here }
        };
        top(1.0) + top(-1.0)
    }

    /// Series with another number of harmonics: higher ones are cut off, or added as zeros.
    #[must_use]
    pub fn with_harmonics(&self, harmonics: usize) -> Self {
        let columns = 2 * harmonics + 1;
        let mut coefficients = DMatrix::zeros(self.coordinates(), columns);
        let kept = columns.min(self.coefficients.ncols());
        coefficients.columns_mut(0, kept).copy_from(&self.coefficients.columns(0, kept));
        Self { coefficients }
    }
}

/// Values of 1, cos k tau, sin k tau at equal phases.
#[derive(Debug, Clone)]
pub struct Basis {
    /// N x (2 H + 1): it times coefficients, one column a coordinate, are samples.
    values: DMatrix<f64>,
    /// d/dtau of them.
    rates: DMatrix<f64>,
    /// N x (2 H + 1): samples times it are coefficients.
    projection: DMatrix<f64>,
}

impl Basis {
    pub fn new(harmonics: usize, samples: usize) -> Self {
        let mut values = DMatrix::zeros(samples, 2 * harmonics + 1);
        let mut rates = values.clone();
        values.column_mut(0).fill(1.0);
        for i in 0..samples {
            for k in 1..=harmonics {
                // Exact multiples of the period are taken off first.
                let turn = (k * i % samples) as f64 / samples as f64;
                let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
                (values[(i, 2 * k - 1)], values[(i, 2 * k)]) = (cos, sin);
                (rates[(i, 2 * k - 1)], rates[(i, 2 * k)]) = (-(k as f64) * sin, k as f64 * cos);
            }
        }
        let mut projection = &values * (2.0 / samples as f64);
        projection.column_mut(0).scale_mut(0.5);
        Self { values, rates, projection }
    }

    pub fn samples(&self) -> usize {
        self.values.nrows()
    }

    pub fn harmonics(&self) -> usize {
        self.values.ncols() / 2
    }

    pub fn values(&self) -> &DMatrix<f64> {
        &self.values
    }

    pub fn rates(&self) -> &DMatrix<f64> {
        &self.rates
    }

    pub fn projection(&self) -> &DMatrix<f64> {
        &self.projection
    }
}
