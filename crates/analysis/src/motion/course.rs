//! The course of one motion: settle, then write rows; with checkpoints on the way.

use dynamics::{
    Instant, Motion, PairMechanism, PairMotionError, SHOOTING_NEWTON_STEPS, ShootingResult, SideLoads,
    quasi_static_start, shoot,
};
use integrate::{Envelope, Ledger, Periodicity, Recurrence};
use scene::{MotionScene, Run, Scene};

use super::{
    MotionCheckpoint, MotionCourse, MotionLayout, MotionRow, MotionSink, pattern::PatternRecord, setup::PreparedMotion,
};
use crate::{
    AnalysisError, Observer, PhaseWork, Progress, error::in_scene, failure::Failure, results::GearPattern, run_phase,
    unless_cancelled,
};

/// What is asked of the course.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Goal {
    /// Settle to this tolerance first, in so many mesh cycles at the most.
    settle: Option<(f64, u64)>,
    /// Mesh cycles to write.
    cycles: u64,
}

impl Goal {
    fn new(scene: &Scene, motion: &MotionScene, system: &PairMechanism) -> Self {
        let settles = matches!(motion.run, Run::Steady | Run::Shooting);
        let settle = settles
            .then(|| (motion.periodic_tolerance.unwrap_or(1e-6), u64::from(motion.warm_up_cycles.unwrap_or(1000))));
        let until = match (motion.run, motion.ramp, motion.duration_s) {
            (Run::Ramp, Some(ramp), _) => Some(ramp.before_s + ramp.duration_s + ramp.after_s),
            (_, _, duration) => duration,
        };
        let cycles = match until {
            None => u64::from(scene.analysis.cycles),
            Some(end) => {
                let nominal = system.nominal();
                let cycles = nominal.cycles(system.pair(), &system.options().statics, end) - nominal.start;
                (cycles + 1e-9).floor().max(1.0) as u64
            }
        };
        Self { settle, cycles }
    }
}

/// A motion at its end.
pub(super) struct FinishedMotion {
    pub motion: Motion,
    pub course: MotionCourse,
    pub shooting: Option<ShootingResult>,
    /// Whether it stopped where the caller asked it to, before its end.
    pub stopped: bool,
    /// All rows, those before a checkpoint among them.
    pub rows: Vec<MotionRow>,
    pub layout: MotionLayout,
    /// What the flanks were pressed by in the cycles of rows.
    pub patterns: [GearPattern; 2],
    /// Wall time of settling and rows, s.
    pub wall_s: f64,
}

/// A state to go on from, with the rows before it.
#[derive(Debug, Clone)]
pub(super) struct ResumedState {
    pub checkpoint: MotionCheckpoint,
    pub rows: Vec<MotionRow>,
}

/// Where a run begins, and where it is to stop.
#[derive(Debug, Default)]
pub(super) struct Span {
    /// State to go on from.
    pub from: Option<ResumedState>,
    /// Stop when so many mesh cycles are done.
    pub stop_after: Option<u64>,
}

/// Runs one motion to its end.
///
/// # Errors
/// [`Failure::Static`] where another window may do.
pub(super) fn run(
    (scene, motion): (&Scene, &MotionScene),
    prepared: &PreparedMotion,
    observer: &mut dyn Observer,
    sink: &mut dyn MotionSink,
    span: Span,
) -> Result<FinishedMotion, Failure> {
    let goal = Goal::new(scene, motion, &prepared.system);
    let mut course = Course::begin((scene, motion), prepared, (observer, sink), goal, span)?;
    let clock = std::time::Instant::now();
    let mut stopped = false;
    if let (Some((tolerance, most)), false) = (goal.settle, course.state.recording) {
        stopped = run_phase(observer, "settle", PhaseWork::AtMost(most), |progress| {
            course.settle(sink, (tolerance, most), progress)
        })?;
    }
    if !stopped {
        let left = PhaseWork::Steps(goal.cycles - course.state.recorded.min(goal.cycles));
        stopped = run_phase(observer, "solve", left, |progress| course.record(sink, goal, progress))?;
    }
    let wall_s = clock.elapsed().as_secs_f64();
    sink.finish().map_err(AnalysisError::Sink)?;
    let Course { mechanism: motion, state: course, shooting, rows, layout, pattern, .. } = course;
    let patterns = pattern.patterns(scene, motion.system().pair());
    Ok(FinishedMotion { motion, course, shooting, stopped, rows, layout, patterns, wall_s })
}

/// A motion under way.
struct Course<'a> {
    scene: &'a Scene,
    checkpoint_every: u64,
    stop_after: Option<u64>,
    window: usize,
    layout: MotionLayout,
    mechanism: Motion,
    state: MotionCourse,
    shooting: Option<ShootingResult>,
    rows: Vec<MotionRow>,
    pattern: PatternRecord,
}

