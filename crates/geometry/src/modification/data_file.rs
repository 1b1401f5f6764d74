//! Tables of numbers in plain text: the part that topography files and pitch files have in common.

use std::path::{Path, PathBuf};

/// A file of measured values that cannot be read or parsed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DataFileError {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Cause of the failure.
        source: std::io::Error,
    },
    /// An unexpected word in the file.
    #[error("{}:{line}: expected {expected}, found `{found}`", path.display())]
    Syntax {
        /// Path of the file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is expected there.
        expected: &'static str,
        /// What was found there.
        found: String,
    },
    /// A row whose length differs from that of the other rows.
    #[error("{}:{line}: {found} values in this row, not {wanted}", path.display())]
    RowLength {
        /// Path of the file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Values found.
        found: usize,
        /// Values expected.
        wanted: usize,
    },
    /// Grid lines that do not ascend.
    #[error("{}:{line}: {name} must rise from value to value: {before} is followed by {value}", path.display())]
    Order {
        /// Path of the file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Name of the axis.
        name: &'static str,
        /// The preceding value.
        before: f64,
        /// The value that is not greater.
        value: f64,
    },
    /// Too few values.
    #[error("{}: {found} {what}, at least {wanted} are needed", path.display())]
    TooFew {
        /// Path of the file.
        path: PathBuf,
        /// Kind of value of which there are too few.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number needed.
        wanted: usize,
    },
}

impl DataFileError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Read { .. } => "paths are relative to the scene file".into(),
            Self::Syntax { .. } | Self::RowLength { .. } => {
                "numbers are separated by commas, semicolons or blanks, with a decimal point; `#` begins a comment"
                    .into()
            }
            Self::Order { .. } => "sort rows by diameter or roll angle and columns by z, both ascending".into(),
            Self::TooFew { .. } => "is the file complete?".into(),
        })
    }
}

/// Lines with anything on them: number from 1, words.
///
/// `#` begins a comment; words are separated by commas, semicolons, tabs or blanks.
pub(super) fn rows(text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
    text.trim_start_matches('\u{feff}').lines().enumerate().filter_map(|(i, line)| {
        let content = line.split('#').next().unwrap_or_default();
        let words: Vec<&str> =
            content.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|w| !w.is_empty()).collect();
        (!words.is_empty()).then_some((i + 1, words))
    })
}

/// A finite number.
pub(super) fn number(path: &Path, line: usize, word: &str) -> Result<f64, DataFileError> {
    word.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| DataFileError::Syntax {
        path: path.to_owned(),
        line,
        expected: "a number",
        found: word.to_owned(),
    })
}
