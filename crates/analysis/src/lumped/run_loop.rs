//! A run of a model: settle, tell rows, keep the ledger.

use integrate::{Integrator, Ledger, Mechanism, Periodicity, State};
use scene::{Analysis, MotionScene, Run, Scene};

use super::{
    LumpedRow,
    integration::{MeshFrequencies, integrator},
    mechanism::{BoxedMechanism, ModelFailure},
    periodicity::PeriodicityMonitor,
    shooting::Shooting,
};
use crate::{AnalysisError, SinkResult, motion::EnergyRow};

/// Mesh cycles before the periodic state is sought by Newton's method; the next tries come after half as many again.
const FIRST_SHOT: u64 = 8;
/// Difference after a period, over the peak to peak, from which on it is sought: the motion is on its way.
const SETTLING: f64 = 0.05;
/// Rows of a run and what it took.
#[derive(Debug)]
pub(crate) struct LumpedRun {
    /// Row by row.
    pub rows: Vec<LumpedRow>,
    /// Energy since the start of the run, row by row.
    pub energy: Vec<EnergyRow>,
    /// Where it ends.
    pub end: State,
    /// Rows in a mesh cycle.
    pub per_cycle: usize,
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

impl LumpedRun {
    /// Rows of the mesh cycles that are judged.
    pub fn judged_rows(&self) -> &[LumpedRow] {
        &self.rows[self.rows.len().saturating_sub(self.judged as usize * self.per_cycle)..]
    }

    /// One row a mesh cycle, at its beginning: a stroboscopic section.
    pub fn section(&self) -> impl Iterator<Item = &LumpedRow> {
        self.rows.iter().step_by(self.per_cycle)
    }
}

/// What is told of a run on its way.
pub(super) trait RunObserver {
    /// A row, at the beginning of a mesh cycle or within it.
    fn row(&mut self, row: &LumpedRow, begins_cycle: bool) -> SinkResult;
}

/// Tells nobody.
pub(super) struct NoRunObserver;

impl RunObserver for NoRunObserver {
    fn row(&mut self, _: &LumpedRow, _: bool) -> SinkResult {
        Ok(())
    }
}

/// What keeps a run from its end.
pub(super) enum RunFailure {
    /// The model or a step.
    Model(ModelFailure),
    /// Whoever gets the rows.
    Sink(Box<dyn std::error::Error + Send + Sync>),
}

impl RunFailure {
    /// With the scene that it is about.
    pub fn of(self, scene: &Scene) -> AnalysisError {
        match self {
            Self::Model(e) => e.of(scene),
            Self::Sink(e) => AnalysisError::Sink(e),
        }
    }
}

impl From<ModelFailure> for RunFailure {
    fn from(e: ModelFailure) -> Self {
        Self::Model(e)
    }
}

/// Mesh cycles that are written.
fn cycles(scene: &Scene, motion: &MotionScene, mesh_frequency_hz: f64) -> u64 {
    let Analysis { cycles, .. } = scene.analysis;
    let ramp = motion.ramp.map(|r| r.before_s + r.duration_s + r.after_s);
    // A float beyond the range becomes its end.
    motion.duration_s.or(ramp).map_or(u64::from(cycles), |t| (t * mesh_frequency_hz).ceil().max(1.0) as u64)
}

/// How a motion came to its periodic state.
struct Settled {
    warm_up: u64,
    periodicity: Option<Periodicity>,
}

/// A run of a model, from a state at the beginning of a mesh cycle, else from rest under the load.
pub(super) struct RunPlan<'a> {
    pub scene: &'a Scene,
    pub motion: &'a MotionScene,
    pub frequencies: MeshFrequencies,
    pub from: Option<&'a State>,
}

