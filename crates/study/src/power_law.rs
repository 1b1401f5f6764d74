//! Scaling exponents: a power law fitted to measured costs.

use crate::StudyError;

/// The fitted law `y = factor * x^exponent`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Exponent.
    pub exponent: f64,
    /// y at x = 1, in the unit of y.
    pub factor: f64,
    /// Largest |ln(y / fit)|: 0.1 means that every point is within about 10 % of the fit.
    pub largest_residual: f64,
}

/// Least-squares fit through (ln x, ln y).
///
/// # Errors
/// [`StudyError::NoPowerLaw`] for fewer than two different x, or for a value that is not finite and above 0.
///
/// # Example
/// ```
/// let law = study::power_law(&[(1.0, 2.0), (2.0, 8.0), (4.0, 32.0)])?;
/// assert!((law.exponent - 2.0).abs() < 1e-14 && (law.factor - 2.0).abs() < 1e-14);
/// # Ok::<(), study::StudyError>(())
/// ```
pub fn power_law(points: &[(f64, f64)]) -> Result<PowerLaw, StudyError> {
    let fine = |v: f64| v.is_finite() && v > 0.0;
    let none = StudyError::NoPowerLaw { points: points.len() };
    if points.len() < 2 || !points.iter().all(|&(x, y)| fine(x) && fine(y)) {
        return Err(none);
    }
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| logs.iter().map(pick).sum::<f64>() / n;
    let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
    let sxx: f64 = logs.iter().map(|(x, _)| (x - mx).powi(2)).sum();
    if sxx <= 1e-24 * (1.0 + mx * mx) * n {
        return Err(none);
    }
    let exponent = logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>() / sxx;
    let height = my - exponent * mx;
    let residual = |(x, y): &(f64, f64)| (y - height - exponent * x).abs();
    let largest_residual = logs.iter().map(residual).fold(0.0, f64::max);
    Ok(PowerLaw { exponent, factor: height.exp(), largest_residual })
}
