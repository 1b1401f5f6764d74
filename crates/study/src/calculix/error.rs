//! Errors of the comparison with CalculiX.

use std::path::PathBuf;

/// CalculiX gave no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalculixError {
    /// No program of this name is installed.
    #[error("CalculiX is not installed: no `{program}` in PATH")]
    NotInstalled {
        /// Name that was searched.
        program: String,
    },
    /// CalculiX does not have this element.
    #[error("CalculiX has no element like {kind}")]
    NoSuchElement {
        /// Element kind in the mesh.
        kind: &'static str,
    },
    /// A tooth of the pairs has no flank in its mesh.
    #[error("the {gear}'s mesh has no {side} flank of tooth {tooth}")]
    MissingFlank {
        /// Name of the gear, `pinion` or `wheel`.
        gear: &'static str,
        /// Side of the tooth, `left` or `right`.
        side: &'static str,
        /// Number of the tooth.
        tooth: u32,
    },
    /// The gear has another coupling, but the deck supports only rigid bores.
    #[error("the bore of the {gear} has the coupling `{coupling}`, and the deck has rigid bores")]
    SoftBore {
        /// Name of the gear, `pinion` or `wheel`.
        gear: &'static str,
        /// Name of the coupling.
        coupling: &'static str,
    },
    /// A value of the deck is out of range.
    #[error("{name} is {value}, expected {expected}")]
    OutOfRange {
        /// Name of the quantity, with its unit.
        name: &'static str,
        /// Value given.
        value: f64,
        /// The permitted range.
        expected: &'static str,
    },
    /// A file of the run cannot be written or read.
    #[error("{}: {source}", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Cause of the failure.
        source: std::io::Error,
    },
    /// CalculiX ended without results.
    #[error("CalculiX ended without a result: {said}")]
    NoResult {
        /// The last lines that it printed.
        said: String,
    },
}

impl CalculixError {
    /// Hint for the user: what to do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NotInstalled { .. } => {
                Some("install the package calculix-ccx, or give the path of the program".into())
            }
            Self::NoSuchElement { .. } => Some("use hex8, hex20, tet4, tet10, wedge6 or wedge15".into()),
            Self::MissingFlank { .. } => Some("mesh the whole gear, or more teeth".into()),
            Self::SoftBore { .. } => Some("take the coupling `kinematic`".into()),
            Self::OutOfRange { .. } => None,
            Self::File { .. } => Some("is the disk full, or the folder write-protected?".into()),
            Self::NoResult { .. } => Some("run `ccx` on the deck by hand and look at what it prints".into()),
        }
    }
}
