//! Scenes in time, from a checked scene to a result folder: what is computed stands in [`analysis::in_time`], what is
//! written in [`report::solve_in_time`]. What is added here are the checkpoints of one motion.

use std::path::Path;

use analysis::{
    in_time::{TimeAnalysis, TimeOutcome},
    motion::MotionLayout,
};
use report::{
    WrittenInTime,
    checkpoint::{CheckpointFolder, Checkpoints, ENERGY_FILE, HISTORY, InputDigests, Stored, read_rows},
    motion_files::MotionFileSink,
    solve_in_time, write_in_time,
};

use report::folder::Cache;

use crate::{
    certificate::Written,
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    scene::Scene,
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
    /// Checkpoints beside `out`, where scene or command ask for some of one motion.
    pub fn new(scene: &Scene, out: &Path, resume: bool, stop_after: Option<u64>) -> Self {
        let every = scene.motion.as_ref().and_then(|m| m.checkpoint_every_cycles);
        let asked = every.is_some_and(|every| every > 0) || resume || stop_after.is_some();
        let wanted = asked && TimeAnalysis::is_one_motion(scene);
        Self { folder: wanted.then(|| CheckpointFolder::beside(out)), resume, stop_after }
    }

    /// The results are whole: nothing is to be gone on from.
    pub fn done(&self) -> Result<(), CommandError> {
        Ok(self.folder.as_ref().map_or(Ok(()), CheckpointFolder::remove)?)
    }
}

/// How a run ended.
pub(crate) enum Outcome {
    /// All files are written.
    Finished(Box<Written>),
    /// The user asked to stop after so many mesh cycles.
    Stopped {
        /// Mesh cycles done.
        cycles: u64,
    },
}

/// Runs a scene in time and writes all files of the result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    progression: &Progression,
) -> Result<Outcome, CommandError> {
    let Some(folder) = &progression.folder else {
        return Ok(finished(solve_in_time(scene, None, phases, results, cache)?));
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
        with_checkpoints(scene, phases, (results, cache), (checkpoints, from), progression.stop_after)
    });
    if solved.is_err() {
        folder.remove_if_empty();
    }
    drop(alone);
    solved
}

fn finished(written: WrittenInTime) -> Outcome {
    Outcome::Finished(Box::new(written.into()))
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

/// One motion with checkpoints, from a state where there is one.
fn with_checkpoints(
    scene: &Scene,
    phases: &mut Phases,
    (results, cache): (&ResultDirectory, &Cache),
    (checkpoints, from): (Checkpoints<'_>, Option<Stored>),
    stop_after: Option<u64>,
) -> Result<Outcome, CommandError> {
    let folder = checkpoints.folder.path();
    let mut analysis = TimeAnalysis::new(scene).with_cache(cache).stop_after(stop_after);
    if let Some(stored) = &from {
        let checkpoint = stored.checkpoint();
        let layout = MotionLayout::of(scene, checkpoint.window);
        let rows = read_rows(&layout, folder, &stored.rows)?;
        analysis = analysis.resume(checkpoint, rows);
    }
    let mut sink = MotionFileSink::new(scene, folder, Some(checkpoints), from.as_ref()).with_fields(results);
    match analysis.solve_into(phases, &mut sink)? {
        TimeOutcome::Stopped { cycles } => Ok(Outcome::Stopped { cycles }),
        TimeOutcome::Finished(solved) => {
            for file in [HISTORY, ENERGY_FILE] {
                results.copy(&folder.join(file), file)?;
            }
            let cost = phases.cost();
            let table = write_in_time(&solved, &cost, sink.view.as_ref(), results)?;
            Ok(finished(WrittenInTime { solved, cost, table }))
        }
    }
}
