//! Analyses in time: from a checked scene to rows, spectra, certificate and report.
//!
//! | module | what it does |
//! |---|---|
//! | `elasticity` | elastic frequencies beside mesh harmonics |
//! | `prepare` | gears, quasi-static cycle, mechanism |
//! | `pattern` | what the flanks are pressed by |
//! | `course` | settle, write rows, checkpoints |
//! | `rows`, `table` | files of rows, written on the way and read back at the end |
//! | `store`, `inputs` | checkpoints on disk, and what they may be gone on from with |
//! | `sweep` | steady states over speed |
//! | `precision` | step sizes against errors of every method |
//! | `headline`, `inertia` | what is read off the rows; which inertia counts |
//! | `certificate` | what must hold of a motion |
//! | `price` | what a longer analysis would cost |
//! | `doubts` | what a user should hear of them |
//! | `write` | files of the result |

mod certificate;
mod course;
mod doubts;
mod elasticity;
mod headline;
mod inertia;
mod inputs;
mod pattern;
mod precision;
mod prepare;
mod price;
mod rows;
mod store;
mod sweep;
mod write;

use ale::solve_widening;
use std::path::{Path, PathBuf};

use course::{Finished, Places};
use inputs::{Change, InputDigests};
use prepare::{Inputs, Prepared, prepare};
use store::{CheckpointFolder, Checkpoints, Stored};
use write::{no_statistics, write_motion, write_sweep};

pub(crate) use analysis::motion::{
    MOTION_WAY_OUT, RPM, Steps, motion_options, refuse_unstable, scheme, speed, steady_by,
};
pub(crate) use elasticity::ElasticHeadline;
pub(crate) use headline::MotionHeadline;
pub(crate) use inertia::InertiaHeadline;
pub(crate) use precision::{Precision, PrecisionPoint, precision};
pub(crate) use report::read_columns;
pub(crate) use rows::{ENERGY_FILE, HISTORY, column_names};
pub(crate) use study::Columns;
pub(crate) use sweep::{SweepHeadline, SweepRow};

use crate::{
    cache::Cache,
    certificate::Written,
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    run::Failure,
    scene::{MotionScene, Scene, SweepScene},
    talk::{self, Loudness},
};

/// What is known of earlier and later runs of the same motion.
#[derive(Debug)]
pub(crate) struct Progression {
    folder: Option<CheckpointFolder>,
    resume: bool,
    stop_after: Option<u64>,
}

impl Progression {
    /// Checkpoints beside `out`, where scene or command ask for some.
    pub fn new(words: &MotionScene, out: &Path, resume: bool, stop_after: Option<u64>) -> Self {
        let wanted = words.checkpoint_every_cycles.is_some_and(|every| every > 0) || resume || stop_after.is_some();
        Self { folder: wanted.then(|| CheckpointFolder::beside(out)), resume, stop_after }
    }

    /// A run in one piece, without checkpoints.
    pub fn uncut() -> Self {
        Self { folder: None, resume: false, stop_after: None }
    }

    /// The results are whole: nothing is to be gone on from.
    pub fn done(&self) -> Result<(), CommandError> {
        self.folder.as_ref().map_or(Ok(()), CheckpointFolder::remove)
    }
}

/// How a run ended.
pub(crate) enum Outcome {
    /// All files are written.
    Finished(Written),
    /// The user asked to stop after so many mesh cycles.
    Stopped {
        /// Mesh cycles done.
        cycles: u64,
    },
}

/// Runs the motion of a scene and writes all files of the result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    progression: &Progression,
) -> Result<Outcome, CommandError> {
    let stop_after = progression.stop_after;
    let Some(folder) = &progression.folder else {
        return through_windows(scene, words, phases, (results, cache), None, stop_after);
    };
    if progression.resume && !folder.path().is_dir() {
        folder.read(scene)?;
    }
    let alone = folder.hold()?;
    let begin = || {
        let inputs = InputDigests::of(scene)?;
        let from = if progression.resume { going_on(folder, scene, &inputs)? } else { None };
        Ok((inputs, from))
    };
    let solved = begin().and_then(|(inputs, from)| {
        let checkpoints = Checkpoints { folder, inputs: &inputs };
        through_windows(scene, words, phases, (results, cache), Some((checkpoints, from)), stop_after)
    });
    if solved.is_err() {
        folder.remove_if_empty();
    }
    drop(alone);
    solved
}

/// The state to go on from; `None` where an earlier run was cut short before its first checkpoint.
fn going_on(folder: &CheckpointFolder, scene: &Scene, inputs: &InputDigests) -> Result<Option<Stored>, CommandError> {
    if folder.is_without_state() {
        talk::say(Loudness::Bars, || {
            format!(
                "ale-gear: {}: the run was cut short before its first checkpoint and begins anew",
                folder.path().display()
            )
        });
        return Ok(None);
    }
    let stored = folder.read(scene)?;
    stored.check_inputs(scene, inputs)?;
    Ok(Some(stored))
}

