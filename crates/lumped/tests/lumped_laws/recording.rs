//! Runs of the lumped models as rows.

use std::convert::Infallible;

use integrate::{Course, EvenRows, Integrator, Ledger, Mechanism, Method, MotionError, Scheme, State, StepControl};
use lumped::{
    HistoryRow, LumpedModel,
    impact::{ImpactMechanism, ImpactRow},
    shaft18::{ShaftMechanism, ShaftRow},
    starting_state,
};
use nalgebra::DVector;

/// What is to be run, and which rows are kept of it.
#[derive(Debug, Clone, Copy)]
pub struct Recording {
    pub scheme: Scheme,
    /// Steps; one ends at every row.
    pub control: StepControl,
    /// Time that passes before rows are kept, s.
    pub settle: f64,
    /// Time over which rows are kept, s.
    pub duration: f64,
    /// Rows, evenly spaced from the beginning of that time, its end left out.
    pub rows: usize,
}

/// Rows, the state at the end, and energy from the start to the end.
pub struct Recorded<R> {
    pub rows: Vec<R>,
    pub state: State,
    pub ledger: Ledger,
}

pub type Trouble = MotionError<Infallible>;

fn record<M: Mechanism<Error = Infallible>, R>(
    system: &mut M,
    (state, scale): (State, DVector<f64>),
    plan: &Recording,
    row: impl Fn(&mut M, &State) -> R,
) -> Result<Recorded<R>, Trouble> {
    let method = Method { scheme: plan.scheme, scale, stop_at_events: false, keep_stable: false };
    let (first, spacing) = (state.time + plan.settle, plan.duration / plan.rows as f64);
    let times = EvenRows { method, control: plan.control, first, spacing, rows: plan.rows };
    let mut course = Course::new(system, times, state);
    course.run_cycle::<Trouble>(None)?;
    let mut rows = Vec::with_capacity(plan.rows);
    course.run_cycle::<Trouble>(Some(&mut |at| {
        rows.push(row(at.system, at.state));
        Ok(())
    }))?;
    Ok(Recorded { rows, ledger: course.ledger().copied().unwrap_or_default(), state: course.state().clone() })
}

/// Mesh cycles of a pair.
#[derive(Debug, Clone, Copy)]
pub struct RunPlan {
    pub scheme: Scheme,
    pub rows_per_cycle: usize,
    pub steps_per_row: usize,
    /// Mesh cycles before the first row.
    pub settling_cycles: usize,
    pub cycles: usize,
}

/// Runs a pair from `from` on, from rest where there is none.
pub fn run<M: LumpedModel>(
    model: &mut M,
    plan: &RunPlan,
    from: Option<State>,
) -> Result<Recorded<HistoryRow>, Trouble> {
    let period = 1.0 / model.pair().clock.mesh_frequency();
    let recording = Recording {
        scheme: plan.scheme,
        control: StepControl::Fixed(period / (plan.rows_per_cycle * plan.steps_per_row) as f64),
        settle: plan.settling_cycles as f64 * period,
        duration: plan.cycles as f64 * period,
        rows: plan.cycles * plan.rows_per_cycle,
    };
    let (state, scale) = (from.unwrap_or_else(|| starting_state(model)), LumpedModel::scale(model));
    record(model, (state, scale), &recording, |model, at| model.row(at.time, &at.q, &at.v))
}

/// Rigid gears from the balance of their nominal motion on.
pub fn impacts(model: &mut ImpactMechanism, plan: &Recording) -> Result<Recorded<ImpactRow>, Trouble> {
    let q = model.rolling_state().unwrap();
    let (still, scale) = (DVector::zeros(q.len()), model.scale());
    record(model, (State::new(0.0, q, still), scale), plan, |model, at| model.row(at.time, &at.q, &at.v))
}

/// Shafts from their equilibrium at t = 0 on, rows of a mesh.
pub fn shafts(model: &mut ShaftMechanism, mesh: usize, plan: &Recording) -> Recorded<ShaftRow> {
    let q = model.static_state(0.0).unwrap();
    let (still, scale) = (DVector::zeros(q.len()), model.scale());
    let row = |model: &mut ShaftMechanism, at: &State| model.row(mesh, at.time, &at.q, &at.v).unwrap();
    record(model, (State::new(0.0, q, still), scale), plan, row).unwrap()
}

/// Carries shafts that stand at a whole number of mesh periods on by one, in so many steps.
pub fn strobe(model: &mut ShaftMechanism, steps: u32, state: &mut State) -> ShaftRow {
    let period = model.mesh_period(0).unwrap();
    let until = ((state.time / period).round() + 1.0) * period;
    let control = StepControl::Fixed(period / f64::from(steps));
    let mut integrator = Integrator::new(Scheme::RungeKutta4, control, model.scale());
    integrator.advance(model, state, until, |_, _| ()).unwrap();
    model.row(0, state.time, &state.q, &state.v).unwrap()
}
