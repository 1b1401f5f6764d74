//! A run of a model: its mesh cycles, and what is read off them.

use std::{f64::consts::TAU, sync::Arc};

use answer::{RowStore, TableError};
use gearbox::{GearboxError, motion::PairMotionError};
use integrate::{
    Checkpoint, Compared, Course, CycleTimes, Follower, Goal, Ledger, Method, MotionError, Periodicity, Row, RowPlace,
    Settle, State, StepControl, Stop, Timetable,
};
use ltca::StaticError;
use periodic::Shooting;
use scene::{Analysis, MotionScene, Run, Scene};

use super::{
    LumpedRow,
    free_turn::free_turn,
    integration::{MeshFrequencies, integrator, method},
    mechanism::{BoxedMechanism, LumpedMemory, ModelFailure},
    survey::RowSurvey,
};
use crate::{AnalysisError, SinkResult, motion::EnergyRow};

/// Difference after a period, over the peak to peak, from which on it is sought: the motion is on its way.
const SETTLING: f64 = 0.05;
/// Rows of a run and what it took.
#[derive(Debug)]
pub(crate) struct LumpedRun {
    /// Row by row.
    pub rows: RowStore<LumpedRow>,
    /// Energy since the start of the run, row by row.
    pub energy: RowStore<EnergyRow>,
    /// What is read off the rows.
    pub survey: RowSurvey,
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
    /// Mesh cycles after which all that excites the motion comes back; `None` where that takes more than 100,000.
    pub common_period: Option<u64>,
    /// How nearly the motion repeated itself at last.
    pub periodicity: Option<Periodicity>,
    /// Energy from the start of the run on.
    pub ledger: Ledger,
    /// Steps taken, and taken back.
    pub steps: [u64; 2],
    /// Steps from row to row.
    pub steps_per_row: u32,
}

/// A state to go on from, with the rows before it.
#[derive(Debug, Clone)]
pub struct LumpedResume {
    /// The motion, and how far it has come.
    pub checkpoint: LumpedCheckpoint,
    /// Rows so far.
    pub rows: Arc<RowStore<LumpedRow>>,
    /// Energy, row by row.
    pub energy: Arc<RowStore<EnergyRow>>,
}

/// Rows of a motion so far, and its energy row by row.
pub type LumpedSoFar<'a> = (&'a RowStore<LumpedRow>, &'a RowStore<EnergyRow>);

/// All that a motion of a model is at the end of a mesh cycle, but for its rows so far.
pub type LumpedCheckpoint = Checkpoint<LumpedMemory>;

/// What is told of a run on its way.
pub(super) trait RunObserver {
    /// A row, at the beginning of a mesh cycle or within it.
    fn row(&mut self, row: &LumpedRow, begins_cycle: bool) -> SinkResult;

    /// A state to go on from with all rows so far.
    fn checkpoint(&mut self, _state: LumpedCheckpoint, _so_far: LumpedSoFar<'_>) -> SinkResult {
        Ok(())
    }
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
    /// There is no room for the rows.
    Rows(TableError),
}

impl RunFailure {
    /// With the scene that it is about.
    pub fn of(self, scene: &Scene) -> AnalysisError {
        match self {
            Self::Model(e) => e.of(scene),
            Self::Sink(e) => AnalysisError::Sink(e),
            Self::Rows(e) => e.into(),
        }
    }
}

impl From<ModelFailure> for RunFailure {
    fn from(e: ModelFailure) -> Self {
        Self::Model(e)
    }
}

impl From<TableError> for RunFailure {
    fn from(e: TableError) -> Self {
        Self::Rows(e)
    }
}

impl From<MotionError<StaticError>> for RunFailure {
    fn from(e: MotionError<StaticError>) -> Self {
        Self::Model(e.into())
    }
}