impl<'a> Course<'a> {
    /// From the quasi-static start, or from a checkpoint.
    fn begin(
        (scene, motion): (&'a Scene, &MotionScene),
        prepared: &PreparedMotion,
        (observer, sink): (&mut dyn Observer, &mut dyn MotionSink),
        goal: Goal,
        Span { from, stop_after }: Span,
    ) -> Result<Self, Failure> {
        let PreparedMotion { system, settings, quasi_static, facts, .. } = prepared;
        let window = facts.window_teeth.unwrap_or(0) as usize;
        let layout = MotionLayout::of(scene, window);
        let fail = |e| failure(scene, e);
        let mut own = system.with_drive(system.options().drive.clone())?;
        sink.begin_rows(&layout, from.as_ref().map(|f| &f.checkpoint)).map_err(AnalysisError::Sink)?;
        let pattern = |grids| PatternRecord::new(scene, motion, system.pair(), grids).map_err(AnalysisError::from);
        let (mechanism, state, shooting, rows, pattern) = match from {
            Some(ResumedState { checkpoint, rows }) => {
                let MotionCheckpoint { motion: at, course, patterns, .. } = checkpoint;
                let pattern = pattern(Some(patterns))?;
                (Motion::resume(own, settings.clone(), at).map_err(fail)?, course, None, rows, pattern)
            }
            None => {
                let pattern = pattern(None)?;
                let guess = quasi_static.transmission_error.first().copied().unwrap_or(0.0);
                let start = run_phase(observer, "start", PhaseWork::Unknown, |_| {
                    quasi_static_start(&mut own, 0.0, guess, &settings.scale)
                });
                let mut mechanism = Motion::new(own, settings.clone(), start.map_err(fail)?);
                let mut shooting = None;
                if let (Run::Shooting, Some((tolerance, _))) = (motion.run, goal.settle) {
                    let shot = run_phase(observer, "shoot", PhaseWork::Unknown, |_| {
                        shoot(&mut mechanism, 1, tolerance, SHOOTING_NEWTON_STEPS)
                    });
                    shooting = Some(shot.map_err(fail)?);
                }
                let returns = Recurrence::from(mechanism.state());
                let recording = goal.settle.is_none();
                let state = MotionCourse { recording, recorded: 0, returns, periodicity: None };
                (mechanism, state, shooting, Vec::new(), pattern)
            }
        };
        let checkpoint_every = u64::from(motion.checkpoint_every_cycles.unwrap_or(0));
        Ok(Self { scene, checkpoint_every, stop_after, window, layout, mechanism, state, shooting, rows, pattern })
    }

    /// Hands out a checkpoint where one is due; whether the run is to stop here.
    fn after_cycle(&self, sink: &mut dyn MotionSink) -> Result<bool, AnalysisError> {
        let (every, cycle) = (self.checkpoint_every, self.mechanism.cycle());
        let stop = self.stop_after.is_some_and(|cycles| cycle >= cycles);
        if (stop || (every > 0 && cycle.is_multiple_of(every)))
            && let Some(motion) = self.mechanism.checkpoint()
        {
            let (course, patterns) = (self.state.clone(), self.pattern.grids().clone());
            let state = MotionCheckpoint { window: self.window, motion, course, patterns };
            sink.checkpoint(state).map_err(AnalysisError::Sink)?;
        }
        Ok(stop)
    }

    fn settle(
        &mut self,
        sink: &mut dyn MotionSink,
        (tolerance, most): (f64, u64),
        progress: &dyn Progress,
    ) -> Result<bool, Failure> {
        while self.mechanism.cycle() < most {
            let envelope = self.mechanism.run_cycle(None).map_err(|e| failure(self.scene, e))?;
            let found = self.judge(&envelope, tolerance);
            progress.tick();
            unless_cancelled(progress)?;
            progress.say(format!("repeats itself to {:.1e}, asked {tolerance:.0e}", found.residual));
            self.state.recording = found.residual <= tolerance;
            if self.after_cycle(sink)? {
                return Ok(true);
            }
            if self.state.recording {
                break;
            }
        }
        self.state.recording = true;
        Ok(false)
    }

    fn record(&mut self, sink: &mut dyn MotionSink, goal: Goal, progress: &dyn Progress) -> Result<bool, Failure> {
        let tolerance = goal.settle.map_or(1e-6, |(tolerance, _)| tolerance);
        while self.state.recorded < goal.cycles && self.mechanism.goes_on() {
            let envelope = self.cycle_of_rows(sink)?;
            self.state.recorded += 1;
            sink.end_cycle(self.state.recorded).map_err(AnalysisError::Sink)?;
            self.judge(&envelope, tolerance);
            progress.tick();
            unless_cancelled(progress)?;
            if self.state.recorded < goal.cycles && self.after_cycle(sink)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn cycle_of_rows(&mut self, sink: &mut dyn MotionSink) -> Result<Envelope, Failure> {
        let Self { layout, rows, pattern, mechanism, .. } = self;
        let mut refused = None;
        let mut push = |now: &Instant, ledger: &Ledger, system: &PairMechanism| {
            let row = layout.row(now, ledger);
            pattern.push(now);
            if refused.is_none() {
                let index = rows.len() as u64;
                let deformed = sink.wants_fields(index).then(|| system.side_loads(now));
                let fields = |sides: Vec<SideLoads<'_>>| sink.fields(index, now.time, &sides).err();
                refused = deformed.and_then(fields).or_else(|| sink.row(&row).err());
            }
            rows.push(row);
        };
        let envelope = mechanism.run_cycle(Some(&mut push)).map_err(|e| failure(self.scene, e))?;
        if let Some(error) = refused {
            return Err(AnalysisError::Sink(error).into());
        }
        self.pattern.end_cycle().map_err(AnalysisError::from)?;
        Ok(envelope)
    }

    fn judge(&mut self, envelope: &Envelope, tolerance: f64) -> Periodicity {
        let motion = &self.mechanism;
        let free = motion.system().coordinates().driver_turn();
        let found = self.state.returns.judge(motion.state(), envelope, &motion.returning(), free, tolerance);
        self.state.periodicity = Some(found);
        found
    }
}

/// Contact that another window may cure, or the end.
pub(super) fn failure(scene: &Scene, error: PairMotionError) -> Failure {
    match error.contact_error() {
        Some(source) if source.is_starved() => Failure::Static(source.clone()),
        _ => in_scene(scene)(error).into(),
    }
}
