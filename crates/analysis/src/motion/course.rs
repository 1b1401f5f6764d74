//! The run of one motion of a scene: its plan, and the receivers of its rows and checkpoints.

use std::sync::Arc;

use answer::RowStore;
use dynamics::SideLoads;
use gearbox::{
    GearboxError,
    motion::{GearboxMechanism, GearboxMemory, PairModel, PairMotion, compared, shoot},
};
use integrate::{Checkpoint, Course, Follower, Goal, Row, Settle, Stage, whole_cycles};
use periodic::Shot;
use scene::{MotionScene, RampScene, Run, Scene};

use super::{MotionCheckpoint, MotionLayout, MotionRow, MotionSink, pattern::PatternRecord, setup::PreparedMotion};
use crate::{
    AnalysisError, Observer, PhaseWork, Progress, error::in_scene, failure::Failure, results::GearPattern, run_phase,
    unless_cancelled,
};

/// Difference over a mesh cycle that counts as none, where a scene states no other.
const TOLERANCE: f64 = 1e-6;

/// Mesh cycles of a ramp with what is before and after it: until its last speed is reached.
pub(super) fn ramp_cycles(ramp: RampScene, pair: &PairModel) -> u64 {
    whole_cycles(pair.cycles_until(ramp.before_s + ramp.duration_s + ramp.after_s)) as u64
}

/// What a scene asks of its motion.
fn goal(
    (scene, motion): (&Scene, &MotionScene),
    (pair, begun): (&PairModel, &PairMotion),
    stop_after: Option<u64>,
) -> Result<Goal<GearboxMechanism>, GearboxError> {
    let settles = matches!(motion.run, Run::Steady | Run::Shooting);
    let tolerance = motion.periodic_tolerance.filter(|_| settles).unwrap_or(TOLERANCE);
    let cycles = match (motion.run, motion.ramp, motion.duration_s) {
        (Run::Ramp, Some(ramp), _) => ramp_cycles(ramp, pair),
        (_, _, Some(end)) => whole_cycles(pair.cycles_until(end)) as u64,
        (_, _, None) => u64::from(scene.analysis.cycles),
    };
    let settle = settles.then(|| Settle { tolerance, most: most(motion) });
    Ok(Goal {
        compared: compared(begun, settle.as_ref())?,
        settle,
        tolerance,
        cycles,
        starts_with_row: false,
        checkpoint_every: u64::from(motion.checkpoint_every_cycles.unwrap_or(0)),
        stop_after,
    })
}

/// Mesh cycles that a motion waits at the most.
fn most(motion: &MotionScene) -> u64 {
    u64::from(motion.warm_up_cycles.unwrap_or(1000))
}

/// A motion at its end.
pub(super) struct FinishedMotion {
    pub motion: PairMotion,
    pub shooting: Option<Shot>,
    /// Whether it stopped where the caller asked it to, before its end.
    pub stopped: bool,
    /// All rows, those before a checkpoint among them.
    pub rows: RowStore<MotionRow>,
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
    pub rows: Arc<RowStore<MotionRow>>,
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
    (scene, asked): (&Scene, &MotionScene),
    prepared: &PreparedMotion,
    observer: &mut dyn Observer,
    sink: &mut dyn MotionSink,
    span: Span,
) -> Result<FinishedMotion, Failure> {
    let stop_after = span.stop_after;
    let (mut motion, shooting, mut told) = begin((scene, asked), prepared, (observer, sink), span)?;
    let goal = goal((scene, asked), (&prepared.system, &motion), stop_after).map_err(|e| failure(scene, e.into()))?;
    let clock = std::time::Instant::now();
    let mut stopped = false;
    if let (Some(settle), false) = (goal.settle, motion.stage().recording) {
        stopped = run_phase(observer, "settle", PhaseWork::AtMost(settle.most), |progress| {
            motion.settle(&goal, &mut InPhase { told: &mut told, progress, settling: Some(settle.tolerance) })
        })
        .map_err(|e| failure(scene, e))?;
    }
    if !stopped {
        let left = PhaseWork::Steps(goal.cycles - motion.stage().recorded.min(goal.cycles));
        stopped = run_phase(observer, "solve", left, |progress| {
            motion.record(&goal, &mut InPhase { told: &mut told, progress, settling: None })
        })
        .map_err(|e| failure(scene, e))?;
    }
    let wall_s = clock.elapsed().as_secs_f64();
    let Outcome { sink, layout, rows, pattern, .. } = told;
    sink.finish().map_err(AnalysisError::Sink)?;
    let patterns = pattern.patterns(scene, prepared.system.pair());
    Ok(FinishedMotion { motion, shooting, stopped, rows, layout, patterns, wall_s })
}

