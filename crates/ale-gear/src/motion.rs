//! Motions of reduced gears, from a checked scene to a result folder: what is computed stands in [`analysis::motion`],
//! what is written in [`report::motion_files`] and [`report::checkpoint`].

use std::path::Path;

use analysis::{
    AnalysisError,
    motion::{MotionAnalysis, MotionLayout, MotionOutcome},
};
use report::{
    checkpoint::{CheckpointFolder, Checkpoints, ENERGY_FILE, HISTORY, InputDigests, Stored, read_rows},
    motion_files::MotionFileSink,
    write_motion_result,
};

use report::folder::Cache;

use crate::{
    certificate::Written,
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    scene::{MotionScene, Scene},
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
    pub fn new(motion: &MotionScene, out: &Path, resume: bool, stop_after: Option<u64>) -> Self {
        let wanted = motion.checkpoint_every_cycles.is_some_and(|every| every > 0) || resume || stop_after.is_some();
        Self { folder: wanted.then(|| CheckpointFolder::beside(out)), resume, stop_after }
    }

    /// A run in one piece, without checkpoints.
    pub fn uncut() -> Self {
        Self { folder: None, resume: false, stop_after: None }
    }

    /// The results are whole: nothing is to be gone on from.
    pub fn done(&self) -> Result<(), CommandError> {
        Ok(self.folder.as_ref().map_or(Ok(()), CheckpointFolder::remove)?)
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
    motion: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    progression: &Progression,
) -> Result<Outcome, CommandError> {
    if motion.continuation.is_some() || motion.basins.is_some() {
        return finished(report::solve_many_motions(scene, motion, phases, results, cache));
    }
    if motion.sweep.is_some() {
        return finished(report::solve_sweep(scene, phases, results, cache));
    }
    if !scene.accuracy.is_none() {
        return finished(report::solve_accurate(scene, phases, results, cache));
    }
    let Some(folder) = &progression.folder else {
        return one_motion(scene, phases, (results, cache), None, None);
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
        one_motion(scene, phases, (results, cache), Some((checkpoints, from)), progression.stop_after)
    });
    if solved.is_err() {
        folder.remove_if_empty();
    }
    drop(alone);
    solved
}

fn finished(told: Result<report::Told, AnalysisError>) -> Result<Outcome, CommandError> {
    Ok(Outcome::Finished(Written::of(told?)))
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

/// One motion, from a state where there is one.
fn one_motion(
    scene: &Scene,
    phases: &mut Phases,
    (results, cache): (&ResultDirectory, &Cache),
    kept: Option<(Checkpoints<'_>, Option<Stored>)>,
    stop_after: Option<u64>,
) -> Result<Outcome, CommandError> {
    let (checkpoints, from) = kept.map_or((None, None), |(checkpoints, from)| (Some(checkpoints), from));
    let folder = checkpoints.map_or(results.folder(), |c| c.folder.path());
    let mut analysis = MotionAnalysis::new(scene).with_cache(cache).stop_after(stop_after);
    if let Some(stored) = &from {
        let checkpoint = stored.checkpoint();
        let layout = MotionLayout::of(scene, checkpoint.window);
        let rows = read_rows(&layout, folder, &stored.rows)?;
        analysis = analysis.resume(checkpoint, rows);
    }
    let mut sink = MotionFileSink::new(scene, folder, checkpoints, from.as_ref()).with_fields(results);
    match analysis.solve_into(phases, &mut sink)? {
        MotionOutcome::Stopped { cycles } => Ok(Outcome::Stopped { cycles }),
        MotionOutcome::Finished(result) => {
            let view = sink.view.take();
            if checkpoints.is_some() {
                for file in [HISTORY, ENERGY_FILE] {
                    results.copy(&folder.join(file), file)?;
                }
            }
            let table = write_motion_result(scene, &result, &phases.cost(), view.as_ref(), results)?;
            Ok(Outcome::Finished(Written { table, verdict: result.facts.verdict(scene).map_err(CommandError::from) }))
        }
    }
}
