//! Amplitude of an order over a section of a motion whose speed may change.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use crate::{StudyError, Window, error::check};

/// Amplitude of the component that repeats `order` times while `places` increase by one; single-sided, in the unit of
/// the samples.
///
/// ```text
/// A = 2 |sum_j w_j d_j (x_j - mean) exp(-2 pi i order c_j)| / sum_j w_j d_j,   d_j = (c_(j+1) - c_(j-1))/2
/// ```
/// c are the places (mesh cycles or rotations, strictly ascending or descending), evenly spaced or not; w is a Hann
/// window over the section. Lines closer than two divided by the length of the section are not resolved, and the mean
/// affects the lowest two orders. Exact for evenly spaced places; between uneven ones the trapezoidal rule is used.
///
/// # Errors
/// [`StudyError::TooFewSamples`] for fewer than 8 samples and for lists of different lengths,
/// [`StudyError::NotFinite`].
pub fn order_amplitude(samples: &[f64], places: &[f64], order: f64) -> Result<f64, StudyError> {
    let n = samples.len();
    if n < 8 {
        return Err(StudyError::TooFewSamples { samples: n, least: 8 });
    }
    if places.len() != n {
        return Err(StudyError::TooFewSamples { samples: places.len(), least: n });
    }
    check(samples, 1)?;
    check(places, 1)?;
    let (first, last) = (places[0], places[n - 1]);
    // A period begins where the one before it ended: the window reaches half a sample beyond either end.
    let margin = 0.5 * (last - first) / (n - 1) as f64;
    let length = last - first + 2.0 * margin;
    let edge = |j: usize| match j {
        0 => first - margin,
        j if j == n => last + margin,
        j => 0.5 * (places[j - 1] + places[j]),
    };
    let weight = |j: usize| Window::Hann.at((places[j] - first + margin) / length) * (edge(j + 1) - edge(j));
    let weights: Vec<f64> = (0..n).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    let mean = samples.iter().zip(&weights).map(|(x, w)| x * w).sum::<f64>() / sum;
    let [re, im] = samples.iter().zip(&weights).zip(places).fold([0.0; 2], |[re, im], ((x, w), c)| {
        let (sin, cos) = (TAU * order * (c - first)).sin_cos();
        [re + w * (x - mean) * cos, im - w * (x - mean) * sin]
    });
    Ok(2.0 * re.hypot(im) / sum.abs())
}

/// A resonance in the amplitude of an order over speed (order cut).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CutPeak {
    /// Index of the largest amplitude.
    pub at: usize,
    /// Number of consecutive points around it with at least half of its power.
    pub points: usize,
}

/// The largest amplitude of an order cut and the number of points across its peak. `None` if the cut does not fall to
/// half of that power on both sides, so that it does not contain the whole peak.
pub fn cut_peak(amplitudes: &[f64]) -> Option<CutPeak> {
    let at = (0..amplitudes.len()).max_by(|&a, &b| amplitudes[a].total_cmp(&amplitudes[b]))?;
    let below = |x: &f64| *x < FRAC_1_SQRT_2 * amplitudes[at];
    let first = amplitudes[..at].iter().rposition(below)?;
    let last = at + amplitudes[at..].iter().position(below)?;
    Some(CutPeak { at, points: last - first - 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A resonance of 2 % damping in a cut whose points are 1/256 of its frequency apart has 4 % of it across: ten points.
    /// A flank alone, and a level, are no peak.
    #[test]
    fn points_across_a_peak_are_those_of_half_its_power() {
        let gain = |r: f64| ((1.0 - r * r).powi(2) + (0.04 * r).powi(2)).sqrt().recip();
        let cut: Vec<f64> = (128..512).map(|i| gain(f64::from(i) / 256.0)).collect();
        let CutPeak { at, points } = cut_peak(&cut).unwrap();
        assert!((127..=128).contains(&at) && (10..=11).contains(&points), "{points} points about {at}");
        assert_eq!(cut_peak(&cut[..129]), None, "a flank is no peak");
        assert_eq!(cut_peak(&[1.0; 20]), None, "a level is no peak");
        assert_eq!(cut_peak(&[]), None);
    }

    /// Lines of a run-up: places that go faster and faster, two orders and a mean, each read to a ten-thousandth.
    #[test]
    fn lines_of_a_run_up_are_told_apart() {
        let place = |j: usize| {
            let t = j as f64 / 1500.0;
            10.0 * t + 8.0 * t * t
        };
        let places: Vec<f64> = (0..1500).map(place).collect();
        let wave = |c: &f64| 7.0 + 2.0 * (TAU * c + 0.3).sin() + 0.5 * (TAU * 2.4 * c).cos();
        let samples: Vec<f64> = places.iter().map(wave).collect();
        for (order, wanted) in [(1.0, 2.0), (2.4, 0.5)] {
            let found = order_amplitude(&samples, &places, order).unwrap();
            assert!((found - wanted).abs() < 5e-3 * wanted, "order {order}: {found} beside {wanted}");
        }
        let nothing = order_amplitude(&samples, &places, 3.7).unwrap();
        assert!(nothing < 1e-3, "{nothing} where there is no line");
        let backwards: Vec<f64> = places.iter().map(|c| -c).collect();
        let found = order_amplitude(&samples, &backwards, 1.0).unwrap();
        assert!((found - 2.0).abs() < 1e-2, "{found}: a shaft that turns backwards has the same orders");
    }

    /// Evenly spaced over whole periods the answer is exact.
    #[test]
    fn whole_periods_are_exact() {
        let places: Vec<f64> = (0..256).map(|j| f64::from(j) / 32.0).collect();
        let samples: Vec<f64> = places.iter().map(|c| 3.0 + 0.25 * (TAU * c - 1.0).cos()).collect();
        let found = order_amplitude(&samples, &places, 1.0).unwrap();
        assert!((found / 0.25 - 1.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn what_is_no_record_is_refused() {
        assert!(order_amplitude(&[0.0; 7], &[0.0; 7], 1.0).is_err());
        assert!(order_amplitude(&[0.0; 9], &[0.0; 8], 1.0).is_err());
        assert!(order_amplitude(&[f64::NAN; 9], &[0.0; 9], 1.0).is_err());
    }
}
