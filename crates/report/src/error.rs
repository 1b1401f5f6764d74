//! What may go wrong between a result and its files.

use std::{io, path::PathBuf};

use fem::FemError;
use parquet::errors::ParquetError;
use reduction::ReductionError;
use scene::SceneError;
use study::StudyError;

use crate::checkpoint::CheckpointError;

/// Which file, and why.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The system refuses to write a file.
    #[error("{}: cannot be written: {cause}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A table does not become a file.
    #[error(transparent)]
    Table(#[from] answer::TableError),
    /// The system refuses to read a file of this result back.
    #[error("{}: cannot be read: {cause}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A folder that results cannot go into.
    #[error("{}: {what}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What is wrong with it.
        what: String,
        /// What to do next.
        hint: &'static str,
    },
    /// A document that tables are to go into has no place for them.
    #[error("--into {}: {what}", file.display())]
    NoMarks {
        /// The document.
        file: PathBuf,
        /// What is wrong with it.
        what: String,
        /// The two lines that should be there.
        marks: String,
    },
    /// A file of rows holds what is no number.
    #[error("{}: holds what is no number", file.display())]
    NoNumber {
        /// The file.
        file: PathBuf,
    },
    /// A folder or a file that was named as a result is none that can be read.
    #[error("{}: {what}", file.display())]
    NoResult {
        /// The folder or the file.
        file: PathBuf,
        /// What is wrong with it.
        what: String,
        /// What to do next.
        hint: &'static str,
    },
    /// A Parquet file does not come out.
    #[error("{file}: {cause}")]
    Parquet {
        /// The file.
        file: &'static str,
        /// What does not fit.
        cause: ParquetError,
    },
    /// A page does not come out: a template that cannot be filled is a fault of this program.
    #[error("{file}: {cause}")]
    Page {
        /// The file.
        file: &'static str,
        /// What the template or the packing says.
        cause: String,
    },
    /// A solved position of reduced gears without a window.
    #[error("the window is lost")]
    NoWindow,
    /// No running pair can be made of the scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A run that cannot go on from a checkpoint.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A record that no statistics can be made of.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A displacement field that cannot be recovered.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    /// A stress field that cannot be recovered.
    #[error(transparent)]
    Fem(#[from] FemError),
}

impl ReportError {
    /// What to do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Write { .. } | Self::Parquet { .. } => {
                Some("is the disk full, or the folder write-protected?".to_owned())
            }
            Self::Read { .. } | Self::NoNumber { .. } => Some("does another program write into the folder?".to_owned()),
            Self::NoMarks { marks, .. } => Some(format!("put the two lines {marks} where the tables shall stand")),
            Self::NoResult { hint, .. } | Self::Folder { hint, .. } => Some((*hint).to_owned()),
            Self::Page { .. } | Self::NoWindow => None,
            Self::Table(e) => Some(e.hint().to_owned()),
            Self::Checkpoint(e) => e.hint(),
            Self::Scene(e) => e.hint(),
            Self::Study(e) => e.hint(),
            Self::Reduction(e) => e.hint(),
            Self::Fem(e) => e.hint(),
        }
    }
}
