//! Rows of `history.csv` and `energy.csv`, written as the motion goes on.

use std::{
    fs::{File, OpenOptions},
    io::{BufWriter, Read, Write},
    path::{Path, PathBuf},
};

use serde::{Deserialize, Serialize};

use dynamics::{Instant, PairMechanism};
use integrate::Ledger;
use report::{
    columns::{ENERGY, EnergyRecord, EnergyRows, MOTION_HISTORY, MotionLayout, MotionRows, Sheet},
    csv::push_row,
};

use study::FlankPattern;

use crate::{
    error::CommandError,
    scene::{MotionScene, Scene},
};

use super::{no_statistics, pattern::PatternRecord};

/// Names of the files.
pub(crate) const HISTORY: &str = "history.csv";
pub(crate) const ENERGY_FILE: &str = "energy.csv";

/// Columns that `history.csv` of a scene's motion will have, but for those of single pairs, which go with the window.
pub(crate) fn column_names(scene: &Scene) -> Vec<String> {
    MOTION_HISTORY.sheet(&MotionLayout::of_scene(scene), &[]).names()
}

/// What a checkpoint keeps of a file of rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Kept {
    /// Length.
    bytes: u64,
    /// BLAKE3 of so many bytes, hexadecimal.
    blake3: String,
}

/// The digest so far of a file of rows, when it begins with what was kept of it.
///
/// # Errors
/// Exit status 2 when it does not.
fn digested(path: &Path, kept: &Kept) -> Result<blake3::Hasher, CommandError> {
    let mut digest = blake3::Hasher::new();
    let read = File::open(path).and_then(|file| digest.update_reader(file.take(kept.bytes)).map(|_| ()));
    let what = match read {
        Err(e) => format!("cannot be read: {e}"),
        Ok(()) if digest.count() < kept.bytes => "is shorter than its checkpoint says".into(),
        Ok(()) if digest.finalize().to_hex().as_str() != kept.blake3 => {
            "is not as its checkpoint left it: changed or damaged".into()
        }
        Ok(()) => return Ok(digest),
    };
    let hint = "run without `--resume` to start from the beginning".to_owned();
    Err(CommandError::input(format_args!("{}: {what}", path.display()), Some(hint)))
}

/// A file that grows and can be taken up again.
#[derive(Debug)]
struct Growing {
    path: PathBuf,
    file: BufWriter<File>,
    bytes: u64,
    digest: blake3::Hasher,
    failed: Option<std::io::Error>,
}

impl Growing {
    fn new(path: PathBuf, header: &str) -> Result<Self, CommandError> {
        let file = File::create(&path).map_err(|e| CommandError::write(&path, &e))?;
        let mut new = Self { file: BufWriter::new(file), path, bytes: 0, digest: blake3::Hasher::new(), failed: None };
        new.push(header);
        Ok(new)
    }

    /// Cut to what its digest is of, what came after a checkpoint being written anew.
    fn resume(path: PathBuf, digest: blake3::Hasher) -> Result<Self, CommandError> {
        let bytes = digest.count();
        let open = || -> std::io::Result<File> {
            let file = OpenOptions::new().append(true).open(&path)?;
            file.set_len(bytes)?;
            Ok(file)
        };
        let file = open().map_err(|e| CommandError::write(&path, &e))?;
        Ok(Self { file: BufWriter::new(file), path, bytes, digest, failed: None })
    }

    /// A failure is kept for the next flush: rows come from the midst of a computation.
    fn push(&mut self, text: &str) {
        self.bytes += text.len() as u64;
        self.digest.update(text.as_bytes());
        if let Err(e) = self.file.write_all(text.as_bytes()) {
            self.failed.get_or_insert(e);
        }
    }

    fn flush(&mut self) -> Result<Kept, CommandError> {
        match self.failed.take().or_else(|| self.file.flush().err()) {
            None => Ok(Kept { bytes: self.bytes, blake3: self.digest.finalize().to_hex().to_string() }),
            Some(e) => Err(CommandError::write(&self.path, &e)),
        }
    }
}

