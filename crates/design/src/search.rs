//! Step after step to a better design, each evaluated before it is taken.

use serde::Serialize;

use crate::{
    convex::{Region, step},
    goal::{Evaluation, Goal, Measure},
};

/// Lowest and highest value of a parameter.
pub type Bounds = [f64; 2];

/// What is sought, and how long.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// What shall be small.
    pub goal: Goal,
    /// Bounds of the parameters.
    pub bounds: Vec<Bounds>,
    /// Evaluations at the most, that of the start among them.
    pub evaluations: usize,
}

/// A step and what became of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TakenStep {
    /// Values of the parameters.
    pub values: Vec<f64>,
    /// The goal there; none where the evaluation failed.
    pub goal: Option<f64>,
    /// Share by which limits are passed.
    pub over_limits: f64,
    /// Whether the search went on from there.
    pub taken: bool,
}

/// Which design was evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evaluated {
    /// So many in the search, from 1: its row in the table of steps.
    Step(usize),
    /// The values that a machine can be set to.
    Rounded,
    /// One of the trade-off.
    Front,
}

impl std::fmt::Display for Evaluated {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Step(number) => write!(f, "evaluation {number}"),
            Self::Rounded => f.write_str("values that a machine can be set to"),
            Self::Front => f.write_str("trade-off"),
        }
    }
}

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// To first order no step makes the goal smaller by half a per cent.
    Converged,
    /// As many evaluations as were allowed.
    Evaluations,
}

/// The best design found.
#[derive(Debug, Clone)]
pub struct SearchResult {
    /// Values of the parameters.
    pub values: Vec<f64>,
    /// All that is known there.
    pub evaluation: Evaluation,
    /// Steps in their order, the start the first.
    pub steps: Vec<TakenStep>,
    /// Why it ended.
    pub stop: Stop,
}

/// Part of its range that a parameter may change by in the first step.
const FIRST_REGION: f64 = 0.5;
/// Share of the goal that is worth a step.
const WORTH: f64 = 5e-3;
/// Regions smaller than this hold nothing new.
const SMALLEST_REGION: f64 = 1e-4;
/// What passing limits counts for beside the goal, over it.
const LIMIT_WEIGHT: f64 = 100.0;
/// Share by which limits may be passed and count as held.
const HELD: f64 = 1e-4;
/// Gain of the goal by a step of least squares below which peaks are sought themselves.
const SLOW: f64 = 0.3;

impl Search {
    fn merit(&self, evaluation: &Evaluation, scale: f64) -> f64 {
        self.goal.value(&evaluation.curves) + scale * LIMIT_WEIGHT * (evaluation.over_limits() - HELD).max(0.0)
    }

    /// Goes on from `start` until no step is worth it.
    ///
    /// Each step is the optimum of curves and limits taken to first order, within bounds and a region of trust that
    /// grows and shrinks with what the steps before were worth. For the peak to peak the first steps are those of least
    /// squares (Gauss and Newton), which see the whole curve; then peaks themselves go into a linear programme.
    ///
    /// # Errors
    /// Failure of the evaluation of the start. Later failures count as bad designs.
    pub fn run<E>(
        &self,
        start: &[f64],
        mut evaluate: impl FnMut(&[f64]) -> Result<Evaluation, E>,
    ) -> Result<SearchResult, E> {
        let clamped = |x: f64, [low, high]: Bounds| x.clamp(low, high);
        let mut values: Vec<f64> = start.iter().zip(&self.bounds).map(|(x, b)| clamped(*x, *b)).collect();
        let ranges: Vec<f64> = self.bounds.iter().map(|[low, high]| high - low).collect();
        let mut evaluation = evaluate(&values)?;
        let scale = self.goal.value(&evaluation.curves);
        let mut merit = self.merit(&evaluation, scale);
        let record = |values: &[f64], e: Option<&Evaluation>, taken| TakenStep {
            values: values.to_vec(),
            goal: e.map(|e| self.goal.value(&e.curves)),
            over_limits: e.map_or(f64::NAN, Evaluation::over_limits),
            taken,
        };
        let mut steps = vec![record(&values, Some(&evaluation), true)];
        let (mut region, mut squared) = (FIRST_REGION, true);
        let peaks = self.goal.measure == Measure::PeakToPeak;
        let mut stop = Stop::Evaluations;
        while steps.len() < self.evaluations {
            let changes = values.iter().zip(&self.bounds).zip(&ranges);
            let changes = changes
                .map(|((x, [low, high]), range)| [(low - x).max(-region * range), (high - x).min(region * range)]);
            let within = Region { ranges: &ranges, changes: changes.collect() };
            let change = step(&evaluation, &self.goal, squared, &within);
            let expected = change.as_ref().map_or(f64::INFINITY, |c| self.merit_after(&evaluation, c, scale));
            let gain = merit - expected;
            if gain <= WORTH * merit {
                if peaks && squared {
                    squared = false;
                    continue;
                }
                stop = Stop::Converged;
                break;
            }
            let Some(change) = change else { break };
            let next: Vec<f64> =
                values.iter().zip(&change).zip(&self.bounds).map(|((x, d), b)| clamped(x + d, *b)).collect();
            let tried = evaluate(&next).ok();
            let reached = tried.as_ref().map_or(f64::INFINITY, |e| self.merit(e, scale));
            let taken = reached < merit;
            steps.push(record(&next, tried.as_ref(), taken));
            let share = (merit - reached) / gain;
            if peaks && squared && (!taken || reached > (1.0 - SLOW) * merit) {
                squared = false;
            }
            let way = change.iter().zip(&ranges).map(|(d, range)| (d / range).abs()).fold(0.0, f64::max);
            if share < 0.25 {
                region = way * if taken { 0.5 } else { 0.25 };
            } else if share > 0.75 {
                region = region.max(2.0 * way).min(1.0);
            }
            if let (true, Some(found)) = (taken, tried) {
                (values, evaluation, merit) = (next, found, reached);
            }
            if region < SMALLEST_REGION {
                stop = Stop::Converged;
                break;
            }
        }
        Ok(SearchResult { values, evaluation, steps, stop })
    }

    fn merit_after(&self, evaluation: &Evaluation, change: &[f64], scale: f64) -> f64 {
        let goal = self.goal.value_after(&evaluation.curves, change);
        let over = |l: &crate::Limited| {
            let value = l.value + l.rates.iter().zip(change).map(|(r, d)| r * d).sum::<f64>();
            value / l.limit - 1.0
        };
        let over = evaluation.limited.iter().map(over).fold(0.0, f64::max);
        goal + scale * LIMIT_WEIGHT * (over - HELD).max(0.0)
    }
}
