//! Amplitudes of the mesh harmonics.

use std::f64::consts::PI;

use serde::Serialize;

use crate::{
    Window,
    error::{StudyError, check},
    order_tracking::order_amplitude,
    transform::real_transform,
};

/// One harmonic of the mesh frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Harmonic {
    /// Order, a multiple of the mesh frequency: 1, 2, ...
    pub order: usize,
    /// Single-sided amplitude (half of the peak to peak), in the unit of the samples.
    pub amplitude: f64,
    /// Phase of the cosine `amplitude * cos(2 pi order * phase + phase_rad)`, rad, -pi .. pi.
    pub phase_rad: f64,
}

/// The first `orders` mesh harmonics of `samples`, evenly spaced over `cycles` whole mesh cycles.
///
/// ```text
/// X_h = 2/n sum_k x_k exp(-2 pi i (h cycles) k / n)
/// ```
///
/// A sine of amplitude 1 gives 1, and its neighbouring orders give 0: the record is a whole number of cycles, so no
/// window is needed. Orders above half the number of samples per cycle are not contained in the record and are omitted.
/// The order exactly at half is contained only once and is therefore not doubled.
///
/// # Errors
/// The errors of [`crate::cycle_statistics`].
///
/// # Example
/// ```
/// let wave: Vec<f64> = (0..16).map(|k| 7.0 + (2.0 * std::f64::consts::PI * k as f64 / 16.0).sin()).collect();
/// let h = study::mesh_harmonics(&wave, 1, 3)?;
/// assert!((h[0].amplitude - 1.0).abs() < 1e-14 && h[1].amplitude < 1e-14);
/// # Ok::<(), study::StudyError>(())
/// ```
pub fn mesh_harmonics(samples: &[f64], cycles: usize, orders: usize) -> Result<Vec<Harmonic>, StudyError> {
    let per_cycle = check(samples, cycles)?;
    let n = samples.len();
    let spectrum = real_transform(samples.to_vec()).ok_or(StudyError::NotWholeCycles { samples: n, cycles })?;
    Ok((1..=orders.min(per_cycle / 2))
        .map(|order| {
            let bin = spectrum[order * cycles];
            let sides = if 2 * order == per_cycle { 1.0 } else { 2.0 };
            let phase = bin.im.atan2(bin.re);
            Harmonic {
                order,
                amplitude: sides * bin.norm() / n as f64,
                phase_rad: if phase <= -PI { PI } else { phase },
            }
        })
        .collect())
}

/// Mesh cycles of a record whose ends are weighed down, at the least, for its orders to be told from each other.
const TOLD_APART: f64 = 4.0;

/// Amplitudes of the mesh orders 1, 2, ... that the samples resolve, evenly spaced over a number of mesh cycles. For
/// whole cycles that are periodic or few they are those of [`mesh_harmonics`]; otherwise a Hann window is used. Empty
/// for fewer than four cycles that are not whole.
///
/// # Errors
/// The errors of [`crate::cycle_statistics`] and [`crate::order_amplitude`].
pub fn order_amplitudes(samples: &[f64], cycles: f64, comes_back: bool) -> Result<Vec<f64>, StudyError> {
    let (per_cycle, whole) = (samples.len() as f64 / cycles, cycles.round());
    let (orders, short) = (per_cycle as usize / 2, cycles < TOLD_APART);
    let even = cycles == whole && samples.len().is_multiple_of(whole.max(1.0) as usize);
    if even && (comes_back || short) {
        return Ok(mesh_harmonics(samples, whole as usize, orders)?.iter().map(|h| h.amplitude).collect());
    }
    if short {
        return Ok(Vec::new());
    }
    let places: Vec<f64> = (0..samples.len()).map(|i| i as f64 / per_cycle).collect();
    (1..=orders).map(|order| order_amplitude(samples, &places, order as f64)).collect()
}

/// Share of a record's vibration in the upper half of its resolved frequencies, between a quarter and half of the
/// sampling rate. If amplitudes decrease slowly, the part beyond the resolved range is of similar size.
///
/// ```text
/// share = sqrt(sum_{n/4 < k <= n/2} |X_k|^2 / sum_{0 < k <= n/2} |X_k|^2)
/// ```
/// It is 0 for a smooth, finely sampled record, near 0.7 for noise, and 0 for a constant record. `samples` are evenly
/// spaced over `cycles` whole mesh cycles; a Hann window is used if the record is not periodic.
///
/// # Errors
/// The errors of [`crate::cycle_statistics`].
pub fn unresolved_share(samples: &[f64], cycles: usize, comes_back: bool) -> Result<f64, StudyError> {
    check(samples, cycles)?;
    let n = samples.len();
    let weighed = || {
        // The jump from the end to the beginning is no vibration.
        let mean = samples.iter().sum::<f64>() / n as f64;
        let weight = |i: usize| Window::Hann.at((i as f64 + 0.5) / n as f64);
        samples.iter().enumerate().map(|(i, x)| weight(i) * (x - mean)).collect()
    };
    let record = if comes_back { samples.to_vec() } else { weighed() };
    let spectrum = real_transform(record).ok_or(StudyError::NotWholeCycles { samples: n, cycles })?;
    let power = |range: std::ops::Range<usize>| spectrum[range].iter().map(|x| x.norm_sqr()).sum::<f64>();
    let (all, upper) = (power(1..spectrum.len()), power((n / 4 + 1).min(spectrum.len())..spectrum.len()));
    let level = spectrum[0].norm_sqr();
    // Round-off of a record that stands still is no vibration.
    Ok(if all > 1e-24 * level { (upper / all).sqrt() } else { 0.0 })
}
