//! Runs in parts: what is known of earlier runs of a motion, and where this one is to stop.

use std::path::Path;

use store::checkpoint::{CheckpointFolder, Checkpoints, InputDigests, Resumable, Stored, StoredState};

use crate::{
    certificate::Closing,
    error::CommandError,
    talk::{self, Verbosity},
};

/// What is known of earlier and later runs of the same motion.
#[derive(Debug)]
pub(crate) struct Progression {
    folder: Option<CheckpointFolder>,
    resume: bool,
    /// Mesh cycles in all after which the run is to stop.
    pub stop_after: Option<u64>,
}

/// Where a part of a run begins, and where its states go; neither where it runs in one piece.
pub(crate) type Part<'a, S> = Option<(Checkpoints<'a>, Option<Stored<S>>)>;

/// How a run ended.
pub(crate) enum Outcome {
    /// All files are written.
    Finished(Closing),
    /// The user asked to stop after so many mesh cycles.
    Stopped {
        /// Mesh cycles done.
        cycles: u64,
    },
}

impl Progression {
    /// Checkpoints beside `out`, where document (`every` so many cycles) or command ask for some.
    pub fn new(every: Option<u32>, out: &Path, resume: bool, stop_after: Option<u64>) -> Self {
        let wanted = every.is_some_and(|every| every > 0) || resume || stop_after.is_some();
        Self { folder: wanted.then(|| CheckpointFolder::beside(out)), resume, stop_after }
    }

    /// The results are whole: nothing is to be gone on from.
    pub fn done(&self) -> Result<(), CommandError> {
        Ok(self.folder.as_ref().map_or(Ok(()), CheckpointFolder::remove)?)
    }

    /// Runs a motion of the document, from its last state where it is to be gone on with. Nobody else uses the folder of
    /// the states as long.
    pub fn run<S: StoredState, T>(
        &self,
        document: &dyn Resumable,
        run: impl FnOnce(Part<'_, S>) -> Result<T, CommandError>,
    ) -> Result<T, CommandError> {
        let Some(folder) = &self.folder else { return run(None) };
        if self.resume && !folder.path().is_dir() {
            folder.read::<S>(document.file())?;
        }
        let alone = folder.hold()?;
        let begin = || {
            let inputs = InputDigests::of(document);
            let from = if self.resume { going_on(folder, document, &inputs)? } else { None };
            Ok((inputs, from))
        };
        let solved = begin().and_then(|(inputs, from)| run(Some((Checkpoints { folder, inputs: &inputs }, from))));
        if solved.is_err() {
            folder.remove_if_empty();
        }
        drop(alone);
        solved
    }
}

/// The state to go on from; `None` where an earlier run was cut short before its first checkpoint.
fn going_on<S: StoredState>(
    folder: &CheckpointFolder,
    document: &dyn Resumable,
    inputs: &InputDigests,
) -> Result<Option<Stored<S>>, CommandError> {
    if folder.is_without_state() {
        talk::say(Verbosity::Bars, || {
            format!(
                "ale-gear: {}: the run was cut short before its first checkpoint and begins anew",
                folder.path().display()
            )
        });
        return Ok(None);
    }
    let stored = folder.read::<S>(document.file())?;
    stored.check_inputs(document, inputs)?;
    Ok(Some(stored))
}
