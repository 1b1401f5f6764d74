//! What may be wrong with a file of a measured gear.

use std::path::PathBuf;

/// A measured gear that cannot be read or used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MetrologyError {
    /// A word that is none of those that may stand there.
    #[error("{}:{line}: expected {expected}, found `{found}`", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What may stand there.
        expected: &'static str,
        /// What does.
        found: String,
    },
    /// A trace with another number of values than its heading says.
    #[error("{}:{line}: the trace that begins here has {found} values, its heading says {wanted}", path.display())]
    Count {
        /// The file.
        path: PathBuf,
        /// Line of the heading, from 1.
        line: usize,
        /// Values found.
        found: usize,
        /// Values that the heading tells of.
        wanted: usize,
    },
    /// A file that lacks something.
    #[error("{}: {what} is missing", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// What.
        what: &'static str,
    },
    /// XML that is none.
    #[error("{}:{line}: {message}", path.display())]
    Xml {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What the parser says.
        message: String,
    },
    /// A map of names that lacks one, or has one that is not known.
    #[error("{}:{line}: {message}", path.display())]
    Names {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What the parser says.
        message: String,
    },
    /// A deviation that no flank has.
    #[error("{}: {what} of tooth {tooth}, {side}: {um} um is more than a quarter of the module ({most_um:.0} um)", path.display())]
    Deviation {
        /// The file.
        path: PathBuf,
        /// What deviates.
        what: &'static str,
        /// Tooth, from 1, as files count.
        tooth: u32,
        /// Side of the tooth.
        side: &'static str,
        /// The deviation, um.
        um: f64,
        /// The largest that is taken, um.
        most_um: f64,
    },
    /// A measured gear that is another one than the gear it is used for.
    #[error("the measured gear has {name} {measured}, the gear {own}")]
    OtherGear {
        /// Which quantity, with its unit.
        name: &'static str,
        /// Value of the file.
        measured: f64,
        /// Value of the gear.
        own: f64,
    },
    /// Traces that nothing can be made of.
    #[error("{what}")]
    Unusable {
        /// Why.
        what: &'static str,
    },
    /// A topography that the flank cannot have.
    #[error(transparent)]
    Geometry(#[from] geometry::GeometryError),
}

impl MetrologyError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Syntax { found, .. } if found.contains(',') => Some("numbers have a decimal point".into()),
            Self::Syntax { .. } | Self::Count { .. } => {
                Some("is the file complete and of the kind that it is read as?".into())
            }
            Self::Missing { .. } => Some("export header, ranges and curves into one file".into()),
            Self::Xml { .. } => Some("with `--names` the file is XML; a curve file (MKA) is read without".into()),
            Self::Deviation { .. } => Some(
                "where the number stands for no value, say so: by the line `UNDEFINED` of a curve file, by `undefined` in the file of `--names`".into(),
            ),
            Self::Names { .. } => Some(
                "keys: teeth, normal_module, helix_angle, pressure_angle, profiles, helices, tooth, first_tooth, side, left, right, place, from, to, values, undefined".into(),
            ),
            Self::OtherGear { .. } => Some("is it the file of this gear?".into()),
            Self::Unusable { .. } => Some("correct the header of the file, or measure profiles or helices on at least one tooth".into()),
            Self::Geometry(e) => e.hint(),
        }
    }
}
