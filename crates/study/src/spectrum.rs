//! Amplitude spectra of records that are not whole cycles: windows, interpolated peaks, sidebands.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use crate::{
    error::{StudyError, check, positive},
    transform::real_transform,
};

/// Window w(x), 0 <= x < 1 (periodic), by which the samples of a record are weighted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Window {
    /// 1: for records of whole cycles; otherwise it leaks.
    Rectangular,
    /// (1 - cos 2 pi x) / 2: resolves lines four bins apart.
    Hann,
    /// Four-term Blackman-Harris: side lobes at -92 dB, so that a small sideband is visible next to a large carrier;
    /// resolves eight bins.
    BlackmanHarris,
    /// Five-term flat top: an off-bin sine has its amplitude within 0.1 % without interpolation. It resolves ten bins.
    /// Because its top is flat, the frequency of a peak is accurate only to half a bin.
    FlatTop,
}

impl Window {
    /// Coefficients of w(x) = sum_k (-1)^k a_k cos(2 pi k x).
    fn terms(self) -> &'static [f64] {
        match self {
            Self::Rectangular => &[1.0],
            Self::Hann => &[0.5, 0.5],
            // F. J. Harris, Proc. IEEE 66 (1978) 51, table 1.
            Self::BlackmanHarris => &[0.35875, 0.48829, 0.14128, 0.01168],
            // ISO 18431-2's flat top, over the sum of its coefficients.
            Self::FlatTop => &[0.215_578_95, 0.416_631_58, 0.277_263_158, 0.083_578_947, 0.006_947_368],
        }
    }

    /// w(x).
    pub(crate) fn at(self, x: f64) -> f64 {
        let terms = self.terms().iter().enumerate();
        terms.map(|(k, a)| if k % 2 == 0 { 1.0 } else { -1.0 } * a * (TAU * k as f64 * x).cos()).sum()
    }

    /// Equivalent noise bandwidth in bins, the mean of w^2 divided by the square of its mean. The power of noise in a
    /// band is the sum of amplitude^2 / 2 divided by this.
    pub fn noise_bandwidth(self) -> f64 {
        let [first, rest @ ..] = self.terms() else { return 1.0 };
        1.0 + rest.iter().map(|a| 0.5 * a * a).sum::<f64>() / (first * first)
    }

    /// Half width of the main lobe, bins: two sines closer than this are one peak.
    pub(crate) fn half_lobe(self) -> f64 {
        self.terms().len() as f64
    }
}

/// Amplitude spectrum of one record.
///
/// ```text
/// A(f) = 2 |sum_j w_j (x_j - mean) exp(-2 pi i f j / f_s)| / (n G),   G = mean of w
/// ```
/// A sine of amplitude 1 gives 1 at its frequency with any window, even if its frequency lies between the bins.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spectrum {
    /// Distance between the bins, f_s / n, Hz (the inverse of the time unit of `rate`).
    pub resolution: f64,
    /// Mean of the record (weighted by the window), in the unit of the samples.
    pub mean: f64,
    /// Amplitudes A at f = 0, 1, 2, ... bins; at 0 it is the remainder after the mean is removed.
    pub amplitudes: Vec<f64>,
    /// Window of the spectrum.
    pub window: Window,
    #[serde(skip)]
    windowed: Vec<f64>,
}

/// A spectral line, interpolated between bins.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peak {
    /// Frequency, Hz.
    pub frequency: f64,
    /// Single-sided amplitude, in the unit of the samples.
    pub amplitude: f64,
}

/// Lines at equal distances on both sides of a carrier.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sidebands {
    /// The carrier.
    pub carrier: Peak,
    /// The lines below and above the carrier, at one, two, ... times the spacing.
    pub pairs: Vec<[Peak; 2]>,
    /// Noise floor: median of the bins in this range that contain neither carrier nor sideband. A real line exceeds it.
    pub floor: f64,
}

/// Spectrum of `samples` with sampling rate `rate`, samples per second.
///
/// # Errors
/// [`StudyError::TooFewSamples`] for fewer than 8 samples, [`StudyError::NotFinite`] for a sample that is not a finite
/// number, [`StudyError::NotPositive`] for a rate that is not above 0.
///
/// # Example
/// ```
/// use study::{Window, spectrum};
/// // 12.34 Hz for 4 s: 49.36 cycles.
/// let wave: Vec<f64> = (0..400).map(|k| (std::f64::consts::TAU * 12.34 * 0.01 * k as f64).sin()).collect();
/// let peak = spectrum(&wave, 100.0, Window::Hann)?.largest_peak().unwrap();
/// assert!((peak.amplitude - 1.0).abs() < 1e-3 && (peak.frequency - 12.34).abs() < 1e-3);
/// # Ok::<(), study::StudyError>(())
/// ```
pub fn spectrum(samples: &[f64], rate: f64, window: Window) -> Result<Spectrum, StudyError> {
    let n = samples.len();
    if n < 8 {
        return Err(StudyError::TooFewSamples { samples: n, least: 8 });
    }
    check(samples, 1)?;
    positive("sampling rate", rate)?;
    let weights: Vec<f64> = (0..n).map(|j| window.at(j as f64 / n as f64)).collect();
    let sum: f64 = weights.iter().sum();
    // The weighted mean leaves nothing at f = 0 that would leak into low lines.
    let mean = samples.iter().zip(&weights).map(|(x, w)| x * w).sum::<f64>() / sum;
    let windowed: Vec<f64> = samples.iter().zip(&weights).map(|(x, w)| w * (x - mean) * 2.0 / sum).collect();
    drop(weights);
    let transform = real_transform(windowed.clone()).unwrap_or_default();
    let last = transform.len().saturating_sub(1);
    let amplitudes = transform
        .iter()
        .enumerate()
        .map(|(k, bin)| bin.norm() * if k == 0 || (k == last && n.is_multiple_of(2)) { 0.5 } else { 1.0 })
        .collect();
    Ok(Spectrum { resolution: rate / n as f64, mean, amplitudes, window, windowed })
}

