//! A motion as rows of results.

use std::convert::Infallible;

use integrate::{Integrator, Ledger, Mechanism, MotionError, Scheme, State, StepControl};
use nalgebra::DVector;

/// What is to be run, and which rows are kept of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recording {
    /// Method of integration.
    pub scheme: Scheme,
    /// Steps; one ends at every row.
    pub control: StepControl,
    /// Time that passes before rows are kept, s.
    pub settle: f64,
    /// Time over which rows are kept, s.
    pub duration: f64,
    /// Rows, evenly spaced from the beginning of that time, its end left out; >= 1.
    pub rows: usize,
}

/// Rows, the state at the end, and energy from the start to the end.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded<R> {
    /// Rows, ascending in time.
    pub rows: Vec<R>,
    /// State at the end: the start of the next run.
    pub state: State,
    /// Energy.
    pub ledger: Ledger,
}

/// Runs a system from `state` on.
pub(crate) fn record<M: Mechanism<Error = Infallible>, R>(
    system: &mut M,
    mut state: State,
    scale: DVector<f64>,
    plan: &Recording,
    mut row: impl FnMut(&mut M, &State) -> R,
) -> Result<Recorded<R>, MotionError<Infallible>> {
    if plan.rows == 0 {
        return Err(MotionError::NotPositive { name: "rows of a run", value: 0.0 });
    }
    let mut integrator = Integrator::new(plan.scheme, plan.control, scale);
    let first = state.time + plan.settle;
    integrator.advance(system, &mut state, first, |_, _| ())?;
    let spacing = plan.duration / plan.rows as f64;
    let mut rows = Vec::with_capacity(plan.rows);
    for k in 1..=plan.rows {
        rows.push(row(system, &state));
        integrator.advance(system, &mut state, first + k as f64 * spacing, |_, _| ())?;
    }
    Ok(Recorded { rows, ledger: integrator.ledger().copied().unwrap_or_default(), state })
}
