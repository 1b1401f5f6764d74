//! A motion as rows of results.

use std::convert::Infallible;

use integrate::{Course, EvenRows, Ledger, Mechanism, Method, MotionError, Scheme, State, StepControl};
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
    state: State,
    scale: DVector<f64>,
    plan: &Recording,
    mut row: impl FnMut(&mut M, &State) -> R,
) -> Result<Recorded<R>, MotionError<Infallible>> {
    if plan.rows == 0 {
        return Err(MotionError::NotPositive { name: "rows of a run", value: 0.0 });
    }
    let method = Method { scheme: plan.scheme, scale, stop_at_events: false, keep_stable: false };
    let first = state.time + plan.settle;
    let spacing = plan.duration / plan.rows as f64;
    let times = EvenRows { method, control: plan.control, first, spacing, rows: plan.rows };
    let mut course = Course::new(system, times, state);
    course.run_cycle::<MotionError<Infallible>>(None)?;
    let mut rows = Vec::with_capacity(plan.rows);
    course.run_cycle::<MotionError<Infallible>>(Some(&mut |at| {
        rows.push(row(at.system, at.state));
        Ok(())
    }))?;
    Ok(Recorded { rows, ledger: course.ledger().copied().unwrap_or_default(), state: course.state().clone() })
}
