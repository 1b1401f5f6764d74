//! What can go wrong between this program and CalculiX.

use std::path::PathBuf;

/// No result came out of CalculiX.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalculixError {
    /// There is no program of that name.
    #[error("CalculiX is not installed: no `{program}` in PATH")]
    NotInstalled {
        /// Name looked for.
        program: String,
    },
    /// CalculiX has no such element.
    #[error("CalculiX has no element like {kind}")]
    NoSuchElement {
        /// Kind in the mesh.
        kind: &'static str,
    },
    /// A tooth of the pairs has no flank in its mesh.
    #[error("the {gear}'s mesh has no {side} flank of tooth {tooth}")]
    MissingFlank {
        /// `pinion` or `wheel`.
        gear: &'static str,
        /// `left` or `right`.
        side: &'static str,
        /// Tooth.
        tooth: u32,
    },
    /// The deck has rigid bores.
    #[error("the bore of the {gear} has the coupling `distributing`, and the deck has rigid bores")]
    MeanBore {
        /// `pinion` or `wheel`.
        gear: &'static str,
    },
    /// A value of the deck has no meaning.
    #[error("{name} is {value}, expected {expected}")]
    OutOfRange {
        /// What, with its unit.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What would have a meaning.
        expected: &'static str,
    },
    /// A file of the run cannot be written or read.
    #[error("{}: {source}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// It ended without results.
    #[error("CalculiX ended without a result: {said}")]
    NoResult {
        /// The last lines it printed.
        said: String,
    },
}

impl CalculixError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NotInstalled { .. } => {
                Some("install the package calculix-ccx, or give the path of the program".into())
            }
            Self::NoSuchElement { .. } => Some("use hex8, hex20, tet4, tet10, wedge6 or wedge15".into()),
            Self::MissingFlank { .. } => Some("mesh the whole gear, or more teeth".into()),
            Self::MeanBore { .. } => Some("take the coupling `kinematic`".into()),
            Self::OutOfRange { .. } => None,
            Self::File { .. } => Some("is the disk full, or the folder write-protected?".into()),
            Self::NoResult { .. } => Some("run `ccx` on the deck by hand and look at what it prints".into()),
        }
    }
}
