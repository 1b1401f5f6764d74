//! Laws of errors that go with features of a pair, fitted to measured cases: theory (64).

use std::iter::repeat;

use analysis::accuracy::{FEATURES, Features, PairLaw, Seen, logarithm};
use nalgebra::{DMatrix, DVector};

/// What was known of a run, what was seen, and what its error was.
#[derive(Debug, Clone)]
pub struct PairCase {
    /// Number of the pair: its cases take part together, or none does.
    pub pair: usize,
    pub features: Features,
    pub seen: Seen,
    pub error: f64,
    pub scale: f64,
}

/// What of an error can be known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// Nothing.
    Nothing,
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
/// Weight of small coefficients of the spread, over that of a case of each set; and of a mean.
const RIDGE: f64 = 2.0;
const RIDGE_OF_MEAN: f64 = 20.0;
/// Error over the scale that counts as none.
const LEAST_ERROR: f64 = 1e-6;
/// Share of the cases that lies within a single bound.
const TERM_COVERAGE: f64 = 0.9;
/// Share of the cases that the spread lies above: bounds are of large errors, and small ones are small by chance.
const QUANTILE: f64 = 0.8;
/// Rounds of the search for that quantile, and the distance from it below which cases count alike.
const ROUNDS: usize = 25;
const NEAR: f64 = 0.05;

/// Laws of sets of cases that hold for nine in ten of each when they are made without them. Spreads of all sets go alike with
/// features and sizes, but for a factor of each: a set has few pairs, and what makes the error of one large does so for the
/// others.
pub fn fit(sets: &[Vec<PairCase>], known: Known) -> Vec<Fitted> {
    let mut held_out: Vec<Vec<[f64; 2]>> = sets.iter().map(|cases| vec![[0.0; 2]; cases.len()]).collect();
    for fold in 0..FOLDS {
        let takes_part = |case: &&PairCase| case.pair % FOLDS != fold;
        let others: Vec<Vec<PairCase>> =
            sets.iter().map(|cases| cases.iter().filter(takes_part).cloned().collect()).collect();
        for ((law, cases), said) in regressed(&others, known).iter().zip(sets).zip(&mut held_out) {
            for (case, said) in cases.iter().zip(said).filter(|(case, _)| !takes_part(case)) {
                *said = law.of(&case.features, &case.seen, case.scale);
            }
        }
    }
    let whole = regressed(sets, known);
    let fitted = whole.into_iter().zip(sets).zip(held_out).map(|((law, cases), mut held_out)| {
        let ratios = cases.iter().zip(&held_out).map(|(c, [known, within])| (c.error - known).abs() / within);
        let factor = conformal(ratios.collect(), TERM_COVERAGE);
        held_out.iter_mut().for_each(|[_, within]| *within *= factor);
        Fitted { law: PairLaw { factor, ..law }, held_out }
    });
    fitted.collect()
}

/// The ratio that a share of all lies below, one more than there are counted as worst of all.
pub fn conformal(mut ratios: Vec<f64>, coverage: f64) -> f64 {
    ratios.sort_unstable_by(f64::total_cmp);
    let rank = (coverage * (ratios.len() + 1) as f64).ceil() as usize;
    ratios.get(rank.min(ratios.len()).saturating_sub(1)).copied().unwrap_or(1.0)
}

