//! Why a failure mode could not be examined.

use analysis::AnalysisError;
use answer::TableError;
use scene::SceneError;

/// Why a failure mode could not be examined. What a mode is about is no error but a value of a figure.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EnvelopeError {
    /// The mode's scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A scene that has to be solved is not.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// A piece of its own cannot be built or solved.
    #[error("{piece}: {reason}")]
    Piece {
        /// Which one.
        piece: &'static str,
        /// What was said.
        reason: String,
    },
}

impl From<TableError> for EnvelopeError {
    fn from(e: TableError) -> Self {
        Self::Analysis(e.into())
    }
}

impl EnvelopeError {
    /// Error of a piece that a mode builds beside its scene.
    pub(crate) fn piece(piece: &'static str, reason: impl ToString) -> Self {
        Self::Piece { piece, reason: reason.to_string() }
    }

    /// For `map_err`.
    pub(crate) fn of<E: ToString>(piece: &'static str) -> impl Fn(E) -> Self {
        move |reason| Self::piece(piece, reason.to_string())
    }
}
