//! What may go wrong between a result and its files.

use std::path::PathBuf;

use columns::ColumnsError;
use scene::SceneError;
use study::StudyError;

use store::StoreError;

/// Which file, and why.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A table does not become a file.
    #[error(transparent)]
    Table(#[from] answer::TableError),
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
    /// A page does not come out: a template that cannot be filled is a fault of this program.
    #[error("{file}: {cause}")]
    Page {
        /// The file.
        file: &'static str,
        /// What the template or the packing says.
        cause: String,
    },
    /// No running pair can be made of the scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// What is kept between runs.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A file of rows cannot be read back.
    #[error(transparent)]
    Columns(#[from] ColumnsError),
    /// A record that no statistics can be made of.
    #[error(transparent)]
    Study(#[from] StudyError),
}

impl ReportError {
    /// What to do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NoMarks { marks, .. } => Some(format!("put the two lines {marks} where the tables shall stand")),
            Self::NoResult { hint, .. } => Some((*hint).to_owned()),
            Self::Page { .. } => None,
            Self::Table(e) => Some(e.hint().to_owned()),
            Self::Store(e) => e.hint(),
            Self::Columns(e) => Some(e.hint().to_owned()),
            Self::Scene(e) => e.hint(),
            Self::Study(e) => e.hint(),
        }
    }
}
