//! A run of a model: settle, write rows, keep the ledger.

use integrate::Periodicity;
use integrate::{Forces, Integrator, Ledger, Mechanism, State, StepControl, StepLimit, Stiffest};
use lumped::LumpedError;

use super::{model::Model, settle::Returns};
use analysis::motion::EnergyRow;
use report::columns::ENERGY;

use crate::{
    motion::{Columns, scheme},
    scene::{Analysis, MotionScene, Run, Scene},
};

/// Phases of a mesh cycle at which the longest stable step is looked for.
const PHASES: u32 = 32;

/// Rows of a run and what it took.
#[derive(Debug)]
pub(super) struct Course {
    /// `history.csv`.
    pub history: Columns,
    /// `energy.csv`.
    pub energy: Columns,
    /// One row a mesh cycle, at its beginning.
    pub section: Columns,
    /// Where it ends.
    pub end: State,
    /// Mesh cycles with rows.
    pub cycles: u64,
    /// The last of these, which the headline and the spectra are of.
    pub judged: u64,
    /// Mesh cycles before them.
    pub warm_up: u64,
    /// How nearly the motion repeated itself at last.
    pub periodicity: Option<Periodicity>,
    /// Energy from the start of the run on.
    pub ledger: Ledger,
    /// Steps taken, and taken back.
    pub steps: [u64; 2],
    /// Steps from row to row.
    pub steps_per_row: u32,
}

/// Steps between rows that show the mesh resonance with as many steps as asked.
fn steps_per_row(words: &MotionScene, [mesh_hz, resonance_hz]: [f64; 2]) -> u32 {
    let per_cycle = f64::from(words.steps_per_resonance) * resonance_hz / mesh_hz;
    let needed = (per_cycle / f64::from(words.steps_per_mesh_cycle)).ceil();
    if needed.is_finite() { needed.clamp(1.0, 1e6) as u32 } else { 1 }
}

/// Mesh cycles that are written.
fn cycles(scene: &Scene, words: &MotionScene, mesh_frequency_hz: f64) -> u64 {
    let Analysis { cycles, .. } = scene.analysis;
    let ramp = words.ramp.map(|r| r.before_s + r.duration_s + r.after_s);
    // A float beyond the range becomes its end.
    words.duration_s.or(ramp).map_or(u64::from(cycles), |t| (t * mesh_frequency_hz).ceil().max(1.0) as u64)
}

/// The integrator that a scene asks for, steps as long as this at the most.
pub(super) fn integrator(model: &Model, words: &MotionScene, step: f64) -> Integrator {
    let control = match words.error_tolerance {
        None => StepControl::Fixed(step),
        Some(tolerance) => StepControl::Adaptive { tolerance, first: 0.1 * step, least: 1e-7 * step, largest: step },
    };
    Integrator::new(scheme(words), control, model.scale()).stopping_at_events(words.stop_at_events).keeping_stable()
}

/// Longest stable step of an explicit method with steps of given length: the stiffest state of a mesh cycle from the start on, its coordinates held. `None` where any step is stable.
///
/// # Errors
/// [`LumpedError`] where there is nothing to start from.
pub(super) fn stable_step(
    model: &mut Model,
    words: &MotionScene,
    mesh_hz: f64,
) -> Result<Option<StepLimit>, LumpedError> {
    let stiffest = Stiffest::new(scheme(words), model.mass()).filter(|_| words.error_tolerance.is_none());
    let Some(mut stiffest) = stiffest else { return Ok(None) };
    let start = model.start()?;
    let mut forces = Forces::zeros(start.q.len());
    for phase in 0..PHASES {
        forces.clear();
        let time = start.time + f64::from(phase) / (f64::from(PHASES) * mesh_hz);
        let Ok(()) = model.forces(time, &start.q, &start.v, &mut forces);
        stiffest.include(&forces);
    }
    Ok(stiffest.limit())
}

