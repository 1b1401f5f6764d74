//! What a gearbox refuses, and what can go wrong on the way.

use fem::FemError;
use lumped::LumpedError;

/// Why shafts, bearings and gears cannot be put together or solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GearboxError {
    /// No shaft at all.
    #[error("there is no shaft")]
    NoShafts,
    /// The sections of a shaft make no sense.
    #[error("shaft {shaft}: {source}")]
    Shaft {
        /// Name of the shaft.
        shaft: String,
        /// What is wrong.
        source: FemError,
    },
    /// A part names a shaft that is not there.
    #[error("{part} is on shaft {shaft}, and there are {count} (they count from 0)")]
    NoShaft {
        /// Name of the part.
        part: String,
        /// The shaft it names.
        shaft: usize,
        /// How many there are.
        count: usize,
    },
    /// A part names a disc or gear that is not there.
    #[error("{part} is at disc {disc}, and there are {count} (they count from 0)")]
    NoDisc {
        /// Name of the part.
        part: String,
        /// The disc it names.
        disc: usize,
        /// How many there are.
        count: usize,
    },
    /// A part sits beside its shaft.
    #[error("{part} at {position_mm} mm is not on its shaft of {length_mm} mm")]
    OffShaft {
        /// Name of the part.
        part: String,
        /// Position, mm.
        position_mm: f64,
        /// Length of the shaft, mm.
        length_mm: f64,
    },
    /// A value is not a finite number, or below 0 where it must not be.
    #[error("{part}: {quantity} = {value} must be a number of 0 or more")]
    OutOfRange {
        /// Name of the part.
        part: String,
        /// The quantity, with its unit.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A stiffness or damping matrix that is not symmetric, or pushes where it should hold.
    #[error("{part}: {matrix} is not symmetric and free of negative stiffness: {off:.1e} of its largest entry")]
    NotElastic {
        /// Name of the part.
        part: String,
        /// Which of its matrices.
        matrix: &'static str,
        /// How far off it is, relative.
        off: f64,
    },
    /// A matrix between bearing seats of another size.
    #[error("the housing has {found} coordinates, and {bearings} bearings have {wanted}")]
    HousingSize {
        /// Rows or columns given.
        found: usize,
        /// Number of bearings.
        bearings: usize,
        /// Rows and columns that are needed.
        wanted: usize,
    },
    /// A list that should have one entry for each part.
    #[error("{found} {what} are given for {wanted}")]
    Count {
        /// What is counted.
        what: &'static str,
        /// How many are there.
        found: usize,
        /// How many are needed.
        wanted: usize,
    },
    /// Linear algebra of the whole.
    #[error(transparent)]
    Matrix(#[from] FemError),
    /// The line of action of a mesh.
    #[error("mesh {mesh}: {source}")]
    Mesh {
        /// Name of the mesh.
        mesh: String,
        /// What is wrong.
        source: LumpedError,
    },
}

impl GearboxError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        let text = match self {
            Self::NoShafts => "give one shaft at least",
            Self::Shaft { source, .. } => return source.hint(),
            Self::NoShaft { .. } | Self::NoDisc { .. } => {
                "shafts and discs are numbered in the order in which they are given"
            }
            Self::OffShaft { .. } => "positions count from the shaft's own beginning, its sections one after the other",
            Self::OutOfRange { .. } => {
                "inside are mm, N, t, s: 1 MN/m is 1000 N/mm, 1 kg is 0.001 t, 1 kg m^2 is 1000 t mm^2"
            }
            Self::NotElastic { .. } => {
                "elastic bearings and housings have symmetric matrices; the oil film of plain bearings, which has none, \
                 is not in these models"
            }
            Self::HousingSize { .. } => {
                "six coordinates a bearing, in the order of the bearings: x, y, z and the turns about them"
            }
            Self::Count { .. } => return None,
            Self::Matrix(FemError::NotPositiveDefinite { .. }) => {
                "does every shaft have mass, and is every shaft held in x, y, z and against tilting?"
            }
            Self::Matrix(source) => return source.hint(),
            Self::Mesh { source, .. } => return source.hint(),
        };
        Some(text.to_owned())
    }
}
