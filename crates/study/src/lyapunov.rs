//! Largest Lyapunov exponent, which distinguishes chaos.

use serde::Serialize;

/// Options of the search for an exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LyapunovPlan {
    /// Duration of one section of the motion (one period of the excitation, or about one of the motion).
    pub stretch: f64,
    /// Number of sections before counting begins: for the transient, and for the difference to align with its direction
    /// of fastest growth.
    pub settling: usize,
    /// Number of sections that count.
    pub stretches: usize,
    /// Distance to which the neighbouring motion is reset after each section, in units of `scale`. 1e-7 is far above
    /// round-off and small enough for linear growth.
    pub distance: f64,
}

described::described! {
    /// Largest Lyapunov exponent and its uncertainty.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct Lyapunov {
        /// mean rate of growth of a small difference, 1/s: above 0 chaos, 0 a quasi-periodic motion (or a free shift in time), below 0 a motion that repeats itself
        pub exponent: f64,
        /// standard error of the exponent from ten parts of the integration, 1/s
        pub error: f64,
    }
}

impl Lyapunov {
    /// Exponent from growth rates ln(d_1 / d_0) / T of each section: their mean, and its standard error from ten parts.
    pub fn of_rates(rates: &[f64]) -> Self {
        let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len().max(1) as f64;
        let exponent = mean(rates);
        let size = (rates.len() / 10).max(1);
        let parts: Vec<f64> = rates.chunks_exact(size).map(mean).collect();
        let count = parts.len() as f64;
        let variance = parts.iter().map(|p| (p - exponent).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
        Self { exponent, error: (variance / count.max(1.0)).sqrt() }
    }

    /// Whether the exponent is positive by more than three standard errors.
    pub fn is_chaotic(&self) -> bool {
        self.exponent > 3.0 * self.error
    }
}

/// Largest exponent of a motion from two neighbouring motions whose distance is reset after every section (Benettin,
/// Galgani, Giorgilli, Strelcyn, Meccanica 15 (1980) 9).
///
/// ```text
/// lambda = 1 / (m T) sum ln(d_k / d_0)
/// ```
/// `advance(x, k)` carries a state x from k T to (k + 1) T; `scale` is the magnitude of each entry that counts as
/// large, > 0. The method works for flows, maps and motions with kinks, because it needs no tangent. If the difference
/// becomes zero within one section, it counts as the smallest positive number.
///
/// # Errors
/// The errors of `advance`.
pub fn largest_lyapunov<E>(
    start: &[f64],
    scale: &[f64],
    plan: &LyapunovPlan,
    mut advance: impl FnMut(&[f64], usize) -> Result<Vec<f64>, E>,
) -> Result<Lyapunov, E> {
    let n = start.len().max(1) as f64;
    let mut x = start.to_vec();
    // In no special direction.
    let mut y: Vec<f64> = x.iter().zip(scale).map(|(x, s)| x + plan.distance * s / n.sqrt()).collect();
    let mut growth = Vec::with_capacity(plan.stretches);
    for k in 0..plan.settling + plan.stretches {
        x = advance(&x, k)?;
        y = advance(&y, k)?;
        let apart =
            |y: &[f64]| y.iter().zip(&x).zip(scale).map(|((y, x), s)| ((y - x) / s).powi(2)).sum::<f64>().sqrt();
        let distance = apart(&y);
        if distance > 0.0 {
            let share = plan.distance / distance;
            y = y.iter().zip(&x).map(|(y, x)| x + share * (y - x)).collect();
        } else {
            y = x.iter().zip(scale).map(|(x, s)| x + plan.distance * s / n.sqrt()).collect();
        }
        if k >= plan.settling {
            growth.push((distance.max(f64::MIN_POSITIVE) / plan.distance).ln() / plan.stretch);
        }
    }
    Ok(Lyapunov::of_rates(&growth))
}
