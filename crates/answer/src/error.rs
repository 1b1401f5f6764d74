//! What can be wrong with a table.

use parquet::errors::ParquetError;
use thiserror::Error;

/// Why a table does not become a file.
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
}

impl TableError {
    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Parquet { .. } => "is the disk full? The rows are in the file with commas as well",
        }
    }
}