/// Least squares of the errors of each set, then a quantile of the logarithms of what is left of all.
fn regressed(sets: &[Vec<PairCase>], known: Known) -> Vec<PairLaw> {
    let means: Vec<(Vec<f64>, f64)> = sets.iter().map(|cases| mean(cases, known)).collect();
    let most = sets.iter().flatten().map(|case| case.seen.sizes.len()).max().unwrap_or(0);
    let mut rows = Vec::new();
    for (set, (cases, (mean, pull))) in sets.iter().zip(&means).enumerate() {
        for c in cases {
            let own = (0..sets.len()).map(|other| f64::from(u8::from(other == set)));
            // One that is not seen counts as none, as in the law.
            let sizes = c.seen.sizes.iter().copied().chain(repeat(0.0)).take(most).map(|d| logarithm(d, c.scale));
            let mean: f64 = mean.iter().zip(&c.features).map(|(a, x)| a * x).sum();
            let left = ((c.error - pull * c.seen.shift) / c.scale - mean).abs() + LEAST_ERROR;
            rows.push((own.chain(c.features[1..].iter().copied()).chain(sizes).collect(), left.ln()));
        }
    }
    let found = quantile(&rows, sets.len());
    let (own, of_all) = found.split_at(sets.len().min(found.len()));
    let (of_features, powers) = of_all.split_at((FEATURES - 1).min(of_all.len()));
    let law = |((known, pull), own): ((Vec<f64>, f64), &f64)| PairLaw {
        known,
        pull,
        spread: std::iter::once(*own).chain(of_features.iter().copied()).collect(),
        powers: powers.to_vec(),
        factor: 1.0,
    };
    means.into_iter().zip(own).map(law).collect()
}

/// Coefficients of the known part of errors by features, and the share of what a shape adds.
fn mean(cases: &[PairCase], known: Known) -> (Vec<f64>, f64) {
    match known {
        Known::Nothing => (Vec::new(), 0.0),
        Known::Features => {
            let rows: Vec<Row> = cases.iter().map(|c| (c.features.to_vec(), c.error / c.scale, 1.0)).collect();
            (ridge(&rows, 1, RIDGE_OF_MEAN), 0.0)
        }
        Known::Shape => {
            let ratios = cases.iter().filter(|c| c.seen.shift != 0.0);
            let ratios = ratios.map(|c| [c.error / c.seen.shift, c.seen.shift.abs() / c.scale]);
            (Vec::new(), weighted_median(ratios.collect()))
        }
    }
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

/// What a value goes with, the value, and its weight.
type Row = (Vec<f64>, f64, f64);

/// Coefficients of the function that a share of all values lies below: least squares, with weights that make sums of them
/// sums of distances. The first ones are free, those of the constants of the sets.
fn quantile(rows: &[(Vec<f64>, f64)], sets: usize) -> Vec<f64> {
    let weight = RIDGE * sets as f64;
    let mut weighted: Vec<Row> = rows.iter().map(|(x, y)| (x.clone(), *y, 1.0)).collect();
    let mut found = ridge(&weighted, sets, weight);
    for _ in 0..ROUNDS {
        for (x, y, weight) in &mut weighted {
            let above = *y - found.iter().zip(&*x).map(|(b, x)| b * x).sum::<f64>();
            let side = if above > 0.0 { QUANTILE } else { 1.0 - QUANTILE };
            *weight = side / above.abs().max(NEAR);
        }
        found = ridge(&weighted, sets, weight);
    }
    found
}

/// Coefficients of weighted least squares; all but the first `free` ones are held small, by a weight times the variance of
/// what they go with.
fn ridge(rows: &[Row], free: usize, held: f64) -> Vec<f64> {
    let n = rows.first().map_or(0, |(row, ..)| row.len());
    let (mut normal, mut right) = (DMatrix::<f64>::zeros(n, n), DVector::<f64>::zeros(n));
    for (row, value, weight) in rows {
        let x = DVector::from_column_slice(row);
        right.axpy(weight * value, &x, 1.0);
        normal.ger(*weight, &x, &x, 1.0);
    }
    for j in free..n {
        let mean = rows.iter().map(|(row, ..)| row[j]).sum::<f64>() / rows.len() as f64;
        let variance = rows.iter().map(|(row, ..)| (row[j] - mean).powi(2)).sum::<f64>() / rows.len() as f64;
        // What does not vary says nothing.
        normal[(j, j)] += held * variance.max(f64::EPSILON);
    }
    normal.cholesky().map_or(vec![0.0; n], |c| c.solve(&right).iter().copied().collect())
}
