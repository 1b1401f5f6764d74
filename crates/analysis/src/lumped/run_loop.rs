//! A run of a model: its mesh cycles, and their evaluation.

use std::sync::Arc;

use answer::RowStore;
use gearbox::GearboxError;
use integrate::{
    Ahead, Checkpoint, Compared, Course, CycleTimes, Follower, Goal, Ledger, Method, Periodicity, Row, RowPlace,
    Settle, State, StepControl, Stop, Timetable, whole_cycles,
};
use periodic::Shooting;
use scene::{Analysis, MotionScene, Run, Scene};

use super::{
    LumpedRow,
    free_turn::free_turn,
    integration::{MeshFrequencies, method},
    mechanism::{BoxedMechanism, LumpedMemory},
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
    /// Steps in a mesh cycle with rows, on average.
    pub steps_per_cycle: Option<f64>,
    /// Steps from row to row.
    pub steps_per_row: u32,
}

/// A state from which a run continues, with the preceding rows.
#[derive(Debug, Clone)]
pub struct LumpedResume {
    /// State of the motion and its stage.
    pub checkpoint: LumpedCheckpoint,
    /// Rows so far.
    pub rows: Arc<RowStore<LumpedRow>>,
    /// Energy balance, row by row.
    pub energy: Arc<RowStore<EnergyRow>>,
}

/// Rows of a motion so far, and its energy row by row.
pub type LumpedSoFar<'a> = (&'a RowStore<LumpedRow>, &'a RowStore<EnergyRow>);

/// State of a model's motion at the end of a mesh cycle, without its rows so far.
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

/// Mesh cycles that are written.
fn cycles(scene: &Scene, motion: &MotionScene, mesh_frequency_hz: f64) -> u64 {
    let Analysis { cycles, .. } = scene.analysis;
    let ramp = motion.ramp.map(|r| r.before_s + r.duration_s + r.after_s);
    // A float beyond the range becomes its end.
    motion.duration_s.or(ramp).map_or(u64::from(cycles), |t| whole_cycles(t * mesh_frequency_hz) as u64)
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
    /// Runs the model; time starts at 0 whatever the time of the state.
    ///
    /// # Errors
    /// [`AnalysisError`] if there is no initial equilibrium, or if a step does not converge; the error of the observer.
    pub fn run(&self, model: &mut BoxedMechanism, observer: &mut dyn RunObserver) -> Result<LumpedRun, AnalysisError> {
        let Self { scene, motion, frequencies, from, checkpoint_every, resume } = *self;
        let per_cycle = motion.steps_per_mesh_cycle as usize;
        let cycles = cycles(scene, motion, frequencies.mesh_hz);
        let tolerance = motion.periodic_tolerance.unwrap_or(0.0);
        let settle = (motion.run == Run::Steady)
            .then(|| Settle { tolerance, most: u64::from(motion.warm_up_cycles.unwrap_or(0)) });
        let period = model.common_period();
        if let Some(Settle { most, .. }) = settle.filter(|own| period.is_none_or(|p| p > own.most.max(1))) {
            let error = GearboxError::NoCommonPeriod { period, most };
            return Err(GearboxError::at(0.0)(error).into());
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
            steps_per_cycle: course.steps_per_cycle(),
            steps_per_row: frequencies.steps_per_row(motion),
        })
    }

    /// The periodic state near where the next cycles begin: of one common period of the teeth that meet, else of as many mesh
    /// cycles as the motion looks like having.
    fn periodic_state(&self, model: &mut BoxedMechanism, period: &Ahead) -> Result<Option<State>, AnalysisError> {
        let motion = self.motion;
        let free = free_turn(model)?;
        let one = (model.common_period().unwrap_or(1) as usize).min(period.cycles.len());
        let mut search = |period: &Ahead| {
            let shooting = Shooting {
                period,
                tolerance: motion.periodic_tolerance.unwrap_or(0.0),
                free: free.as_ref(),
                back: None,
            };
            shooting.near(model)
        };
        let once = search(&Ahead { cycles: period.cycles[..one].to_vec(), ..period.clone() })?;
        Ok(if once.is_some() || period.cycles.len() == one { once } else { search(period)? })
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
    type Error = AnalysisError;

    fn row(&mut self, at: Row<'_, &mut BoxedMechanism>) -> Result<(), AnalysisError> {
        let Row { system, state, ledger } = at;
        let row = system.row(state).map_err(GearboxError::at(state.time))?;
        let begins_cycle = self.rows.len().is_multiple_of(self.per_cycle);
        self.observer.row(&row, begins_cycle).map_err(AnalysisError::Sink)?;
        self.survey.take(&row);
        self.rows.push(row)?;
        Ok(self.energy.push(EnergyRow::of(state.time, ledger))?)
    }

    fn checkpoint(&mut self, state: LumpedCheckpoint) -> Result<(), AnalysisError> {
        self.observer.checkpoint(state, (&self.rows, &self.energy)).map_err(AnalysisError::Sink)
    }

    fn seeks(&self, model: &&mut BoxedMechanism, found: Periodicity) -> bool {
        model.shoots() && found.residual <= SETTLING
    }

    fn nearer(&mut self, model: &mut &mut BoxedMechanism, period: &Ahead) -> Result<Option<State>, AnalysisError> {
        self.plan.periodic_state(model, period)
    }
}
