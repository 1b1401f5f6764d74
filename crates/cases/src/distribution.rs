//! Distributions of what is drawn, by their quantiles.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

/// How a value is distributed, in its own unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Distribution {
    /// Alike everywhere between two ends.
    Uniform {
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// Logarithm of the value alike everywhere between two ends above 0.
    LogUniform {
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// Normal, between two limits: what lies beyond is drawn again. Infinite limits are none.
    Normal {
        /// Mean before limits.
        mean: f64,
        /// Standard deviation before limits, > 0.
        deviation: f64,
        /// Lower limit.
        least: f64,
        /// Upper limit.
        largest: f64,
    },
}

impl Distribution {
    /// What keeps it from being one.
    pub fn fault(&self) -> Option<&'static str> {
        let finite = |values: &[f64]| values.iter().all(|x| x.is_finite());
        match *self {
            Self::Uniform { from, to } if !finite(&[from, to]) || from >= to => Some("`from` lies below `to`"),
            Self::LogUniform { from, to } if !finite(&[from, to]) || from >= to || from <= 0.0 => {
                Some("on a logarithmic scale `from` lies above 0 and below `to`")
            }
            Self::Normal { mean, deviation, .. } if !finite(&[mean, deviation]) || deviation <= 0.0 => {
                Some("a standard deviation is above 0")
            }
            Self::Normal { least, largest, .. } if least.is_nan() || largest.is_nan() || least >= largest => {
                Some("`least` lies below `largest`")
            }
            Self::Normal { mean, deviation, least, largest } => {
                let shares = within(mean, deviation, [least, largest]);
                (shares[1] - shares[0] < LEAST_SHARE).then_some("hardly anything of it lies within its limits")
            }
            _ => None,
        }
    }

    /// The value below which a share `p` (0 .. 1) of all lies.
    ///
    /// ```
    /// use cases::Distribution;
    /// let normal = Distribution::Normal { mean: 5.0, deviation: 2.0, least: f64::NEG_INFINITY, largest: f64::INFINITY };
    /// assert!((normal.quantile(0.5) - 5.0).abs() < 1e-12 && (normal.quantile(0.841_344_746_068_543) - 7.0).abs() < 1e-9);
    /// assert_eq!(Distribution::Uniform { from: -1.0, to: 3.0 }.quantile(0.25), 0.0);
    /// ```
    pub fn quantile(&self, p: f64) -> f64 {
        match *self {
            Self::Uniform { from, to } => from + (to - from) * p,
            Self::LogUniform { from, to } => from * (to / from).powf(p),
            Self::Normal { mean, deviation, least, largest } => {
                let [low, high] = within(mean, deviation, [least, largest]);
                // Open ends: no sample lies at infinity.
                let share = (low + (high - low) * p).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON);
                (mean + deviation * standard().inverse_cdf(share)).clamp(least, largest)
            }
        }
    }
}

/// Share of a normal distribution that must lie within its limits: with less its tail has no digits.
const LEAST_SHARE: f64 = 1e-6;

fn standard() -> Normal {
    Normal::standard()
}

/// Shares of a normal distribution below two limits.
fn within(mean: f64, deviation: f64, limits: [f64; 2]) -> [f64; 2] {
    limits.map(|x| if x.is_infinite() { f64::from(x > 0.0) } else { standard().cdf((x - mean) / deviation) })
}
