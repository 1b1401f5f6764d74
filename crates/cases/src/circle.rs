//! Deviations around a circle, as those of the teeth of a gear: what lies between neighbours scatters, and all of it
//! closes.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;

use crate::Distribution;

/// Share of the largest step that the standard deviation of a step is.
const SPREAD: f64 = 1.0 / 3.0;

/// Deviations of `count` places around a circle from where they should be, mean 0, in the unit of the limits.
///
/// ```text
/// e_i = e_(i-1) + f_i,   f_i normal about 0 with a third of `step`, less their mean, so that they sum to 0
/// ```
/// No `f_i` is beyond `step`, and no two places differ by more than `range`: where they would, all deviations are made
/// smaller alike. `draw` (0 .. 1, from a sampling) says which circle it is: the same for the same on every machine.
pub fn around_a_circle(draw: f64, count: u32, [step, range]: [f64; 2]) -> Vec<f64> {
    let mut random = ChaCha12Rng::seed_from_u64(draw.to_bits());
    let between = Distribution::Normal { mean: 0.0, deviation: SPREAD * step, least: -step, largest: step };
    let steps: Vec<f64> = (0..count).map(|_| between.quantile(random.random())).collect();
    let mean = steps.iter().sum::<f64>() / f64::from(count);
    let mut at = 0.0;
    let mut places: Vec<f64> = Vec::with_capacity(steps.len());
    for own in &steps {
        at += own - mean;
        places.push(at);
    }
    let largest = steps.iter().map(|own| (own - mean).abs()).fold(0.0, f64::max);
    let shrink = [step / largest, range / spread(&places)].into_iter().fold(1.0, f64::min);
    let middle = places.iter().sum::<f64>() / f64::from(count);
    places.iter().map(|place| shrink * (place - middle)).collect()
}

/// Largest less smallest of some values; 0 of none.
pub fn spread(values: &[f64]) -> f64 {
    let ends = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &v| [a.min(v), b.max(v)]);
    (ends[1] - ends[0]).max(0.0)
}