/// The motion at its quasi-static start, on its periodic state where the scene has it found by shooting, or at a
/// checkpoint; and who is told of it.
fn begin<'a>(
    (scene, motion): (&Scene, &MotionScene),
    prepared: &PreparedMotion,
    (observer, sink): (&mut dyn Observer, &'a mut dyn MotionSink),
    Span { from, .. }: Span,
) -> Result<(PairMotion, Option<Shot>, Outcome<'a>), Failure> {
    let PreparedMotion { system, times, facts, .. } = prepared;
    let window = facts.window_teeth.unwrap_or(0) as usize;
    let layout = MotionLayout::of(scene, window);
    let fail = |e: GearboxError| failure(scene, e.into());
    let mut own = system.machine().map_err(fail)?;
    sink.begin_rows(&layout, from.as_ref().map(|f| &f.checkpoint)).map_err(AnalysisError::Sink)?;
    let pattern = |grids| PatternRecord::new(scene, motion, system.pair(), grids).map_err(AnalysisError::from);
    if let Some(ResumedState { checkpoint, rows }) = from {
        let MotionCheckpoint { motion: at, patterns, .. } = checkpoint;
        let pattern = pattern(Some(patterns))?;
        let rows = rows.copied().map_err(AnalysisError::from)?;
        let motion = Course::resume(own, times.clone(), at).map_err(|e| fail(e.into()))?;
        return Ok((motion, None, Outcome { sink, window, layout, rows, pattern }));
    }
    let told = Outcome { sink, window, layout, rows: RowStore::default(), pattern: pattern(None)? };
    let start = run_phase(observer, "start", PhaseWork::Unknown, |_| own.start(0.0));
    let start = start.map_err(|e| fail(GearboxError::at(0.0)(e)))?;
    let mut begun = PairMotion::new(own, times.clone(), start);
    let mut shooting = None;
    if motion.run == Run::Shooting {
        let tolerance = motion.periodic_tolerance.unwrap_or(TOLERANCE);
        let period = begun.system().back_within(most(motion)).map_err(|e| fail(GearboxError::at(0.0)(e)))?;
        let shot = run_phase(observer, "shoot", PhaseWork::Unknown, |_| shoot(&mut begun, period, tolerance));
        shooting = Some(shot.map_err(fail)?);
    }
    Ok((begun, shooting, told))
}

/// Who is told of a motion, and what was read off it so far.
struct Outcome<'a> {
    sink: &'a mut dyn MotionSink,
    window: usize,
    layout: MotionLayout,
    rows: RowStore<MotionRow>,
    pattern: PatternRecord,
}

/// The same in one phase of the analysis.
struct InPhase<'a, 'b> {
    told: &'a mut Outcome<'b>,
    progress: &'a dyn Progress,
    /// Tolerance to which the motion settles in this phase.
    settling: Option<f64>,
}

impl Follower<GearboxMechanism> for InPhase<'_, '_> {
    type Error = AnalysisError;

    fn row(&mut self, Row { system, state, ledger }: Row<'_, GearboxMechanism>) -> Result<(), AnalysisError> {
        let Outcome { sink, layout, rows, pattern, .. } = &mut *self.told;
        let now = system.pair_instant(state).map_err(GearboxError::at(state.time))?;
        let row = layout.row(&now, ledger);
        pattern.push(&now);
        let index = rows.len() as u64;
        if sink.wants_fields(index) {
            let sides: Vec<SideLoads<'_>> = system.loads(0);
            sink.fields(index, now.time, &sides).map_err(AnalysisError::Sink)?;
        }
        sink.row(&row).map_err(AnalysisError::Sink)?;
        Ok(rows.push(row)?)
    }

    fn cycle(&mut self, stage: &Stage) -> Result<(), AnalysisError> {
        if self.settling.is_none() {
            self.told.pattern.end_cycle()?;
            self.told.sink.end_cycle(stage.recorded).map_err(AnalysisError::Sink)?;
        }
        self.progress.tick();
        unless_cancelled(self.progress)?;
        if let (Some(tolerance), Some(found)) = (self.settling, stage.periodicity) {
            self.progress.say(format!("repeats itself to {:.1e}, asked {tolerance:.0e}", found.residual));
        }
        Ok(())
    }

    fn checkpoint(&mut self, motion: Checkpoint<GearboxMemory>) -> Result<(), AnalysisError> {
        let Outcome { sink, window, pattern, .. } = &mut *self.told;
        let state = MotionCheckpoint { window: *window, motion, patterns: pattern.grids().clone() };
        sink.checkpoint(state).map_err(AnalysisError::Sink)
    }
}

/// Contact that another window may cure, or the end.
pub(super) fn failure(scene: &Scene, error: AnalysisError) -> Failure {
    let contact = match &error {
        AnalysisError::Gearbox(source) => source.contact_error(),
        _ => None,
    };
    match contact {
        Some(source) if source.is_starved() => Failure::Static(source.clone()),
        _ => in_scene(scene)(error).into(),
    }
}
