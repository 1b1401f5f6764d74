//! Laws of errors fitted to measured cases: theory (67).

use analysis::accuracy::Law;

/// Share of the cases that a bound holds for.
pub const COVERAGE: f64 = 0.95;

/// What was seen, what the error was, and what both are measured against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    pub difference: f64,
    pub error: f64,
    pub scale: f64,
}

/// The law with the least bounds, on average of their logarithms, that holds for the share of the cases.
pub fn fit(cases: &[Case]) -> Law {
    let floors = [1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 2e-3, 5e-3, 1e-2, 3e-2, 1e-1];
    let mut best: Option<(f64, Law)> = None;
    for pull in (-20..=30).map(|i| 0.1 * f64::from(i)) {
        for floor in floors {
            let law = Law { pull, floor, factor: 1.0 };
            let law = Law { factor: conformal(cases, law), ..law };
            let cost = cases.iter().map(|c| (law.of(c.difference, c.scale)[1] / c.scale).ln()).sum::<f64>();
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, law));
            }
        }
    }
    best.map_or(Law { pull: 0.0, floor: 1.0, factor: 1.0 }, |(_, law)| law)
}

/// The law, and how it does.
pub fn told_fit(name: &str, cases: &[Case]) -> Law {
    let law = fit(cases);
    let median = |of: &dyn Fn(&Case) -> f64| {
        let mut all: Vec<f64> = cases.iter().map(of).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
    };
    println!(
        "{name:36} pull {:5.2} floor {:.0e} factor {:7.3}: |error| {:7.3} %, bound {:7.3} %, holds {:5.1} % of {}",
        law.pull,
        law.floor,
        law.factor,
        median(&|c| 100.0 * c.error.abs() / c.scale),
        median(&|c| 100.0 * law.of(c.difference, c.scale)[1] / c.scale),
        100.0 * cases.iter().filter(|c| holds(law, c)).count() as f64 / cases.len().max(1) as f64,
        cases.len()
    );
    law
}

fn holds(law: Law, case: &Case) -> bool {
    let [known, bound] = law.of(case.difference, case.scale);
    (case.error - known).abs() <= bound
}

/// The factor with which the law holds for the share of the cases, one more than there are counted as worst of all:
/// split conformal prediction.
fn conformal(cases: &[Case], law: Law) -> f64 {
    let ratio = |c: &Case| {
        let [known, bound] = law.of(c.difference, c.scale);
        if bound > 0.0 { (c.error - known).abs() / bound } else { 0.0 }
    };
    let mut ratios: Vec<f64> = cases.iter().map(ratio).collect();
    ratios.sort_unstable_by(f64::total_cmp);
    let rank = (COVERAGE * (ratios.len() + 1) as f64).ceil() as usize;
    ratios.get(rank.min(ratios.len()).saturating_sub(1)).copied().unwrap_or(1.0).max(1e-6)
}
