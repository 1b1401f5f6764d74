//! The convex programme of one step: curves and limits to first order, bounds, a region of trust.

use clarabel::{
    algebra::CscMatrix,
    solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT::NonnegativeConeT},
};

use crate::goal::{Evaluation, Goal, Measure, Over, residuals};

/// Weight of what limits are passed by, as a share of them, beside the goal over its own size: no goal is worth it.
const LIMIT_WEIGHT: f64 = 1e3;
/// Damping that keeps a step unique where the goal does not ask for it, over the goal.
const DAMPING: f64 = 1e-7;

/// Rows a . x <= b and costs of a programme.
struct Programme {
    columns: usize,
    rows: Vec<(Vec<(usize, f64)>, f64)>,
    costs: Vec<f64>,
    /// Upper triangle of P.
    squares: Vec<(usize, usize, f64)>,
}

impl Programme {
    fn column(&mut self, cost: f64) -> usize {
        self.columns += 1;
        self.costs.push(cost);
        self.columns - 1
    }

    fn row(&mut self, entries: Vec<(usize, f64)>, at_most: f64) {
        self.rows.push((entries, at_most));
    }

    fn solve(self) -> Option<Vec<f64>> {
        let Self { columns, rows, costs, squares } = self;
        let (mut i, mut j, mut v, mut b) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (row, (entries, at_most)) in rows.into_iter().enumerate() {
            b.push(at_most);
            for (column, value) in entries {
                i.push(row);
                j.push(column);
                v.push(value);
            }
        }
        let limits = CscMatrix::new_from_triplets(b.len(), columns, i, j, v);
        let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
        for (row, column, value) in squares {
            i.push(row);
            j.push(column);
            v.push(value);
        }
        let squares = CscMatrix::new_from_triplets(columns, columns, i, j, v);
        let settings = DefaultSettingsBuilder::default().verbose(false).max_threads(1).build().ok()?;
        let cones = [NonnegativeConeT(b.len())];
        let mut solver = DefaultSolver::new(&squares, &costs, &limits, &b, &cones, settings).ok()?;
        solver.solve();
        let solved = matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        solved.then(|| solver.solution.x.clone())
    }
}

/// What a step is sought in: parameters over their ranges.
pub(crate) struct Region<'a> {
    /// Ranges of the parameters, in their units.
    pub ranges: &'a [f64],
    /// Lowest and highest change of each parameter, in its unit.
    pub changes: Vec<[f64; 2]>,
}

/// The change of the parameters that makes the goal least to first order; `squared`: the sum of squares of it (Gauss
/// and Newton) in place of the peak to peak. `None` where the solver finds none.
pub(crate) fn step(evaluation: &Evaluation, goal: &Goal, squared: bool, region: &Region<'_>) -> Option<Vec<f64>> {
    let n = region.ranges.len();
    let mut programme = Programme { columns: 0, rows: Vec::new(), costs: Vec::new(), squares: Vec::new() };
    (0..n).for_each(|_| {
        programme.column(0.0);
    });
    let scale = goal.value(&evaluation.curves).max(f64::MIN_POSITIVE);
    for (k, [low, high]) in region.changes.iter().enumerate() {
        programme.row(vec![(k, 1.0)], high / region.ranges[k]);
        programme.row(vec![(k, -1.0)], -low / region.ranges[k]);
    }
    if squared || goal.measure != Measure::PeakToPeak {
        squares(&mut programme, evaluation, goal, (scale, region.ranges));
    } else {
        (0..n).for_each(|k| programme.squares.push((k, k, DAMPING)));
        spans(&mut programme, evaluation, goal, (scale, region.ranges));
    }
    for limited in &evaluation.limited {
        let over = programme.column(LIMIT_WEIGHT);
        let mut entries: Vec<(usize, f64)> =
            (0..n).map(|k| (k, limited.rates[k] * region.ranges[k] / limited.limit)).collect();
        entries.push((over, -1.0));
        programme.row(entries, 1.0 - limited.value / limited.limit);
        programme.row(vec![(over, -1.0)], 0.0);
    }
    let found = programme.solve()?;
    let limited = |k: usize| (found[k] * region.ranges[k]).clamp(region.changes[k][0], region.changes[k][1]);
    Some((0..n).map(limited).collect())
}

