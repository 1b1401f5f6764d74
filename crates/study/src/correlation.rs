//! Correlation of two histories.

use crate::error::StudyError;

/// A spread below this share of the largest sample is round-off.
const ROUND_OFF: f64 = 1e-13;

/// Pearson's correlation coefficient of two histories with the same samples.
///
/// ```text
/// r = sum (a - mean a)(b - mean b) / sqrt( sum (a - mean a)^2 sum (b - mean b)^2 )
/// ```
///
/// It is 1 if b is a linear function of a with positive slope, -1 with negative slope, 0 without linear relation. It
/// does not depend on units, factors or offsets. It measures correlation without delay: for a sine and a cosine it is
/// 0. Source: Pearson, Proc. R. Soc. 58 (1895), p. 240.
///
/// `None` if one of them does not vary (its spread is only round-off of its magnitude).
///
/// # Errors
/// [`StudyError::Lengths`] if they have different lengths, [`StudyError::TooFewSamples`] for fewer than two samples,
/// [`StudyError::NotFinite`] if a sample is not a finite number.
///
/// # Example
/// ```
/// let r = study::correlation(&[1.0, 2.0, 3.0, 4.0], &[8.0, 6.0, 4.0, 2.0])?;
/// assert!((r.unwrap() + 1.0).abs() < 1e-15);
/// # Ok::<(), study::StudyError>(())
/// ```
pub fn correlation(a: &[f64], b: &[f64]) -> Result<Option<f64>, StudyError> {
    if a.len() != b.len() {
        return Err(StudyError::Lengths { found: b.len(), wanted: a.len() });
    }
    if a.len() < 2 {
        return Err(StudyError::TooFewSamples { samples: a.len(), least: 2 });
    }
    for all in [a, b] {
        if let Some((index, &value)) = all.iter().enumerate().find(|(_, x)| !x.is_finite()) {
            return Err(StudyError::NotFinite { index, value });
        }
    }
    let (Some(a), Some(b)) = (unit_deviation(a), unit_deviation(b)) else { return Ok(None) };
    let product: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
    Ok(Some(product.clamp(-1.0, 1.0)))
}

/// Deviations from the mean, of length 1 as a vector; `None` without any.
fn unit_deviation(all: &[f64]) -> Option<Vec<f64>> {
    // In terms of the largest sample first, so that squares neither overflow nor vanish.
    let largest = all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 {
        return None;
    }
    let mean = all.iter().map(|x| x / largest).sum::<f64>() / all.len() as f64;
    let mut off: Vec<f64> = all.iter().map(|x| x / largest - mean).collect();
    let length = off.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length <= ROUND_OFF * (all.len() as f64).sqrt() {
        return None;
    }
    off.iter_mut().for_each(|x| *x /= length);
    Some(off)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(f: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..64).map(|i| f(std::f64::consts::TAU * f64::from(i) / 64.0)).collect()
    }

    /// A shift or a factor of either changes nothing but the sign.
    #[test]
    fn straight_lines_of_each_other_are_one() {
        let a = of(|x| x.sin() + 0.3 * (3.0 * x).cos());
        for (factor, shift) in [(1.0, 0.0), (1e-9, 5.0), (-1e200, 1e201), (3.0, -1e3)] {
            let b: Vec<f64> = a.iter().map(|x| factor * x + shift).collect();
            let r = correlation(&a, &b).unwrap().unwrap();
            assert!((r - f64::signum(factor)).abs() < 1e-6, "{factor} a + {shift}: r = {r}");
        }
    }

    #[test]
    fn quadrature_and_other_orders_are_none() {
        for b in [of(f64::cos), of(|x| (2.0 * x).sin())] {
            let r = correlation(&of(f64::sin), &b).unwrap().unwrap();
            assert!(r.abs() < 1e-14, "r = {r:e}");
        }
    }

    #[test]
    fn what_does_not_vary_is_followed_by_nothing() {
        assert_eq!(correlation(&[0.1; 7], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]), Ok(None));
        assert_eq!(correlation(&[0.0; 2], &[0.0; 2]), Ok(None));
    }

    #[test]
    fn what_cannot_be_compared_is_refused() {
        assert_eq!(correlation(&[1.0], &[1.0, 2.0]), Err(StudyError::Lengths { found: 2, wanted: 1 }));
        assert_eq!(correlation(&[1.0], &[1.0]), Err(StudyError::TooFewSamples { samples: 1, least: 2 }));
        assert!(matches!(correlation(&[1.0, f64::NAN], &[1.0, 2.0]), Err(StudyError::NotFinite { index: 1, .. })));
    }
}