/// Length of a step of a scene, s.
pub(super) fn step(words: &MotionScene, frequencies_hz: [f64; 2]) -> f64 {
    let rows = f64::from(words.steps_per_mesh_cycle) * frequencies_hz[0];
    1.0 / rows / f64::from(steps_per_row(words, frequencies_hz))
}

/// Runs a model from a state at the beginning of a mesh cycle, else from rest under the load. Frequencies of the mesh and of its resonance (0: none) say how long steps are.
///
/// The clock begins at 0 whatever the state's own says.
///
/// # Errors
/// [`LumpedError`] where there is nothing to start from, or a step does not settle.
pub(super) fn run(
    model: &mut Model,
    scene: &Scene,
    words: &MotionScene,
    [mesh_hz, resonance_hz]: [f64; 2],
    from: Option<&State>,
    tick: impl Fn(),
) -> Result<Course, LumpedError> {
    let per_cycle = u64::from(words.steps_per_mesh_cycle);
    let steps_per_row = steps_per_row(words, [mesh_hz, resonance_hz]);
    let period = 1.0 / mesh_hz;
    let mut state = match from {
        Some(from) => State::new(0.0, from.q.clone(), from.v.clone()),
        None => model.start()?,
    };
    let mut integrator = integrator(model, words, step(words, [mesh_hz, resonance_hz]));
    let dte = model.columns().iter().position(|n| n == "dte_um");
    let settles = words.run == Run::Steady;
    let (tolerance, most) = (words.periodic_tolerance.unwrap_or(0.0), u64::from(words.warm_up_cycles.unwrap_or(0)));
    let (mut returns, mut periodicity, mut warm_up) = (Returns::default(), None, 0);
    while settles && warm_up < most {
        let mut errors = Vec::with_capacity(per_cycle as usize);
        for k in 0..per_cycle {
            errors.extend(dte.and_then(|i| model.row(&state).get(i).copied()));
            advance(
                model,
                &mut integrator,
                &mut state,
                (warm_up * per_cycle + k + 1) as f64 * period / per_cycle as f64,
            )?;
        }
        warm_up += 1;
        let found = returns.judge(errors, tolerance);
        periodicity = Some(found);
        if found.residual <= tolerance {
            break;
        }
    }
    let cycles = cycles(scene, words, mesh_hz);
    let mut history = Columns::named(model.columns());
    let energy_columns = ENERGY.sheet(&(), &[]);
    let (mut section, mut energy) = (history.clone(), Columns::named(energy_columns.names()));
    for row in 0..cycles * per_cycle {
        let values = model.row(&state);
        if row % per_cycle == 0 {
            section.push(values.iter().copied());
            tick();
        }
        history.push(values);
        let ledger = ledger(model, &integrator, &state);
        energy.push(energy_columns.row(&(), &EnergyRow::of(state.time, &ledger)));
        let until = (warm_up * per_cycle + row + 1) as f64 * period / per_cycle as f64;
        advance(model, &mut integrator, &mut state, until)?;
    }
    let ledger = ledger(model, &integrator, &state);
    energy.push(energy_columns.row(&(), &EnergyRow::of(state.time, &ledger)));
    // Of a ramp the last speed is judged.
    let judged = match words.ramp {
        Some(ramp) => ((ramp.after_s * mesh_hz).floor() as u64).clamp(1, cycles),
        None => cycles,
    };
    Ok(Course {
        history,
        energy,
        section,
        end: state,
        cycles,
        judged,
        warm_up,
        periodicity,
        ledger,
        steps: integrator.steps(),
        steps_per_row,
    })
}

/// Energy so far; before the first step what the start holds.
fn ledger(model: &mut Model, integrator: &Integrator, state: &State) -> Ledger {
    match integrator.ledger() {
        Some(ledger) => *ledger,
        None => {
            let Ok(potential) = model.potential(state.time, &state.q);
            Ledger::open(model.mass(), &state.v, potential)
        }
    }
}

fn advance(model: &mut Model, integrator: &mut Integrator, state: &mut State, until: f64) -> Result<(), LumpedError> {
    Ok(integrator.advance(model, state, until, |_, _| ())?)
}
