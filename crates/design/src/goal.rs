//! Curves and limited numbers with their derivatives, and what of the curves shall be small.

use std::f64::consts::TAU;

use serde::Serialize;

/// A curve over one cycle at equal steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Which sample of what scatters it belongs to, from 0.
    pub sample: usize,
    /// Weight beside the other curves of its sample, above 0.
    pub weight: f64,
    /// Values.
    pub values: Vec<f64>,
    /// Derivatives of each value by each parameter.
    pub rates: Vec<Vec<f64>>,
}

/// A number that shall not be larger than its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Limited {
    /// The number.
    pub value: f64,
    /// Derivatives of the number by each parameter.
    pub rates: Vec<f64>,
    /// The limit, above 0.
    pub limit: f64,
}

/// All that is known at some values of the parameters.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Evaluation {
    /// Curves, sample by sample.
    pub curves: Vec<Curve>,
    /// Limited numbers.
    pub limited: Vec<Limited>,
}

/// What of a curve shall be small.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Largest less smallest value; the weighted mean over the curves of a sample.
    PeakToPeak,
    /// Root of the mean square of the values less their mean, over all curves of a sample.
    Rms,
    /// Root of the mean square of some harmonics of the cycle together, 1 ...
    Harmonics(Vec<u32>),
}

/// How samples count.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Over {
    /// All alike.
    Mean,
    /// The mean of the worst ones beyond this share, 0 .. 1: never less than the quantile itself.
    WorstBeyond(f64),
}

/// What shall be small.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Goal {
    /// Measure of each sample.
    pub measure: Measure,
    /// Over the samples.
    pub over: Over,
}

/// What a measure is the root of the mean square of: a linear map of the values, scaled so that the sum of squares is
/// the mean square.
pub(crate) fn residuals(measure: &Measure, values: &[f64]) -> Vec<f64> {
    let n = values.len() as f64;
    match measure {
        Measure::PeakToPeak | Measure::Rms => {
            let mean = values.iter().sum::<f64>() / n;
            values.iter().map(|v| (v - mean) / n.sqrt()).collect()
        }
        Measure::Harmonics(orders) => {
            let part = |order: u32, shift: f64| {
                let wave = |i: usize| (TAU * f64::from(order) * i as f64 / n + shift).cos();
                // A wave of amplitude A has the mean square A^2 / 2.
                values.iter().enumerate().map(|(i, v)| v * wave(i)).sum::<f64>() * 2.0 / n * 0.5_f64.sqrt()
            };
            orders.iter().flat_map(|&order| [part(order, 0.0), part(order, -0.25 * TAU)]).collect()
        }
    }
}

fn peak_to_peak(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
}

impl Curve {
    /// Values after a change of the parameters, to first order.
    pub(crate) fn after<'a>(&'a self, change: &'a [f64]) -> impl Iterator<Item = f64> + Clone + 'a {
        let by = move |rates: &Vec<f64>| rates.iter().zip(change).map(|(r, d)| r * d).sum::<f64>();
        self.values.iter().zip(&self.rates).map(move |(v, rates)| v + by(rates))
    }
}

impl Goal {
    /// The measure of each sample, in their order.
    pub fn of_samples(&self, curves: &[Curve]) -> Vec<f64> {
        let change: Vec<f64> = vec![0.0; curves.first().and_then(|c| c.rates.first()).map_or(0, Vec::len)];
        self.of_samples_after(curves, &change)
    }

    /// Value of each sample after a change of the parameters, to first order.
    pub(crate) fn of_samples_after(&self, curves: &[Curve], change: &[f64]) -> Vec<f64> {
        let of_sample = |own: &[Curve]| {
            let weights: f64 = own.iter().map(|c| c.weight).sum();
            let of_curve = |curve: &Curve| match self.measure {
                Measure::PeakToPeak => peak_to_peak(curve.after(change)),
                _ => {
                    let values: Vec<f64> = curve.after(change).collect();
                    residuals(&self.measure, &values).iter().map(|r| r * r).sum()
                }
            };
            let mean = own.iter().map(|c| c.weight * of_curve(c)).sum::<f64>() / weights;
            if self.measure == Measure::PeakToPeak { mean } else { mean.sqrt() }
        };
        curves.chunk_by(|a, b| a.sample == b.sample).map(of_sample).collect()
    }

    /// What shall be small.
    pub fn value(&self, curves: &[Curve]) -> f64 {
        self.over_samples(self.of_samples(curves))
    }

    /// Value of the goal after a change of the parameters, to first order.
    pub fn value_after(&self, curves: &[Curve], change: &[f64]) -> f64 {
        self.over_samples(self.of_samples_after(curves, change))
    }

    fn over_samples(&self, mut of_samples: Vec<f64>) -> f64 {
        match (self.over, &self.measure) {
            (Over::Mean, Measure::PeakToPeak) => of_samples.iter().sum::<f64>() / of_samples.len() as f64,
            (Over::Mean, _) => (of_samples.iter().map(|v| v * v).sum::<f64>() / of_samples.len() as f64).sqrt(),
            (Over::WorstBeyond(share), _) => {
                of_samples.sort_unstable_by(|a, b| b.total_cmp(a));
                let count = ((1.0 - share) * of_samples.len() as f64).max(1.0);
                let whole = (count as usize).min(of_samples.len());
                let part = of_samples.get(whole).map_or(0.0, |v| (count - whole as f64) * v);
                (of_samples[..whole].iter().sum::<f64>() + part) / count
            }
        }
    }
}

impl Evaluation {
    /// Largest share by which a limited number is over its limit; 0 where none is.
    pub fn over_limits(&self) -> f64 {
        self.limited.iter().map(|l| l.value / l.limit - 1.0).fold(0.0, f64::max)
    }
}