/// Tries window after window until one suffices, from a state where there is one.
fn through_windows(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    (results, cache): (&ResultDirectory, &Cache),
    kept: Option<(Checkpoints<'_>, Option<Stored>)>,
    stop_after: Option<u64>,
) -> Result<Outcome, CommandError> {
    let inputs = Inputs::new(scene, words, phases, cache)?;
    let (checkpoints, mut from) = kept.map_or((None, None), |(checkpoints, from)| (Some(checkpoints), from));
    if let Some(Checkpoints { inputs: digests, .. }) = checkpoints {
        let meshes: Vec<_> = inputs.meshes.iter().map(|m| m.facts.clone()).collect();
        if let Some(Change::File(file)) = digests.change(&InputDigests::of(scene)?) {
            let file = scene.resolve(Path::new(&file));
            let said = format_args!("{}: has changed while it was read", file.display());
            return Err(CommandError::input(said, Some("run again when nobody writes to it".into())));
        }
        from.as_ref().map_or(Ok(()), |stored| stored.check_meshes(scene, &meshes))?;
    }
    let mut widened = Vec::new();
    let solved = solve_widening(
        from.as_ref().map(|f| f.window),
        |window| attempt(&inputs, phases, results, (checkpoints, stop_after), window, from.take()),
        |window, failure| {
            let Failure::Static(e) = failure else { return None };
            let teeth = prepare::wider(&inputs, window, e)?;
            widened.push(format!("{e}; the window was widened to {teeth} teeth and the motion begun again"));
            Some(teeth)
        },
    );
    match solved.map_err(|e| e.complaint(scene))? {
        Attempt::Stopped { cycles } => Ok(Outcome::Stopped { cycles }),
        Attempt::Motion(mut prepared, done) => {
            prepared.warnings.extend(widened);
            write_motion(scene, words, phases, results, &prepared, &done).map(Outcome::Finished)
        }
        Attempt::Sweep(mut prepared, points, sweep) => {
            prepared.warnings.extend(widened);
            write_sweep(scene, (words, sweep), phases, results, &prepared, &points).map(Outcome::Finished)
        }
    }
}

/// Rows of a motion alone, written into `folder`: for comparing models.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn rows_of(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    folder: &Path,
) -> Result<Columns, CommandError> {
    let cache = Cache::off();
    let inputs = Inputs::new(scene, words, phases, &cache)?;
    let solve = |window| {
        let places = Places { rows: folder, checkpoints: None, from: None, stop_after: None };
        let prepared = prepare(&inputs, phases, window)?;
        doubts::unstable(scene, &prepared)?;
        let done = course::run(scene, words, &prepared, phases, places)?;
        let rows = read_columns(&folder.join(rows::HISTORY)).map_err(CommandError::from)?;
        let headline = headline::headline(scene, words, &prepared, &done, &rows, None).map_err(no_statistics)?;
        Ok::<_, Failure>(prepared.facts.certificate.and(headline.checks()).verdict(scene)?)
    };
    let wider = |window, failure: &Failure| match failure {
        Failure::Static(e) => prepare::wider(&inputs, window, e),
        Failure::Command(_) => None,
    };
    solve_widening(None, solve, wider).map_err(|e| e.complaint(scene))?;
    Ok(read_columns(&folder.join(rows::HISTORY))?)
}

/// One width of the window.
enum Attempt<'a> {
    Motion(Box<Prepared>, Box<Finished>),
    Sweep(Box<Prepared>, Vec<dynamics::SweepOutcome>, &'a SweepScene),
    Stopped { cycles: u64 },
}

fn attempt<'a>(
    inputs: &Inputs<'a>,
    phases: &mut Phases,
    results: &ResultDirectory,
    (checkpoints, stop_after): (Option<Checkpoints<'_>>, Option<u64>),
    window: Option<usize>,
    from: Option<Stored>,
) -> Result<Attempt<'a>, Failure> {
    let Inputs { scene, words, .. } = *inputs;
    let mut prepared = prepare(inputs, phases, window)?;
    doubts::unstable(scene, &prepared)?;
    prepared.warnings.extend(doubts::coarse(scene, words, &prepared));
    prepared.warnings.extend(doubts::no_backlash(scene, &prepared));
    let slow = doubts::slow(scene, words, &prepared).or_else(|| doubts::long(scene, words, &prepared));
    if let Some(slow) = slow {
        // Who waits should hear it before the end.
        talk::say(Loudness::Bars, || format!("ale-gear: {slow}"));
        prepared.warnings.push(slow);
    }
    if let Some(sweep) = &words.sweep {
        let wider = |e: &ltca::StaticError| prepare::wider(inputs, window, e).is_some();
        let outcomes = sweep::run(scene, (words, sweep), &prepared, &wider, phases)?;
        return Ok(Attempt::Sweep(Box::new(prepared), outcomes, sweep));
    }
    let rows: PathBuf = match checkpoints {
        Some(Checkpoints { folder, .. }) => {
            if from.is_none() {
                folder.start()?;
            }
            folder.path().to_owned()
        }
        None => results.folder().to_owned(),
    };
    let places = Places { rows: &rows, checkpoints, from, stop_after };
    let done = course::run(scene, words, &prepared, phases, places)?;
    if done.stopped {
        return Ok(Attempt::Stopped { cycles: done.motion.cycle() });
    }
    if checkpoints.is_some() {
        for file in [rows::HISTORY, rows::ENERGY_FILE] {
            results.copy(&rows.join(file), file)?;
        }
    }
    Ok(Attempt::Motion(Box::new(prepared), Box::new(done)))
}
