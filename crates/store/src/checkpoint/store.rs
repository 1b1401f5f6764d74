//! Checkpoints on disk: what a run that was cut short goes on from.

use std::{
    fs,
    io::{ErrorKind, Write},
    path::{Path, PathBuf},
};

use files::{Kind, Lock, most, read_regular_text, take_away_left_overs, write_file};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use super::{
    Change, CheckpointError, InputDigests, Resumable,
    growing::{Kept, digested},
    rows::{ENERGY_FILE, HISTORY},
    seal::{sealed_state, unsealed},
};
use crate::StoreError;

const STATE: &str = "state.json";
/// Rows of a gearbox's motion.
pub(super) const GEARBOX_ROWS: &str = "rows.jsonl";
/// Locked as long as a run uses the folder, and by what it is known as one of checkpoints.
const IN_USE: &str = "in_use";
/// What is in that file.
const HEADING: &str = "ale-gear keeps checkpoints here\n";
/// Grows with every change of what is stored.
const VERSION: u32 = 8;
/// Farthest pair of a window: mesh cycles are counted exactly up to here.
pub(super) const FARTHEST_TOOTH: u64 = 1 << 53;

/// Where checkpoints go, and what they are of.
#[derive(Debug, Clone, Copy)]
pub struct Checkpoints<'a> {
    /// The folder.
    pub folder: &'a CheckpointFolder,
    /// What the run is made of.
    pub inputs: &'a InputDigests,
}

/// A folder beside the results' that keeps rows and state of a run under way.
#[derive(Debug)]
pub struct CheckpointFolder(PathBuf);

/// Which program wrote a checkpoint.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Writer {
    version: u32,
    program: String,
    /// Which kind of run.
    kind: String,
}

/// What a checkpoint of any version has.
#[derive(Deserialize)]
struct Head {
    writer: Writer,
}

impl Writer {
    fn this(kind: &str) -> Self {
        Self { version: VERSION, program: env!("CARGO_PKG_VERSION").to_owned(), kind: kind.to_owned() }
    }
}

/// What a kind of run keeps in its state.
pub trait StoredState: Serialize + DeserializeOwned {
    /// Which kind of run.
    const KIND: &'static str;

    /// The files of rows that belong to it, by their names in the folder.
    fn rows(&self) -> Vec<(&'static str, &Kept)>;

    /// Whether its parts go together: what a run goes on from is indexed by them.
    ///
    /// # Errors
    /// What does not.
    fn consistent(&self) -> Result<(), &'static str>;
}

/// What is in the folder beside the rows.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Stored<S> {
    writer: Writer,
    inputs: InputDigests,
    /// What the run goes on from.
    pub state: S,
}

impl<S: StoredState> Stored<S> {
    /// State of a run of these inputs.
    pub fn new(inputs: &InputDigests, state: S) -> Self {
        Self { writer: Writer::this(S::KIND), inputs: inputs.clone(), state }
    }

    /// The state in the text of `file`, without a look at its rows; messages name `document`, too.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`]; [`CheckpointError::Foreign`] when another version wrote it, or a run of another kind.
    pub fn parse(text: &str, file: &Path, document: &Path) -> Result<Self, CheckpointError> {
        let refuse = |what: String| CheckpointError::Damaged { file: file.to_owned(), what };
        let damaged = || refuse("is not as it was written: changed, damaged or of another version".to_owned());
        let state = unsealed(text).ok_or_else(damaged)?;
        let Head { writer } = serde_json::from_str(state).map_err(|_| damaged())?;
        if writer != Writer::this(&writer.kind) {
            return Err(foreign(document, "another version of this program"));
        }
        if writer.kind != S::KIND {
            return Err(foreign(document, "another kind of run"));
        }
        let stored: Self = serde_json::from_str(state).map_err(|e| refuse(format!("is not a checkpoint: {e}")))?;
        stored.state.consistent().map_err(|what| refuse(format!("is not a checkpoint: {what}")))?;
        Ok(stored)
    }

    /// Whether it belongs to a run of these inputs: else it must not go on.
    ///
    /// # Errors
    /// [`CheckpointError::Foreign`], [`CheckpointError::OtherFile`].
    pub fn check_inputs(&self, document: &dyn Resumable, now: &InputDigests) -> Result<(), CheckpointError> {
        match self.inputs.change(now, document) {
            None => Ok(()),
            Some(Change::Document(differences)) if differences.is_empty() => {
                Err(foreign(document.file(), document.another()))
            }
            Some(Change::Document(differences)) => {
                Err(foreign(document.file(), &format!("{}: {differences}", document.another())))
            }
            Some(Change::File(file)) => Err(CheckpointError::OtherFile { file }),
        }
    }
}

