//! What the command says when a file of a result does not come out.

use store::MemoryDemandError;
use store::checkpoint::CheckpointError;
use report::ReportError;

use crate::error::CommandError;

impl From<ReportError> for CommandError {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Scene(e) => e.into(),
            ReportError::Folder { .. } => Self::input(format_args!("--out {error}"), error.hint()),
            ReportError::NoResult { .. } | ReportError::NoMarks { .. } | ReportError::Checkpoint(_) => {
                Self::input(&error, error.hint())
            }
            _ => Self::failed(&error, error.hint()),
        }
    }
}

impl From<CheckpointError> for CommandError {
    fn from(error: CheckpointError) -> Self {
        ReportError::from(error).into()
    }
}

impl From<Box<MemoryDemandError>> for CommandError {
    fn from(error: Box<MemoryDemandError>) -> Self {
        let hint = error.hint();
        Self::input(&error, Some(hint)).about(error.excerpt.as_deref())
    }
}
