//! Why something cannot be kept, or taken up again.

use std::{io, path::PathBuf};

use answer::TableError;
use columns::ColumnsError;
use study::StudyError;

use crate::checkpoint::CheckpointError;

/// Which file or folder, and why.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The system refuses to write a file.
    #[error("{}: cannot be written: {cause}", file.display())]
    Write {
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
    /// Rows that were kept cannot be read back.
    #[error(transparent)]
    Columns(#[from] ColumnsError),
    /// Rows that were kept are not those of the motion.
    #[error(transparent)]
    Rows(#[from] StudyError),
    /// A table does not become a file.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A run that cannot go on from a checkpoint.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

impl StoreError {
    /// What to do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Write { .. } => Some("is the disk full, or the folder write-protected?".to_owned()),
            Self::Folder { hint, .. } => Some((*hint).to_owned()),
            Self::Columns(e) => Some(e.hint().to_owned()),
            Self::Rows(e) => e.hint(),
            Self::Table(e) => Some(e.hint().to_owned()),
            Self::Checkpoint(e) => e.hint(),
        }
    }
}
