//! What can be wrong with a table.

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
        /// What it says.
        cause: ParquetError,
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
    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Parquet { .. } => "is the disk full? The rows are in the file with commas as well",
            Self::Damaged { .. } => "make the result again",
        }
    }
}
