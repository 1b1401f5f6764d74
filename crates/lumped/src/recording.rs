//! A motion as rows of results.

use std::convert::Infallible;

use dynamics::motion::{Integrator, Ledger, Mechanism, Scheme, State, StepControl};
use nalgebra::DVector;

use crate::LumpedError;

/// What is to be run, and which rows are kept of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recording {
    /// Method of integration.
    pub scheme: Scheme,
    /// Steps.
    pub control: StepControl,
    /// Time that passes before rows are kept, s.
    pub settle: f64,
    /// Time over which rows are kept, s.
    pub duration: f64,
    /// Every how many steps a row is kept; 0 counts as 1.
    pub every: u64,
}

/// Rows, the state at the end, and energy from the start to the end.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded<R> {
    /// Rows, ascending in time.
    pub rows: Vec<R>,
    /// State at the end.
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
) -> Result<Recorded<R>, LumpedError> {
    let mut integrator = Integrator::new(plan.scheme, plan.control, scale);
    let begin = state.time;
    integrator.advance(system, &mut state, begin + plan.settle, |_, _| ())?;
    let (mut rows, mut count) = (Vec::new(), 0u64);
    integrator.advance(system, &mut state, begin + plan.settle + plan.duration, |system, seen| {
        count += 1;
        if count.is_multiple_of(plan.every.max(1)) {
            rows.push(row(system, seen.state));
        }
    })?;
    Ok(Recorded { rows, ledger: integrator.ledger().copied().unwrap_or_default(), state })
}