impl Spectrum {
    /// Amplitude A(f) at any frequency up to half of the sampling rate, Hz.
    pub fn amplitude_at(&self, frequency: f64) -> f64 {
        let step = TAU * frequency / (self.resolution * self.windowed.len() as f64);
        let (mut re, mut im) = (0.0, 0.0);
        for (j, x) in self.windowed.iter().enumerate() {
            let (sin, cos) = (step * j as f64).sin_cos();
            re += x * cos;
            im -= x * sin;
        }
        re.hypot(im)
    }

    /// Local maxima of at least `least` (in the unit of the samples), ascending in frequency, each at its interpolated
    /// frequency.
    pub fn peaks(&self, least: f64) -> Vec<Peak> {
        let a = &self.amplitudes;
        (1..a.len().saturating_sub(1))
            // Bins next to an off-bin line read up to 4 dB too little.
            .filter(|&k| a[k] >= a[k - 1] && a[k] > a[k + 1] && a[k] >= 0.6 * least)
            .map(|k| self.refined(k))
            .filter(|peak| peak.amplitude >= least)
            .collect()
    }

    /// The largest line.
    pub fn largest_peak(&self) -> Option<Peak> {
        let inner = 1..self.amplitudes.len().saturating_sub(1);
        inner.max_by(|&i, &j| self.amplitudes[i].total_cmp(&self.amplitudes[j])).map(|k| self.refined(k))
    }

    /// The line nearest to `frequency` (Hz) within one bin, with its interpolated maximum.
    pub fn near(&self, frequency: f64) -> Peak {
        self.maximum([frequency - self.resolution, frequency + self.resolution])
    }

    /// Sidebands of the line at `carrier` (Hz), spaced by `spacing` (Hz), `orders` on either side.
    ///
    /// # Errors
    /// [`StudyError::Unresolved`] if the spacing is not wider than the window's main lobe: use a longer record.
    pub fn sidebands(&self, carrier: f64, spacing: f64, orders: usize) -> Result<Sidebands, StudyError> {
        let least = 2.0 * self.window.half_lobe() * self.resolution;
        if !(spacing >= least && carrier.is_finite()) {
            return Err(StudyError::Unresolved { spacing, least });
        }
        let carrier = self.near(carrier);
        let pairs = (1..=orders)
            .map(|order| [-1.0, 1.0].map(|side| self.near(carrier.frequency + side * order as f64 * spacing)))
            .collect();
        let reach = (orders as f64 + 0.5) * spacing;
        let lobe = self.window.half_lobe() * self.resolution;
        let mut between: Vec<f64> = (1..self.amplitudes.len())
            .filter(|&k| {
                let away = k as f64 * self.resolution - carrier.frequency;
                away.abs() <= reach && (away - spacing * (away / spacing).round()).abs() > lobe
            })
            .map(|k| self.amplitudes[k])
            .collect();
        between.sort_by(f64::total_cmp);
        let floor = between.get(between.len() / 2).copied().unwrap_or(0.0);
        Ok(Sidebands { carrier, pairs, floor })
    }

    fn refined(&self, bin: usize) -> Peak {
        let f = bin as f64 * self.resolution;
        self.maximum([f - self.resolution, f + self.resolution])
    }

    /// Golden-section search: the main lobe has one maximum within two bins.
    fn maximum(&self, [mut low, mut high]: [f64; 2]) -> Peak {
        let ratio = 0.5 * (5f64.sqrt() - 1.0);
        let nyquist = 0.5 * self.resolution * self.windowed.len() as f64;
        (low, high) = (low.clamp(0.0, nyquist), high.clamp(0.0, nyquist));
        let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
        let mut values = inner.map(|f| self.amplitude_at(f));
        // To a hundred-thousandth of a bin; the amplitude is flat there.
        for _ in 0..25 {
            if values[0] > values[1] {
                high = inner[1];
                inner = [high - ratio * (high - low), inner[0]];
                values = [self.amplitude_at(inner[0]), values[0]];
            } else {
                low = inner[0];
                inner = [inner[1], low + ratio * (high - low)];
                values = [values[1], self.amplitude_at(inner[1])];
            }
        }
        let frequency = 0.5 * (low + high);
        Peak { frequency, amplitude: self.amplitude_at(frequency) }
    }
}

/// Largest loss of amplitude for a line half a bin off, without interpolation: 1 - A(1/2 bin) / A(0).
pub fn scalloping_loss(window: Window) -> f64 {
    // sum of the Dirichlet kernels of the window's cosines at half a bin.
    let sinc = |x: f64| if x == 0.0 { 1.0 } else { (PI * x).sin() / (PI * x) };
    let [first, rest @ ..] = window.terms() else { return 0.0 };
    let mut sum = first * sinc(0.5);
    for (k, a) in (1..).zip(rest) {
        // The window's sign (-1)^k and that of the kernel k bins away cancel.
        let k = f64::from(k);
        sum += 0.5 * a * (sinc(0.5 - k) + sinc(0.5 + k));
    }
    1.0 - sum.abs() / first
}
