//! Why a solved position does not become a file or a view.

use fem::FemError;
use reduction::ReductionError;
use store::StoreError;

/// What is missing, or which file the system refuses.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A solved position of reduced gears without a window.
    #[error("the window is lost")]
    NoWindow,
    /// What is kept between runs.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A displacement field that cannot be recovered.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    /// A stress field that cannot be recovered.
    #[error(transparent)]
    Fem(#[from] FemError),
}

impl ExportError {
    /// What to do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NoWindow => None,
            Self::Store(e) => e.hint(),
            Self::Reduction(e) => e.hint(),
            Self::Fem(e) => e.hint(),
        }
    }
}