impl RunPlan<'_> {
    /// Time at which row `row`, counted from the start, stands, s.
    fn time(&self, row: u64) -> f64 {
        let (period, per_cycle) = (1.0 / self.frequencies.mesh_hz, f64::from(self.motion.steps_per_mesh_cycle));
        row as f64 * period / per_cycle
    }

    /// Runs it; the clock begins at 0 whatever the state's own says.
    ///
    /// # Errors
    /// [`ModelFailure`] where there is nothing to start from, or a step does not settle; that of the observer.
    pub fn run(&self, model: &mut BoxedMechanism, observer: &mut dyn RunObserver) -> Result<LumpedRun, RunFailure> {
        let Self { scene, motion, frequencies, from } = *self;
        let per_cycle = u64::from(motion.steps_per_mesh_cycle);
        let mut state = match from {
            Some(from) => State::new(0.0, from.q.clone(), from.v.clone()),
            None => model.start()?,
        };
        let mut integrator = integrator(model, motion, frequencies.step(motion));
        let Settled { warm_up, periodicity } = self.settle(model, &mut integrator, &mut state)?;
        let cycles = cycles(scene, motion, frequencies.mesh_hz);
        let (mut rows, mut energy) = (Vec::new(), Vec::new());
        for k in 0..cycles * per_cycle {
            let row = model.row(&state).map_err(ModelFailure::at(state.time))?;
            observer.row(&row, k % per_cycle == 0).map_err(RunFailure::Sink)?;
            rows.push(row);
            energy.push(EnergyRow::of(state.time, &ledger(model, &integrator, &state)?));
            advance(model, &mut integrator, &mut state, self.time(warm_up * per_cycle + k + 1))?;
        }
        let ledger = ledger(model, &integrator, &state)?;
        // Of a ramp the last speed is judged.
        let judged = match motion.ramp {
            Some(ramp) => ((ramp.after_s * frequencies.mesh_hz).floor() as u64).clamp(1, cycles),
            None => cycles,
        };
        Ok(LumpedRun {
            rows,
            energy,
            end: state,
            per_cycle: per_cycle as usize,
            cycles,
            judged,
            warm_up,
            periodicity,
            ledger,
            steps: integrator.steps(),
            steps_per_row: frequencies.steps_per_row(motion),
        })
    }

    /// Mesh cycles until the motion repeats itself, at most as many as the scene has for that, and how nearly it does.
    /// Once it nearly does, [`Shooting`] takes it there.
    fn settle(
        &self,
        model: &mut BoxedMechanism,
        integrator: &mut Integrator,
        state: &mut State,
    ) -> Result<Settled, ModelFailure> {
        let motion = self.motion;
        let (per_cycle, most) = (u64::from(motion.steps_per_mesh_cycle), u64::from(motion.warm_up_cycles.unwrap_or(0)));
        let tolerance = motion.periodic_tolerance.unwrap_or(0.0);
        let (mut monitor, mut periodicity) = (PeriodicityMonitor::default(), None);
        let (mut warm_up, mut next_shot) = (0, FIRST_SHOT);
        while motion.run == Run::Steady && warm_up < most {
            let mut errors = Vec::with_capacity(per_cycle as usize);
            for k in 0..per_cycle {
                errors.push(model.transmission_error_um(state).map_err(ModelFailure::at(state.time))?);
                advance(model, integrator, state, self.time(warm_up * per_cycle + k + 1))?;
            }
            warm_up += 1;
            let found = monitor.judge(errors, tolerance);
            periodicity = Some(found);
            if found.residual <= tolerance {
                break;
            }
            if warm_up >= next_shot && model.shoots() && found.residual <= SETTLING {
                next_shot = warm_up + warm_up / 2;
                let near = self.periodic_state(model, state, (found.period, tolerance))?;
                if let Some(there) = near {
                    *state = there;
                    *integrator =
                        self::integrator(model, motion, self.frequencies.step(motion)).resumed(opened(model, state)?);
                    monitor = PeriodicityMonitor::default();
                }
            }
        }
        Ok(Settled { warm_up, periodicity })
    }

    /// The periodic state near a state: of one mesh cycle, else of as many as the motion looks like having.
    fn periodic_state(
        &self,
        model: &mut BoxedMechanism,
        state: &State,
        (period, tolerance): (usize, f64),
    ) -> Result<Option<State>, ModelFailure> {
        let Self { motion, frequencies, .. } = *self;
        let search = |period: usize| Shooting { motion, frequencies, period, tolerance };
        let once = search(1).near(model, state)?;
        if once.is_some() || period == 1 { Ok(once) } else { search(period).near(model, state) }
    }
}

/// Energy so far; before the first step what the start holds.
fn ledger(model: &mut BoxedMechanism, integrator: &Integrator, state: &State) -> Result<Ledger, ModelFailure> {
    if let Some(ledger) = integrator.ledger() {
        return Ok(*ledger);
    }
    opened(model, state)
}

/// A ledger that begins at a state.
fn opened(model: &mut BoxedMechanism, state: &State) -> Result<Ledger, ModelFailure> {
    let potential = model.potential(state.time, &state.q).map_err(ModelFailure::at(state.time))?;
    Ok(Ledger::open(model.mass(), &state.v, potential))
}

fn advance(
    model: &mut BoxedMechanism,
    integrator: &mut Integrator,
    state: &mut State,
    until: f64,
) -> Result<(), ModelFailure> {
    Ok(integrator.advance(model, state, until, |_, _| ())?)
}
