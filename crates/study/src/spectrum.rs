//! Amplitude spectra of evenly sampled records.

use std::f64::consts::PI;

use realfft::RealFftPlanner;
use serde::Serialize;

use crate::error::{StudyError, check};

/// What a record is multiplied with before it is transformed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Taper {
    /// Nothing: for records of whole periods, whose lines then stand in one bin each.
    None,
    /// w_k = (1 - cos(2 pi k / n)) / 2: for records that do not repeat themselves. Lines are three bins wide.
    Hann,
}

impl Taper {
    fn weight(self, k: usize, n: usize) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Hann => 0.5 * (1.0 - (2.0 * PI * k as f64 / n as f64).cos()),
        }
    }
}

/// Single-sided amplitudes of `samples` at 0, 1, 2, ... n/2 periods a record.
///
/// ```text
/// X_k = 2 |sum_j w_j (x_j - mean) exp(-2 pi i j k / n)| / sum_j w_j,   X_0 = |mean|
/// ```
/// A sine of amplitude 1 with a whole number of periods reads 1, whatever the taper. Between two bins a taper of Hann reads 0.85 at the least, none 0.64. The
/// mean is taken out first, so that a taper does not spread it over the lowest bins.
///
/// # Errors
/// [`StudyError::NotWholeCycles`] for an empty record, [`StudyError::NotFinite`].
///
/// # Example
/// ```
/// use study::{Taper, amplitude_spectrum};
/// let wave: Vec<f64> = (0..64).map(|k| 3.0 + (std::f64::consts::TAU * 5.0 * k as f64 / 64.0).sin()).collect();
/// for taper in [Taper::None, Taper::Hann] {
///     let lines = amplitude_spectrum(&wave, taper)?;
///     assert!((lines[5] - 1.0).abs() < 1e-13 && (lines[0] - 3.0).abs() < 1e-13 && lines[9] < 1e-13);
/// }
/// # Ok::<(), study::StudyError>(())
/// ```
pub fn amplitude_spectrum(samples: &[f64], taper: Taper) -> Result<Vec<f64>, StudyError> {
    let n = check(samples, 1)?;
    let mean = samples.iter().sum::<f64>() / n as f64;
    let mut input: Vec<f64> = samples.iter().enumerate().map(|(k, x)| taper.weight(k, n) * (x - mean)).collect();
    let sum: f64 = (0..n).map(|k| taper.weight(k, n)).sum();
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(n);
    let mut spectrum = transform.make_output_vec();
    // The lengths come from the plan itself, the only thing that `process` can complain about.
    if transform.process(&mut input, &mut spectrum).is_err() || sum <= 0.0 {
        return Err(StudyError::NotWholeCycles { samples: n, cycles: 1 });
    }
    let amplitude = |(k, x): (usize, &realfft::num_complex::Complex<f64>)| {
        // The bin at half the sampling rate holds its whole content once.
        let sides = if 2 * k == n { 1.0 } else { 2.0 };
        if k == 0 { mean.abs() } else { sides * x.norm() / sum }
    };
    Ok(spectrum.iter().enumerate().map(amplitude).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between two bins a line reads what the tapers promise at the least; far from it nothing is left of it with a taper.
    #[test]
    fn tapers_read_what_they_promise() {
        let n = 256;
        let wave: Vec<f64> = (0..n).map(|k| (2.0 * PI * 20.5 * f64::from(k) / f64::from(n)).sin()).collect();
        for (taper, least, far) in [(Taper::None, 0.63, 0.02), (Taper::Hann, 0.848, 1e-5)] {
            let lines = amplitude_spectrum(&wave, taper).unwrap();
            assert!(lines[20] > least && lines[20] <= 1.0, "{taper:?}: {}", lines[20]);
            assert!(lines[100] < far, "{taper:?}: {}", lines[100]);
        }
    }

    /// Alternating samples are a line at half the sampling rate.
    #[test]
    fn the_last_bin_is_not_doubled() {
        let lines = amplitude_spectrum(&[1.0, -1.0, 1.0, -1.0], Taper::None).unwrap();
        assert!((lines[2] - 1.0).abs() < 1e-15, "{lines:?}");
    }
}
