//! Rows of `history.csv` and `energy.csv`, written as the motion goes on.

use std::{
    fs::{File, OpenOptions},
    io::{BufWriter, Read, Write},
    path::{Path, PathBuf},
};

use analysis::motion::{MotionLayout, MotionRow};
use scene::Scene;
use serde::{Deserialize, Serialize};
use study::Columns;

use super::CheckpointError;
use crate::{
    ReportError,
    columns::{ENERGY, EnergyRows, MOTION_HISTORY, MotionRows, Sheet, motion_rows},
    csv::push_row,
    parse_columns,
};

/// Rows of a motion.
pub const HISTORY: &str = "history.csv";
/// Its ledger of energy, row by row.
pub const ENERGY_FILE: &str = "energy.csv";

/// Columns that `history.csv` of a scene's motion will have, but for those of single pairs, which go with the window.
pub fn motion_column_names(scene: &Scene) -> Vec<String> {
    MOTION_HISTORY.sheet(&MotionLayout::of(scene, 0), &[]).names()
}

/// What a checkpoint keeps of a file of rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Kept {
    /// Length.
    bytes: u64,
    /// BLAKE3 of so many bytes, hexadecimal.
    blake3: String,
}

/// A regular file, open: a pipe would have no beginning.
fn opened(path: &Path) -> std::io::Result<File> {
    files::regular(&std::fs::metadata(path)?)?;
    File::open(path)
}

