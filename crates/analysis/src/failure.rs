//! Why an attempt with one width of the window failed.

use ltca::StaticError;
use scene::Scene;

use crate::{AnalysisError, solver_error};

/// Why an attempt with one width of the window failed.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The solver's own error, which another width may cure.
    Static(StaticError),
    /// Anything else.
    Analysis(Box<AnalysisError>),
}

impl Failure {
    /// The error of the analysis.
    pub fn into_error(self, scene: &Scene) -> AnalysisError {
        match self {
            Self::Static(e) => solver_error(scene, e),
            Self::Analysis(e) => *e,
        }
    }
}

impl From<AnalysisError> for Failure {
    fn from(e: AnalysisError) -> Self {
        Self::Analysis(Box::new(e))
    }
}

impl From<StaticError> for Failure {
    fn from(e: StaticError) -> Self {
        Self::Static(e)
    }
}
