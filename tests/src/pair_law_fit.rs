//! Laws of errors that go with features of a pair, fitted to measured cases: theory (64).

use analysis::accuracy::{FEATURES, Features, PairLaw, Seen, logarithm};
use nalgebra::{DMatrix, DVector};

/// What was known of a run, what was seen, and what its error was.
#[derive(Debug, Clone)]
pub struct PairCase {
    pub features: Features,
    pub seen: Seen,
    pub error: f64,
    pub scale: f64,
}

/// What of an error can be known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// A mean that goes with the features.
    Features,
    /// A share of what the shape of a curve adds.
    Shape,
}

/// A law, and what the others' law says of each case: known part and bound.
#[derive(Debug, Clone)]
pub struct Fitted {
    pub law: PairLaw,
    pub held_out: Vec<[f64; 2]>,
}

/// Cases that take no part, in turn.
const FOLDS: usize = 8;
/// Weight of small coefficients, over that of one case.
const RIDGE: f64 = 4.0;
/// Error over the scale that counts as none.
const LEAST_ERROR: f64 = 1e-6;
/// Share of the cases that lies within a single bound.
const TERM_COVERAGE: f64 = 0.9;
/// Share of the cases that the spread lies above: bounds are of large errors, and small ones are small by chance.
const QUANTILE: f64 = 0.8;
/// Rounds of the search for that quantile, and the distance from it below which cases count alike.
const ROUNDS: usize = 25;
const NEAR: f64 = 0.05;

/// The law that holds for nine in ten cases when it is made without them.
pub fn fit(cases: &[PairCase], known: Known) -> Fitted {
    let mut held_out = vec![[0.0; 2]; cases.len()];
    for fold in 0..FOLDS {
        let others: Vec<PairCase> =
            cases.iter().enumerate().filter(|(i, _)| i % FOLDS != fold).map(|(_, c)| c.clone()).collect();
        let law = regressed(&others, known);
        for (i, case) in cases.iter().enumerate().filter(|(i, _)| i % FOLDS == fold) {
            held_out[i] = law.of(&case.features, &case.seen, case.scale);
        }
    }
    let ratios = cases.iter().zip(&held_out).map(|(c, [known, within])| (c.error - known).abs() / within);
    let factor = conformal(ratios.collect(), TERM_COVERAGE);
    held_out.iter_mut().for_each(|[_, within]| *within *= factor);
    let law = regressed(cases, known);
    Fitted { law: PairLaw { factor, ..law }, held_out }
}

/// The ratio that a share of all lies below, one more than there are counted as worst of all.
pub fn conformal(mut ratios: Vec<f64>, coverage: f64) -> f64 {
    ratios.sort_unstable_by(f64::total_cmp);
    let rank = (coverage * (ratios.len() + 1) as f64).ceil() as usize;
    ratios.get(rank.min(ratios.len()).saturating_sub(1)).copied().unwrap_or(1.0)
}

/// Least squares of the errors, then a quantile of the logarithms of what is left.
fn regressed(cases: &[PairCase], known: Known) -> PairLaw {
    let (mut mean, mut pull) = (Vec::new(), 0.0);
    match known {
        Known::Features => mean = ridge(cases.iter().map(|c| (c.features.to_vec(), c.error / c.scale, 1.0)), FEATURES),
        Known::Shape => {
            let ratios = cases.iter().filter(|c| c.seen.shift != 0.0);
            pull = weighted_median(ratios.map(|c| [c.error / c.seen.shift, c.seen.shift.abs() / c.scale]).collect());
        }
    }
    let left = |c: &PairCase| {
        let mean: f64 = mean.iter().zip(&c.features).map(|(a, x)| a * x).sum();
        (((c.error - pull * c.seen.shift) / c.scale - mean).abs() + LEAST_ERROR).ln()
    };
    let row = |c: &PairCase| {
        let sizes = c.seen.sizes.iter().map(|d| logarithm(*d, c.scale));
        c.features.iter().copied().chain(sizes).collect::<Vec<f64>>()
    };
    let rows: Vec<(Vec<f64>, f64)> = cases.iter().map(|c| (row(c), left(c))).collect();
    let mut spread = quantile(&rows);
    let powers = spread.split_off(FEATURES.min(spread.len()));
    PairLaw { known: mean, pull, spread, powers, factor: 1.0 }
}

/// The value that half of the weight lies below, between 0 and 1; 0 of none.
fn weighted_median(mut all: Vec<[f64; 2]>) -> f64 {
    all.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let half = 0.5 * all.iter().map(|[_, weight]| weight).sum::<f64>();
    let mut sum = 0.0;
    let found = all.iter().find(|[_, weight]| {
        sum += weight;
        sum >= half
    });
    found.map_or(0.0, |[value, _]| value.clamp(0.0, 1.0))
}

/// Coefficients of the function that a share of all values lies below: least squares, with weights that make sums of them
/// sums of distances.
fn quantile(rows: &[(Vec<f64>, f64)]) -> Vec<f64> {
    let n = rows.first().map_or(FEATURES, |(row, _)| row.len());
    let mut found = ridge(rows.iter().map(|(x, y)| (x.clone(), *y, 1.0)), n);
    for _ in 0..ROUNDS {
        let weighted = rows.iter().map(|(x, y)| {
            let above = y - found.iter().zip(x).map(|(b, x)| b * x).sum::<f64>();
            let side = if above > 0.0 { QUANTILE } else { 1.0 - QUANTILE };
            (x.clone(), *y, side / above.abs().max(NEAR))
        });
        found = ridge(weighted, n);
    }
    found
}

/// Coefficients of weighted least squares of rows, values and weights; all but that of the constant are held small.
fn ridge(rows: impl Iterator<Item = (Vec<f64>, f64, f64)>, n: usize) -> Vec<f64> {
    let (mut normal, mut right) = (DMatrix::<f64>::zeros(n, n), DVector::<f64>::zeros(n));
    for (row, value, weight) in rows {
        let x = DVector::from_vec(row);
        right.axpy(weight * value, &x, 1.0);
        normal.ger(weight, &x, &x, 1.0);
    }
    for j in 1..n {
        normal[(j, j)] += RIDGE;
    }
    normal.cholesky().map_or(vec![0.0; n], |c| c.solve(&right).iter().copied().collect())
}