/// What the rows of both files share, and their columns.
fn columns(
    scene: &Scene,
    system: &PairMechanism,
    window: usize,
) -> (MotionLayout, Sheet<MotionRows>, Sheet<EnergyRows>) {
    let layout = MotionLayout::of(scene, system);
    (layout, layout.sheet(window), ENERGY.sheet(&(), &[]))
}

/// Both files of rows.
#[derive(Debug)]
pub(super) struct Rows {
    layout: MotionLayout,
    history_columns: Sheet<MotionRows>,
    energy_columns: Sheet<EnergyRows>,
    history: Growing,
    energy: Growing,
    line: String,
    pattern: PatternRecord,
}

impl Rows {
    /// Fresh files in a folder.
    pub fn new(
        scene: &Scene,
        words: &MotionScene,
        system: &PairMechanism,
        window: usize,
        folder: &Path,
    ) -> Result<Self, CommandError> {
        let (layout, history_columns, energy_columns) = columns(scene, system, window);
        let history = Growing::new(folder.join(HISTORY), &history_columns.header())?;
        let energy = Growing::new(folder.join(ENERGY_FILE), &energy_columns.header())?;
        let pattern = PatternRecord::new(scene, words, system.pair(), None).map_err(no_statistics)?;
        Ok(Self { layout, history_columns, energy_columns, history, energy, line: String::new(), pattern })
    }

    /// Whether both files in a folder begin with what was kept of them.
    ///
    /// # Errors
    /// Exit status 2, naming the file that does not.
    pub fn check(folder: &Path, [history, energy]: &[Kept; 2]) -> Result<(), CommandError> {
        digested(&folder.join(HISTORY), history)?;
        digested(&folder.join(ENERGY_FILE), energy).map(|_| ())
    }

    /// Files of before, cut to what was kept of them.
    pub fn resume(
        scene: &Scene,
        words: &MotionScene,
        system: &PairMechanism,
        window: usize,
        folder: &Path,
        (kept, patterns): ([Kept; 2], [FlankPattern; 2]),
    ) -> Result<Self, CommandError> {
        let [history, energy] = [folder.join(HISTORY), folder.join(ENERGY_FILE)];
        // Both are looked at before either is cut.
        let digests = (digested(&history, &kept[0])?, digested(&energy, &kept[1])?);
        let (layout, history_columns, energy_columns) = columns(scene, system, window);
        Ok(Self {
            layout,
            history_columns,
            energy_columns,
            pattern: PatternRecord::new(scene, words, system.pair(), Some(patterns)).map_err(no_statistics)?,
            history: Growing::resume(history, digests.0)?,
            energy: Growing::resume(energy, digests.1)?,
            line: String::new(),
        })
    }

    /// One row of each file.
    pub fn push(&mut self, now: &Instant, ledger: &Ledger) {
        self.line.clear();
        push_row(&mut self.line, self.history_columns.row(&self.layout, now));
        self.history.push(&self.line);
        self.line.clear();
        push_row(&mut self.line, self.energy_columns.row(&(), &EnergyRecord { time: now.time, ledger: *ledger }));
        self.energy.push(&self.line);
        self.pattern.push(now);
    }

    /// A mesh cycle of rows is over.
    pub fn end_cycle(&mut self) -> Result<(), CommandError> {
        self.pattern.end_cycle().map_err(no_statistics)
    }

    /// What the flanks were pressed by in the cycles of rows.
    pub fn pattern(&self) -> &PatternRecord {
        &self.pattern
    }

    /// Writes out what is held back; what a checkpoint keeps of both files.
    pub fn flush(&mut self) -> Result<[Kept; 2], CommandError> {
        Ok([self.history.flush()?, self.energy.flush()?])
    }
}
