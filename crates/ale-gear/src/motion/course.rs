//! The course of one motion: settle, then write rows; with checkpoints on the way.

use analysis::Progress;
use dynamics::{
    Motion, PairMechanism, PairMotionError, SHOOTING_NEWTON_STEPS, ShootingResult, quasi_static_start, shoot,
};
use integrate::{Envelope, Periodicity, Recurrence};
use serde::{Deserialize, Serialize};

use super::{
    prepare::Prepared,
    rows::Rows,
    store::{Checkpoints, Stored},
};
use analysis::results::GearPattern;

use crate::{
    error::CommandError,
    phases::Phases,
    run::Failure,
    scene::{MotionScene, Run, Scene},
};

/// How far an analysis has come.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct CourseState {
    /// Whether rows are written.
    pub recording: bool,
    /// Mesh cycles written.
    pub recorded: u64,
    /// States at the beginnings of the last cycles.
    pub returns: Recurrence,
    /// How nearly the last cycle repeated an earlier one.
    pub periodicity: Option<Periodicity>,
}

/// What is asked of the course.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Goal {
    /// Settle to this tolerance first, in so many mesh cycles at the most.
    settle: Option<(f64, u64)>,
    /// Mesh cycles to write.
    cycles: u64,
}

impl Goal {
    fn new(scene: &Scene, words: &MotionScene, system: &PairMechanism) -> Self {
        let settles = matches!(words.run, Run::Steady | Run::Shooting);
        let settle = settles
            .then(|| (words.periodic_tolerance.unwrap_or(1e-6), u64::from(words.warm_up_cycles.unwrap_or(1000))));
        let until = match (words.run, words.ramp, words.duration_s) {
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

/// A finished motion.
pub(super) struct Finished {
    pub motion: Motion,
    pub course: CourseState,
    pub shot: Option<ShootingResult>,
    /// Whether it stopped where the user asked it to, before its end.
    pub stopped: bool,
    /// What the flanks were pressed by in the cycles of rows.
    pub patterns: [GearPattern; 2],
}

/// Where rows and checkpoints go.
pub(super) struct Places<'a> {
    /// Folder of the rows.
    pub rows: &'a std::path::Path,
    /// Checkpoints, if there are any.
    pub checkpoints: Option<Checkpoints<'a>>,
    /// State to go on from.
    pub from: Option<Stored>,
    /// Stop when so many mesh cycles are done.
    pub stop_after: Option<u64>,
}

/// Runs one motion to its end.
///
/// # Errors
/// [`Failure::Static`] where another window may do.
pub(super) fn run(
    scene: &Scene,
    words: &MotionScene,
    prepared: &Prepared,
    phases: &mut Phases,
    places: Places<'_>,
) -> Result<Finished, Failure> {
    let goal = Goal::new(scene, words, &prepared.system);
    let Prepared { system, settings, quasi_static, facts, .. } = prepared;
    let window = facts.window_teeth.unwrap_or(0) as usize;
    let fail = |e| failure(scene, e);
    let mut own = system.with_drive(system.options().drive.clone())?;
    let (mut rows, mut motion, mut course, mut shot);
    match places.from {
        Some(Stored { motion: checkpoint, course: state, rows: kept, patterns, .. }) => {
            rows = Rows::resume(scene, words, system, window, places.rows, (kept, patterns))?;
            motion = Motion::resume(own, settings.clone(), checkpoint).map_err(fail)?;
            (course, shot) = (state, None);
        }
        None => {
            rows = Rows::new(scene, words, system, window, places.rows)?;
            let guess = quasi_static.transmission_error.first().copied().unwrap_or(0.0);
            let start =
                phases.run("start", || quasi_static_start(&mut own, 0.0, guess, &settings.scale)).map_err(fail)?;
            motion = Motion::new(own, settings.clone(), start);
            shot = None;
            if let (Run::Shooting, Some((tolerance, _))) = (words.run, goal.settle) {
                shot = Some(
                    phases.run("shoot", || shoot(&mut motion, 1, tolerance, SHOOTING_NEWTON_STEPS)).map_err(fail)?,
                );
            }
            let returns = Recurrence::from(motion.state());
            course = CourseState { recording: goal.settle.is_none(), recorded: 0, returns, periodicity: None };
        }
    }
    let keep =
        Keep { scene, words, facts_meshes: &facts.meshes, window, places: (places.checkpoints, places.stop_after) };
    let mut stopped = false;
    if let (Some((tolerance, most)), false) = (goal.settle, course.recording) {
        stopped = phases.run_steps("settle", most, |progress| {
            settle(&keep, &mut motion, &mut course, &mut rows, (tolerance, most), progress)
        })?;
    }
    if !stopped {
        stopped = phases.run_steps("solve", goal.cycles - course.recorded.min(goal.cycles), |progress| {
            record(&keep, &mut motion, &mut course, &mut rows, goal, progress)
        })?;
    }
    rows.flush()?;
    let patterns = rows.pattern().patterns(scene, motion.system().pair());
    Ok(Finished { motion, course, shot, stopped, patterns })
}

/// What checkpoints need.
struct Keep<'a> {
    scene: &'a Scene,
    words: &'a MotionScene,
    facts_meshes: &'a [crate::facts::MeshFacts],
    window: usize,
    places: (Option<Checkpoints<'a>>, Option<u64>),
}

impl Keep<'_> {
    /// Writes a checkpoint where one is due; whether the run is to stop here.
    fn after_cycle(&self, motion: &Motion, course: &CourseState, rows: &mut Rows) -> Result<bool, CommandError> {
        let (Some(Checkpoints { folder, inputs }), stop_after) = self.places else { return Ok(false) };
        let every = u64::from(self.words.checkpoint_every_cycles.unwrap_or(0));
        let stop = stop_after.is_some_and(|cycles| motion.cycle() >= cycles);
        if stop || (every > 0 && motion.cycle().is_multiple_of(every)) {
            let kept = rows.flush()?;
            if let Some(checkpoint) = motion.checkpoint() {
                let kept = (kept, rows.pattern().grids().clone());
                let stored = Stored::new((inputs, self.facts_meshes), self.window, checkpoint, course.clone(), kept);
                folder.write(&stored)?;
            }
        }
        Ok(stop)
    }
}

fn settle(
    keep: &Keep<'_>,
    motion: &mut Motion,
    course: &mut CourseState,
    rows: &mut Rows,
    (tolerance, most): (f64, u64),
    progress: &dyn Progress,
) -> Result<bool, Failure> {
    while motion.cycle() < most {
        let swing = motion.run_cycle(None).map_err(|e| failure(keep.scene, e))?;
        let found = judge(course, motion, &swing, tolerance);
        progress.tick();
        progress.say(format!("repeats itself to {:.1e}, asked {tolerance:.0e}", found.residual));
        course.recording = found.residual <= tolerance;
        if keep.after_cycle(motion, course, rows)? {
            return Ok(true);
        }
        if course.recording {
            break;
        }
    }
    course.recording = true;
    Ok(false)
}

fn record(
    keep: &Keep<'_>,
    motion: &mut Motion,
    course: &mut CourseState,
    rows: &mut Rows,
    goal: Goal,
    progress: &dyn Progress,
) -> Result<bool, Failure> {
    let tolerance = goal.settle.map_or(1e-6, |(tolerance, _)| tolerance);
    while course.recorded < goal.cycles && motion.goes_on() {
        let swing = {
            let mut row = |now: &_, ledger: &_| rows.push(now, ledger);
            motion.run_cycle(Some(&mut row)).map_err(|e| failure(keep.scene, e))?
        };
        rows.end_cycle()?;
        course.recorded += 1;
        judge(course, motion, &swing, tolerance);
        progress.tick();
        if course.recorded < goal.cycles && keep.after_cycle(motion, course, rows)? {
            return Ok(true);
        }
    }
    Ok(false)
}

fn judge(course: &mut CourseState, motion: &Motion, swing: &Envelope, tolerance: f64) -> Periodicity {
    let free = motion.system().coordinates().driver_turn();
    let found = course.returns.judge(motion.state(), swing, &motion.returning(), free, tolerance);
    course.periodicity = Some(found);
    found
}

/// Contact that another window may cure, or the end.
pub(super) fn failure(scene: &Scene, error: PairMotionError) -> Failure {
    match error.contact_error() {
        Some(source) if source.is_starved() => Failure::Static(source.clone()),
        _ => {
            let hint = error.hint();
            Failure::Command(CommandError::failed(format_args!("{}: {error}", scene.file.display()), Some(hint)))
        }
    }
}