/// Mesh cycles that are written.
fn cycles(scene: &Scene, motion: &MotionScene, mesh_frequency_hz: f64) -> u64 {
    let Analysis { cycles, .. } = scene.analysis;
    let ramp = motion.ramp.map(|r| r.before_s + r.duration_s + r.after_s);
    // A float beyond the range becomes its end.
    motion.duration_s.or(ramp).map_or(u64::from(cycles), |t| (t * mesh_frequency_hz).ceil().max(1.0) as u64)
}

/// A run of a model, from a state at the beginning of a mesh cycle, else from rest under the load.
pub(super) struct RunPlan<'a> {
    pub scene: &'a Scene,
    pub motion: &'a MotionScene,
    pub frequencies: MeshFrequencies,
    pub from: Option<&'a State>,
    /// Mesh cycles from one checkpoint to the next; 0: none.
    pub checkpoint_every: u64,
    /// Goes on from here, whatever it began with.
    pub resume: Option<&'a LumpedResume>,
}

/// Mesh cycles of a constant length, with rows where each part of them begins.
struct LumpedTimes<'a> {
    motion: &'a MotionScene,
    frequencies: MeshFrequencies,
}

impl Timetable<&mut BoxedMechanism> for LumpedTimes<'_> {
    fn method(&self, model: &&mut BoxedMechanism) -> Method {
        method(model, self.motion)
    }

    fn cycle(&self, _: &&mut BoxedMechanism, cycle: u64, _: f64) -> Option<CycleTimes> {
        let (period, per_cycle) = (1.0 / self.frequencies.mesh_hz, u64::from(self.motion.steps_per_mesh_cycle));
        let end_of_row = |k: u64| (cycle * per_cycle + k) as f64 * period / per_cycle as f64;
        Some(CycleTimes {
            stops: (1..=per_cycle).map(|k| Stop::row(end_of_row(k))).collect(),
            rows: RowPlace::Beginnings,
            control: StepControl::new(self.motion.error_tolerance, self.frequencies.step(self.motion)),
        })
    }

    fn restarts(&self) -> bool {
        false
    }
}