/// Sum of squares of what the curves' residuals become, over the square of the goal.
fn squares(programme: &mut Programme, evaluation: &Evaluation, goal: &Goal, (scale, ranges): (f64, &[f64])) {
    let n = ranges.len();
    let mut normal = vec![vec![0.0; n]; n];
    let samples = evaluation.curves.chunk_by(|a, b| a.sample == b.sample).count() as f64;
    for own in evaluation.curves.chunk_by(|a, b| a.sample == b.sample) {
        let weights: f64 = own.iter().map(|c| c.weight).sum();
        for curve in own {
            let weight = curve.weight / (weights * samples * scale * scale);
            let here = residuals(&goal.measure, &curve.values);
            let columns: Vec<Vec<f64>> = (0..n)
                .map(|k| {
                    let column: Vec<f64> = curve.rates.iter().map(|rates| rates[k] * ranges[k]).collect();
                    residuals(&goal.measure, &column)
                })
                .collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            for k in 0..n {
                programme.costs[k] += 2.0 * weight * dot(&columns[k], &here);
                for l in k..n {
                    normal[k][l] += 2.0 * weight * dot(&columns[k], &columns[l]);
                }
            }
        }
    }
    for (k, row) in normal.into_iter().enumerate() {
        for (l, value) in row.into_iter().enumerate().skip(k) {
            programme.squares.push((k, l, value + if k == l { DAMPING } else { 0.0 }));
        }
    }
}

/// Peak to peak of each curve between two levels of its own, over the goal; of the worst samples what is beyond a level
/// that is sought as well (Rockafellar and Uryasev's form of the mean of the worst).
fn spans(programme: &mut Programme, evaluation: &Evaluation, goal: &Goal, (scale, ranges): (f64, &[f64])) {
    let samples = evaluation.curves.chunk_by(|a, b| a.sample == b.sample).count() as f64;
    let level = match goal.over {
        Over::Mean => None,
        Over::WorstBeyond(_) => Some(programme.column(1.0)),
    };
    for own in evaluation.curves.chunk_by(|a, b| a.sample == b.sample) {
        let weights: f64 = own.iter().map(|c| c.weight).sum();
        let mut span: Vec<(usize, f64)> = Vec::new();
        for curve in own {
            let weight = curve.weight / weights;
            let [high, low] = [programme.column(0.0), programme.column(0.0)];
            span.extend([(high, weight), (low, -weight)]);
            for (value, rates) in curve.values.iter().zip(&curve.rates) {
                let entries = |sign: f64, column: usize| {
                    let mut all: Vec<(usize, f64)> = rates
                        .iter()
                        .zip(ranges)
                        .enumerate()
                        .map(|(k, (r, range))| (k, sign * r * range / scale))
                        .collect();
                    all.push((column, -sign));
                    all
                };
                // Levels count from the first value, so that all numbers are of the size of the goal.
                let value = (value - curve.values[0]) / scale;
                programme.row(entries(1.0, high), -value);
                programme.row(entries(-1.0, low), value);
            }
        }
        match (level, goal.over) {
            (Some(level), Over::WorstBeyond(share)) => {
                let beyond = programme.column(1.0 / ((1.0 - share) * samples).max(1.0));
                programme.row(vec![(beyond, -1.0)], 0.0);
                span.extend([(level, -1.0), (beyond, -1.0)]);
                programme.row(span, 0.0);
            }
            _ => span.into_iter().for_each(|(column, weight)| programme.costs[column] += weight / samples),
        }
    }
}
