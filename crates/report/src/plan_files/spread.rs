//! How a number is spread over cases.

use serde::Serialize;
use study::{extent, mean, root_mean_square};

/// Quantiles that are told of every number.
pub(super) const QUANTILES: [f64; 3] = [0.1, 0.5, 0.9];
/// Standard deviations either way of a mean that hold 95 % of a normal distribution.
const NORMAL_95: f64 = 1.959_963_984_540_054;

described::described! {
    /// Spread of a number over the cases that have it; intervals are `null` where there are too few cases.
    #[derive(Serialize)]
    pub(super) struct SpreadSummary {
        /// mean
        mean: Option<f64>,
        /// half width of the interval about the mean that holds the true one in 95 % of random samples
        mean_within_95: Option<f64>,
        /// standard deviation
        standard_deviation: Option<f64>,
        /// smallest value
        least: Option<f64>,
        /// case with the smallest value
        least_case: Option<usize>,
        /// largest value
        largest: Option<f64>,
        /// 10 % quantile
        quantile_10: Option<f64>,
        /// median
        median: Option<f64>,
        /// 90 % quantile
        quantile_90: Option<f64>,
        /// interval that holds the 10 % quantile in 95 % of random samples, by order statistics
        quantile_10_95: Option<[f64; 2]>,
        /// interval that holds the median in 95 % of random samples, by order statistics
        median_95: Option<[f64; 2]>,
        /// interval that holds the 90 % quantile in 95 % of random samples, by order statistics
        quantile_90_95: Option<[f64; 2]>,
    }
}

/// How a number is spread over the cases that have it.
pub(super) struct Spread {
    /// Ascending.
    values: Vec<f64>,
}

impl Spread {
    /// Spread of the finite ones among some values.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.into_iter().filter(|x| x.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        Self { values }
    }

    /// Between neighbours in proportion (type 7 of R. Hyndman, Y. Fan, Am. Stat. 50 (1996) 361).
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let at = share * self.values.len().checked_sub(1)? as f64;
        let (low, high) = (at.floor() as usize, at.ceil() as usize);
        Some(self.values[low] + (at - low as f64) * (self.values[high] - self.values[low]))
    }

    /// Values between which a quantile lies in 95 % of random samples: order statistics by the binomial distribution,
    /// normal in the limit; `None` where there are too few.
    fn interval(&self, share: f64) -> Option<[f64; 2]> {
        let n = self.values.len() as f64;
        let (middle, half) = (share * n, NORMAL_95 * (share * (1.0 - share) * n).sqrt());
        let (low, high) = ((middle - half).floor(), (middle + half).ceil());
        // Rank r counts from 1; the r-th value is at least as large as the quantile's lower end.
        (low >= 1.0 && high <= n).then(|| [self.values[low as usize - 1], self.values[high as usize - 1]])
    }

    /// Mean, deviation and quantiles; `least_case`: the case that has the smallest value.
    pub fn summary(&self, least_case: Option<usize>) -> SpreadSummary {
        let known = |x: f64| Some(x).filter(|x| x.is_finite());
        let [least, largest] = extent(&self.values).map(known);
        SpreadSummary {
            mean: known(mean(&self.values)),
            mean_within_95: known(NORMAL_95 * root_mean_square(&self.values) / (self.values.len() as f64).sqrt()),
            standard_deviation: known(root_mean_square(&self.values)),
            least,
            least_case,
            largest,
            quantile_10: self.quantile(QUANTILES[0]),
            median: self.quantile(QUANTILES[1]),
            quantile_90: self.quantile(QUANTILES[2]),
            quantile_10_95: self.interval(QUANTILES[0]),
            median_95: self.interval(QUANTILES[1]),
            quantile_90_95: self.interval(QUANTILES[2]),
        }
    }
}