impl RunPlan<'_> {
    /// Runs it; the clock begins at 0 whatever the state's own says.
    ///
    /// # Errors
    /// [`ModelFailure`] where there is nothing to start from, or a step does not settle; that of the observer.
    pub fn run(&self, model: &mut BoxedMechanism, observer: &mut dyn RunObserver) -> Result<LumpedRun, RunFailure> {
        let Self { scene, motion, frequencies, from, checkpoint_every, resume } = *self;
        let per_cycle = motion.steps_per_mesh_cycle as usize;
        let cycles = cycles(scene, motion, frequencies.mesh_hz);
        let tolerance = motion.periodic_tolerance.unwrap_or(0.0);
        let settle = (motion.run == Run::Steady)
            .then(|| Settle { tolerance, most: u64::from(motion.warm_up_cycles.unwrap_or(0)) });
        let period = model.common_period();
        if let Some(Settle { most, .. }) = settle.filter(|own| period.is_none_or(|p| p > own.most.max(1))) {
            let error = GearboxError::NoCommonPeriod { period, most };
            return Err(ModelFailure::from(PairMotionError::at(0.0)(error)).into());
        }
        let of = |model: &mut &mut BoxedMechanism, state: &State| model.transmission_error_um(state);
        let goal = Goal {
            compared: period.map(|period| Compared::Signal { of, period }),
            settle,
            tolerance,
            cycles,
            starts_with_row: false,
            checkpoint_every,
            stop_after: None,
        };
        let times = LumpedTimes { motion, frequencies };
        let (mut course, rows, energy) = match resume {
            Some(LumpedResume { checkpoint, rows, energy }) => {
                (Course::resume(model, times, checkpoint.clone())?, rows.copied()?, energy.copied()?)
            }
            None => {
                let start = match from {
                    Some(from) => State::new(0.0, from.q.clone(), from.v.clone()),
                    None => model.start()?,
                };
                (Course::new(model, times, start), RowStore::default(), RowStore::default())
            }
        };
        // Of a ramp the last speed is judged.
        let judged = match motion.ramp {
            Some(ramp) => ((ramp.after_s * frequencies.mesh_hz).floor() as u64).clamp(1, cycles),
            None => cycles,
        };
        let mut survey = RowSurvey::judged_from((cycles - judged) as usize * per_cycle);
        rows.for_each(0..rows.len(), |row| survey.take(row))?;
        let mut told = LumpedFollower { plan: self, observer, per_cycle, rows, energy, survey };
        course.run(&goal, &mut told)?;
        let LumpedFollower { rows, energy, survey, .. } = told;
        Ok(LumpedRun {
            rows,
            energy,
            survey,
            end: course.state().clone(),
            per_cycle,
            cycles,
            judged,
            warm_up: course.cycle() - course.stage().recorded,
            common_period: period,
            periodicity: course.stage().periodicity,
            ledger: course.ledger().copied().unwrap_or_default(),
            steps: [course.counts().steps, course.counts().refused],
            steps_per_row: frequencies.steps_per_row(motion),
        })
    }

    /// The periodic state near a state: of one common period of the teeth that meet, else of as many mesh cycles as the motion
    /// looks like having.
    fn periodic_state(
        &self,
        model: &mut BoxedMechanism,
        state: &State,
        (period, tolerance): (usize, f64),
    ) -> Result<Option<State>, ModelFailure> {
        let Self { motion, frequencies, .. } = *self;
        let free = free_turn(model)?;
        let search = |model: &mut BoxedMechanism, period: usize| {
            let shooting = Shooting {
                period: period as f64 / frequencies.mesh_hz,
                tolerance,
                scale: model.scale(),
                frequency: TAU * frequencies.mesh_hz.max(frequencies.resonance_hz),
                free: free.as_ref(),
                back: None,
            };
            shooting.near(model, state, |model| Ok(integrator(model, motion, frequencies.step(motion))))
        };
        let one = model.common_period().unwrap_or(1) as usize;
        let once = search(model, one)?;
        Ok(if once.is_some() || period == one { once } else { search(model, period)? })
    }
}

/// Reads rows off a run, and takes it to its periodic state where it nearly repeats itself.
struct LumpedFollower<'a> {
    plan: &'a RunPlan<'a>,
    observer: &'a mut dyn RunObserver,
    per_cycle: usize,
    rows: RowStore<LumpedRow>,
    energy: RowStore<EnergyRow>,
    survey: RowSurvey,
}

impl Follower<&mut BoxedMechanism> for LumpedFollower<'_> {
    type Error = RunFailure;

    fn row(&mut self, at: Row<'_, &mut BoxedMechanism>) -> Result<(), RunFailure> {
        let Row { system, state, ledger } = at;
        let row = system.row(state).map_err(ModelFailure::at(state.time))?;
        let begins_cycle = self.rows.len().is_multiple_of(self.per_cycle);
        self.observer.row(&row, begins_cycle).map_err(RunFailure::Sink)?;
        self.survey.take(&row);
        self.rows.push(row)?;
        Ok(self.energy.push(EnergyRow::of(state.time, ledger))?)
    }

    fn checkpoint(&mut self, state: LumpedCheckpoint) -> Result<(), RunFailure> {
        self.observer.checkpoint(state, (&self.rows, &self.energy)).map_err(RunFailure::Sink)
    }

    fn seeks(&self, model: &&mut BoxedMechanism, found: Periodicity) -> bool {
        model.shoots() && found.residual <= SETTLING
    }

    fn nearer(
        &mut self,
        model: &mut &mut BoxedMechanism,
        state: &State,
        found: Periodicity,
    ) -> Result<Option<State>, RunFailure> {
        let tolerance = self.plan.motion.periodic_tolerance.unwrap_or(0.0);
        Ok(self.plan.periodic_state(model, state, (found.period, tolerance))?)
    }
}