/// The digest so far of a file of rows, when it begins with what was kept of it.
///
/// # Errors
/// [`CheckpointError::Damaged`] when it does not.
fn digested(path: &Path, kept: &Kept) -> Result<blake3::Hasher, CheckpointError> {
    let mut digest = blake3::Hasher::new();
    let read = opened(path).and_then(|file| digest.update_reader(file.take(kept.bytes)).map(|_| ()));
    let what = match read {
        Err(e) => format!("cannot be read: {e}"),
        Ok(()) if digest.count() < kept.bytes => "is shorter than its checkpoint says".into(),
        Ok(()) if digest.finalize().to_hex().as_str() != kept.blake3 => {
            "is not as its checkpoint left it: changed or damaged".into()
        }
        Ok(()) => return Ok(digest),
    };
    Err(CheckpointError::Damaged { file: path.to_owned(), what })
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
    fn new(path: PathBuf, header: &str) -> Result<Self, ReportError> {
        let file = File::create(&path).map_err(|cause| ReportError::Write { file: path.clone(), cause })?;
        let mut new = Self { file: BufWriter::new(file), path, bytes: 0, digest: blake3::Hasher::new(), failed: None };
        new.push(header);
        Ok(new)
    }

    /// Cut to what its digest is of, what came after a checkpoint being written anew.
    fn resume(path: PathBuf, digest: blake3::Hasher) -> Result<Self, ReportError> {
        let bytes = digest.count();
        let open = || -> std::io::Result<File> {
            let file = OpenOptions::new().append(true).open(&path)?;
            file.set_len(bytes)?;
            Ok(file)
        };
        let file = open().map_err(|cause| ReportError::Write { file: path.clone(), cause })?;
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

    fn flush(&mut self) -> Result<Kept, ReportError> {
        // On the disk before a checkpoint says that it is there.
        let written = |file: &mut BufWriter<File>| file.flush().and_then(|()| file.get_ref().sync_data());
        match self.failed.take().or_else(|| written(&mut self.file).err()) {
            None => Ok(Kept { bytes: self.bytes, blake3: self.digest.finalize().to_hex().to_string() }),
            Some(cause) => Err(ReportError::Write { file: self.path.clone(), cause }),
        }
    }
}

/// Columns of both files.
fn sheets(layout: &MotionLayout) -> (Sheet<MotionRows>, Sheet<EnergyRows>) {
    (MOTION_HISTORY.sheet(layout, &layout.pairs().collect::<Vec<_>>()), ENERGY.sheet(&(), &[]))
}

/// The columns of a file as far as a checkpoint kept it.
fn columns_kept(path: &Path, kept: &Kept) -> Result<Columns, ReportError> {
    let mut text = String::new();
    let read = opened(path).and_then(|file| file.take(kept.bytes).read_to_string(&mut text));
    read.map_err(|cause| ReportError::Read { file: path.to_owned(), cause })?;
    parse_columns(&text).ok_or_else(|| ReportError::NoNumber { file: path.to_owned() })
}

/// The rows of a run so far, from both files as far as a checkpoint kept them.
///
/// # Errors
/// When a file cannot be read or holds what is no row.
pub fn read_rows(
    layout: &MotionLayout,
    folder: &Path,
    [history, energy]: &[Kept; 2],
) -> Result<Vec<MotionRow>, ReportError> {
    let history = columns_kept(&folder.join(HISTORY), history)?;
    let energy = columns_kept(&folder.join(ENERGY_FILE), energy)?;
    Ok(motion_rows(layout, &history, &energy)?)
}

/// The same from the texts of both files, `history.csv` first; `folder` is what messages name.
///
/// # Errors
/// When a file holds what is no row.
pub fn parse_rows(
    layout: &MotionLayout,
    [history, energy]: [&str; 2],
    folder: &Path,
) -> Result<Vec<MotionRow>, ReportError> {
    let columns =
        |text: &str, name| parse_columns(text).ok_or_else(|| ReportError::NoNumber { file: folder.join(name) });
    Ok(motion_rows(layout, &columns(history, HISTORY)?, &columns(energy, ENERGY_FILE)?)?)
}

/// Both files of rows.
#[derive(Debug)]
pub(crate) struct Rows {
    layout: MotionLayout,
    sheets: (Sheet<MotionRows>, Sheet<EnergyRows>),
    history: Growing,
    energy: Growing,
    line: String,
}

impl Rows {
    /// Fresh files in a folder.
    pub fn new(layout: &MotionLayout, folder: &Path) -> Result<Self, ReportError> {
        let sheets = sheets(layout);
        let history = Growing::new(folder.join(HISTORY), &sheets.0.header())?;
        let energy = Growing::new(folder.join(ENERGY_FILE), &sheets.1.header())?;
        Ok(Self { layout: *layout, sheets, history, energy, line: String::new() })
    }

    /// Whether both files in a folder begin with what was kept of them.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`], naming the file that does not.
    pub fn check(folder: &Path, [history, energy]: &[Kept; 2]) -> Result<(), CheckpointError> {
        digested(&folder.join(HISTORY), history)?;
        digested(&folder.join(ENERGY_FILE), energy).map(|_| ())
    }

    /// Files of before, cut to what was kept of them.
    pub fn resume(layout: &MotionLayout, folder: &Path, kept: &[Kept; 2]) -> Result<Self, ReportError> {
        let [history, energy] = [folder.join(HISTORY), folder.join(ENERGY_FILE)];
        // Both are looked at before either is cut.
        let digests = (digested(&history, &kept[0])?, digested(&energy, &kept[1])?);
        Ok(Self {
            layout: *layout,
            sheets: sheets(layout),
            history: Growing::resume(history, digests.0)?,
            energy: Growing::resume(energy, digests.1)?,
            line: String::new(),
        })
    }

    /// One row of each file.
    pub fn push(&mut self, row: &MotionRow) {
        self.line.clear();
        push_row(&mut self.line, self.sheets.0.row(&self.layout, row));
        self.history.push(&self.line);
        self.line.clear();
        push_row(&mut self.line, self.sheets.1.row(&(), &row.energy));
        self.energy.push(&self.line);
    }

    /// Writes out what is held back; what a checkpoint keeps of both files.
    pub fn flush(&mut self) -> Result<[Kept; 2], ReportError> {
        Ok([self.history.flush()?, self.energy.flush()?])
    }
}
