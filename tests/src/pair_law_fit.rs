//! Laws of errors that go with features of a pair, fitted to measured cases: theory (64).

use analysis::accuracy::{FEATURES, Features, LEAST_DIFFERENCE, PairLaw};
use nalgebra::{DMatrix, DVector};

/// What was known of a run, what was seen, and what its error was.
#[derive(Debug, Clone, Copy)]
pub struct PairCase {
    pub features: Features,
    pub difference: f64,
    pub error: f64,
    pub scale: f64,
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

/// The law that holds for nine in ten cases when it is made without them.
pub fn fit(cases: &[PairCase], by_difference: bool) -> Fitted {
    let mut held_out = vec![[0.0; 2]; cases.len()];
    for fold in 0..FOLDS {
        let others: Vec<PairCase> =
            cases.iter().enumerate().filter(|(i, _)| i % FOLDS != fold).map(|(_, c)| *c).collect();
        let law = regressed(&others, by_difference);
        for (i, case) in cases.iter().enumerate().filter(|(i, _)| i % FOLDS == fold) {
            held_out[i] = law.of(&case.features, case.difference, case.scale);
        }
    }
    let ratios = cases.iter().zip(&held_out).map(|(c, [known, within])| (c.error - known).abs() / within);
    let factor = conformal(ratios.collect(), TERM_COVERAGE);
    held_out.iter_mut().for_each(|[_, within]| *within *= factor);
    let law = regressed(cases, by_difference);
    Fitted { law: PairLaw { factor, ..law }, held_out }
}

/// The ratio that a share of all lies below, one more than there are counted as worst of all.
pub fn conformal(mut ratios: Vec<f64>, coverage: f64) -> f64 {
    ratios.sort_unstable_by(f64::total_cmp);
    let rank = (coverage * (ratios.len() + 1) as f64).ceil() as usize;
    ratios.get(rank.min(ratios.len()).saturating_sub(1)).copied().unwrap_or(1.0)
}

/// Least squares of the errors, then of the logarithms of what is left.
fn regressed(cases: &[PairCase], by_difference: bool) -> PairLaw {
    let known = ridge(cases.iter().map(|c| (c.features.to_vec(), c.error / c.scale)).collect());
    let left = |c: &PairCase| {
        let shift: f64 = known.iter().zip(&c.features).map(|(a, x)| a * x).sum();
        ((c.error / c.scale - shift).abs() + LEAST_ERROR).ln()
    };
    let seen = |c: &PairCase| (c.difference.abs() / c.scale + LEAST_DIFFERENCE).ln();
    let row = |c: &PairCase| {
        let mut row = c.features.to_vec();
        row.extend(by_difference.then(|| seen(c)));
        (row, left(c))
    };
    let mut spread = ridge(cases.iter().map(row).collect());
    let power = if by_difference { spread.pop().unwrap_or(0.0) } else { 0.0 };
    PairLaw { known, spread, power, factor: 1.0 }
}

/// Coefficients of least squares; all but that of the constant are held small.
fn ridge(rows: Vec<(Vec<f64>, f64)>) -> Vec<f64> {
    let n = rows.first().map_or(FEATURES, |(row, _)| row.len());
    let x = DMatrix::from_fn(rows.len(), n, |i, j| rows[i].0[j]);
    let y = DVector::from_fn(rows.len(), |i, _| rows[i].1);
    let mut normal = x.tr_mul(&x);
    for j in 1..n {
        normal[(j, j)] += RIDGE;
    }
    let right = x.tr_mul(&y);
    normal.cholesky().map_or(vec![0.0; n], |c| c.solve(&right).iter().copied().collect())
}