pub(super) fn foreign(document: &Path, what: &str) -> CheckpointError {
    CheckpointError::Foreign { scene: document.to_owned(), what: what.to_owned() }
}

impl CheckpointFolder {
    /// The folder that belongs to a result folder: `OUT.checkpoint`.
    pub fn beside(out: &Path) -> Self {
        // Without a slash at the end, else it would be inside.
        let mut name = out.components().collect::<PathBuf>().into_os_string();
        name.push(".checkpoint");
        Self(PathBuf::from(name))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Makes it where it is not there, and keeps other runs out as long as the value lives: two would write into each
    /// other's rows.
    ///
    /// # Errors
    /// [`CheckpointError::NotOurs`] for a file, and a folder that holds anything and was not made for checkpoints,
    /// [`CheckpointError::InUse`], [`StoreError::Write`].
    pub fn hold(&self) -> Result<Lock, StoreError> {
        let path = self.0.join(IN_USE);
        let failed = |cause| StoreError::Write { file: path.clone(), cause };
        if fs::symlink_metadata(&self.0).is_ok() && !self.0.is_dir() {
            return Err(CheckpointError::NotOurs { folder: self.0.clone() }.into());
        }
        fs::create_dir_all(&self.0).map_err(failed)?;
        let is_empty = fs::read_dir(&self.0).map_err(failed)?.next().is_none();
        if !is_empty && !self.is_ours() {
            return Err(CheckpointError::NotOurs { folder: self.0.clone() }.into());
        }
        let lock = Lock::take(&path).map_err(failed)?;
        let lock = lock.ok_or_else(|| CheckpointError::InUse { folder: self.0.clone() })?;
        let said = lock.file().set_len(0).and_then(|()| lock.file().write_all(HEADING.as_bytes()));
        said.map(|()| lock).map_err(failed)
    }

    /// Whether its lock is a file that this program wrote, or that a full disk cut short.
    fn is_ours(&self) -> bool {
        read_regular_text(&self.0.join(IN_USE), most::DOCUMENT).is_ok_and(|text| HEADING.starts_with(&text))
    }

    /// Whether a run has been begun here that has not come to its first checkpoint.
    pub fn is_without_state(&self) -> bool {
        self.0.is_dir() && fs::symlink_metadata(self.0.join(STATE)).is_err_and(|e| e.kind() == ErrorKind::NotFound)
    }

    /// Empties it.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn start(&self) -> Result<(), StoreError> {
        take_away_left_overs(&self.0, &Kind::FILE);
        self.without(&[STATE, HISTORY, ENERGY_FILE, GEARBOX_ROWS])
    }

    fn without(&self, files: &[&str]) -> Result<(), StoreError> {
        for file in files {
            match fs::remove_file(self.0.join(file)) {
                Err(cause) if cause.kind() != ErrorKind::NotFound => {
                    return Err(StoreError::Write { file: self.0.clone(), cause });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The state that is there, as it was written and with the rows that belong to it.
    ///
    /// # Errors
    /// [`CheckpointError::None`], [`CheckpointError::Damaged`]; [`CheckpointError::Foreign`] when another version wrote
    /// it, or a run of another kind.
    pub fn read<S: StoredState>(&self, document: &Path) -> Result<Stored<S>, CheckpointError> {
        let path = self.0.join(STATE);
        let text = read_regular_text(&path, most::STATE)
            .map_err(|cause| CheckpointError::None { file: path.clone(), cause })?;
        let stored = Stored::<S>::parse(&text, &path, document)?;
        for (name, kept) in stored.state.rows() {
            digested(&self.0.join(name), kept)?;
        }
        Ok(stored)
    }

    /// Replaces the state: beside its place first, then renamed, so that a whole one is always there.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn write<S: StoredState>(&self, stored: &Stored<S>) -> Result<(), StoreError> {
        let path = self.0.join(STATE);
        let unwritten = |cause| StoreError::Write { file: path.clone(), cause };
        let state = serde_json::to_string(stored).map_err(|e| unwritten(e.into()))?;
        let text = sealed_state(&state);
        write_file(&path, text.as_bytes()).map_err(unwritten)
    }

    /// Takes it away once the results are whole; what this program did not put there stays, and the folder with it.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn remove(&self) -> Result<(), StoreError> {
        self.start()?;
        self.remove_if_empty();
        Ok(())
    }

    /// Takes it away where a run has come to nothing.
    pub fn remove_if_empty(&self) {
        let others = fs::read_dir(&self.0).is_ok_and(|mut all| all.any(|e| e.is_ok_and(|e| e.file_name() != IN_USE)));
        if !others {
            // Whoever holds the file of the lock still holds it.
            let _ = self.without(&[IN_USE]).map(|()| fs::remove_dir(&self.0));
        }
    }
}
