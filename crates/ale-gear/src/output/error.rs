//! What the command says when a file of a result does not come out.

use report::ReportError;

use crate::error::CommandError;

impl From<ReportError> for CommandError {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Scene(e) => e.into(),
            ReportError::Folder { .. } => Self::input(format_args!("--out {error}"), error.hint()),
            ReportError::NoResult { .. } => Self::input(&error, error.hint()),
            _ => Self::failed(&error, error.hint()),
        }
    }
}
