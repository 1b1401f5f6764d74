//! Why a file of rows cannot be read back.

use std::{io, path::PathBuf};

/// Why a file of rows cannot be read back.
#[derive(Debug, thiserror::Error)]
pub enum ColumnsError {
    /// The system refuses.
    #[error("{}: cannot be read: {cause}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// It contains a value that is not a number.
    #[error("{}: contains a value that is not a number", file.display())]
    NoNumber {
        /// The file.
        file: PathBuf,
    },
}

impl ColumnsError {
    /// What to do next.
    pub fn hint(&self) -> &'static str {
        "does another program write into the folder?"
    }
}
