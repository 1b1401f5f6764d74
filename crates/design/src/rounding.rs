//! The best values among those that a machine can be set to.

use crate::{Bounds, Evaluation, Goal};

/// Parameters of which both neighbours are tried in all combinations; more are rounded one after the other.
const TOGETHER: usize = 10;

/// The values that are whole multiples of `grains` (0: any value) next to `values` and within bounds, for which the goal
/// is least and limits are held, all to first order.
pub fn rounded(values: &[f64], grains: &[f64], bounds: &[Bounds], evaluation: &Evaluation, goal: &Goal) -> Vec<f64> {
    let neighbours = |k: usize| -> Vec<f64> {
        let (x, grain) = (values[k], grains[k]);
        if grain <= 0.0 {
            return vec![x];
        }
        let both = [(x / grain).floor() * grain, (x / grain).ceil() * grain];
        let mut fine: Vec<f64> = both.into_iter().filter(|v| *v >= bounds[k][0] && *v <= bounds[k][1]).collect();
        fine.dedup();
        if fine.is_empty() { vec![x] } else { fine }
    };
    let choices: Vec<Vec<f64>> = (0..values.len()).map(neighbours).collect();
    let price = |chosen: &[f64]| {
        let change: Vec<f64> = chosen.iter().zip(values).map(|(c, x)| c - x).collect();
        let over = evaluation.limited.iter().map(|l| {
            let moved: f64 = l.rates.iter().zip(&change).map(|(r, d)| r * d).sum();
            ((l.value + moved) / l.limit - 1.0).max(0.0)
        });
        goal.value_after(&evaluation.curves, &change) * (1.0 + 1e3 * over.fold(0.0, f64::max))
    };
    let mut best: Vec<f64> = choices.iter().zip(values).map(|(c, x)| nearest(c, *x)).collect();
    let open: Vec<usize> = (0..values.len()).filter(|&k| choices[k].len() > 1).collect();
    for together in open.chunks(TOGETHER) {
        let mut least = price(&best);
        for mask in 0..1usize << together.len() {
            let mut tried = best.clone();
            for (bit, &k) in together.iter().enumerate() {
                tried[k] = choices[k][mask >> bit & 1];
            }
            let cost = price(&tried);
            if cost < least {
                (least, best) = (cost, tried);
            }
        }
    }
    best
}

fn nearest(choices: &[f64], x: f64) -> f64 {
    choices.iter().copied().min_by(|a, b| (a - x).abs().total_cmp(&(b - x).abs())).unwrap_or(x)
}
