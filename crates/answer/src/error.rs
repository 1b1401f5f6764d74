//! What can be wrong with a table.

use std::{io, path::PathBuf};

use parquet::errors::ParquetError;
use thiserror::Error;

/// Why a table does not become a file, or a file no table.
#[derive(Debug, Error)]
pub enum TableError {
    /// The library that writes Parquet files refuses.
    #[error("{table}.parquet: {cause}")]
    Parquet {
        /// Name of the table.
        table: String,
        /// Error of the Parquet writer.
        cause: ParquetError,
    },
    /// The system refuses to write a Parquet file.
    #[error("{table}.parquet: cannot be written: {cause}")]
    Write {
        /// Name of the table.
        table: String,
        /// What the system says.
        cause: io::Error,
    },
    /// Rows that are more than memory is to hold cannot be put into a temporary file, or read from it.
    #[error("rows cannot be kept in the folder for temporary files, {}: {cause}", folder.display())]
    Kept {
        /// The folder.
        folder: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A text is no file of a table.
    #[error("{table}.csv: {what}")]
    Damaged {
        /// Name of the table.
        table: String,
        /// What is wrong.
        what: String,
    },
}

impl TableError {
    /// The error that the system refuses the file of rows.
    pub(crate) fn kept(cause: io::Error) -> Self {
        Self::Kept { folder: std::env::temp_dir(), cause }
    }

    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Parquet { .. } | Self::Write { .. } => {
                "is the disk full? The rows are in the file with commas as well"
            }
            Self::Kept { .. } => "is the disk full? `TMPDIR` names another folder; 10^6 rows take about 400 MB there",
            Self::Damaged { .. } => "make the result again",
        }
    }
}
