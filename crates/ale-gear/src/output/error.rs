//! What the command says when a file of a result does not come out.

use columns::ColumnsError;
use export::ExportError;
use report::ReportError;
use store::{MemoryDemandError, StoreError, checkpoint::CheckpointError};

use crate::error::CommandError;

impl From<ReportError> for CommandError {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Scene(e) => e.into(),
            ReportError::Store(e) => e.into(),
            ReportError::Columns(e) => e.into(),
            ReportError::NoResult { .. } | ReportError::NoMarks { .. } => Self::input(&error, error.hint()),
            _ => Self::failed(&error, error.hint()),
        }
    }
}

impl From<ExportError> for CommandError {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Store(e) => e.into(),
            _ => Self::failed(&error, error.hint()),
        }
    }
}

impl From<StoreError> for CommandError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Folder { .. } => Self::input(format_args!("--out {error}"), error.hint()),
            StoreError::Checkpoint(_) => Self::input(&error, error.hint()),
            _ => Self::failed(&error, error.hint()),
        }
    }
}

impl From<CheckpointError> for CommandError {
    fn from(error: CheckpointError) -> Self {
        StoreError::from(error).into()
    }
}

impl From<ColumnsError> for CommandError {
    fn from(error: ColumnsError) -> Self {
        Self::failed(&error, Some(error.hint().to_owned()))
    }
}

impl From<Box<MemoryDemandError>> for CommandError {
    fn from(error: Box<MemoryDemandError>) -> Self {
        let hint = error.hint();
        Self::input(&error, Some(hint)).about(error.excerpt.as_deref())
    }
}
