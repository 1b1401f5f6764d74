//! Mean and peak to peak over a mesh cycle.

use serde::Serialize;

use crate::error::{StudyError, check};

/// Mean and extent of a history over whole mesh cycles, in the unit of its samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CycleStatistics {
    /// Arithmetic mean of all samples. This is the trapezoidal rule over a period, which is exact for every harmonic
    /// below the number of samples per cycle.
    pub mean: f64,
    /// Smallest sample.
    pub min: f64,
    /// Largest sample.
    pub max: f64,
    /// Mean over the cycles of (largest - smallest sample of that cycle).
    ///
    /// It refers to the samples. Between them a harmonic of order h can be larger by up to its amplitude times `1 -
    /// cos(pi h / samples_per_cycle)`, and a kink by more.
    pub peak_to_peak: f64,
    /// Number of samples per cycle, needed to judge `peak_to_peak`.
    pub samples_per_cycle: usize,
    /// Number of whole cycles in the history.
    pub cycles: usize,
}

/// Statistics of `samples`, evenly spaced over `cycles` whole mesh cycles without the end point.
///
/// # Errors
/// [`StudyError::NotWholeCycles`] if the number of samples is not a multiple of the number of cycles,
/// [`StudyError::NotFinite`] if a sample is not a finite number.
///
/// # Example
/// ```
/// let s = study::cycle_statistics(&[1.0, 3.0, 1.0, 5.0], 2)?;
/// assert_eq!((s.mean, s.peak_to_peak, s.samples_per_cycle), (2.5, 3.0, 2));
/// # Ok::<(), study::StudyError>(())
/// ```
pub fn cycle_statistics(samples: &[f64], cycles: usize) -> Result<CycleStatistics, StudyError> {
    let samples_per_cycle = check(samples, cycles)?;
    let extent =
        |part: &[f64]| part.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &v| (lo.min(v), hi.max(v)));
    let (min, max) = extent(samples);
    let each = samples.chunks_exact(samples_per_cycle).map(|cycle| {
        let (lo, hi) = extent(cycle);
        hi - lo
    });
    Ok(CycleStatistics {
        mean: samples.iter().sum::<f64>() / samples.len() as f64,
        min,
        max,
        peak_to_peak: each.sum::<f64>() / cycles as f64,
        samples_per_cycle,
        cycles,
    })
}
