//! What can go wrong between a mesh and its factor.

/// Failure of a finite-element computation.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FemError {
    /// Young's modulus is not a positive number.
    #[error("Young's modulus must be positive and finite, not {young_mpa} MPa")]
    YoungNotPositive {
        /// The value given, MPa.
        young_mpa: f64,
    },
    /// Poisson's ratio outside of what displacement elements can do.
    #[error("Poisson's ratio must lie in (-1, 0.4999), not {poisson}")]
    PoissonOutOfRange {
        /// The value given.
        poisson: f64,
    },
    /// Density is not a positive number.
    #[error("density must be positive and finite, not {density_t_per_mm3} t/mm^3")]
    DensityNotPositive {
        /// The value given, t/mm^3.
        density_t_per_mm3: f64,
    },
    /// A round section that is none.
    #[error("a section needs 0 <= inner < outer diameter, not {inner_mm} and {outer_mm} mm")]
    Section {
        /// Outer diameter, mm.
        outer_mm: f64,
        /// Inner diameter, mm.
        inner_mm: f64,
    },
    /// A length along a shaft that is not positive, or a place that is not on it.
    #[error("{length_mm} mm is no length of a shaft, or no place on it")]
    Length {
        /// The value given, mm.
        length_mm: f64,
    },
    /// The Jacobian of an element is not positive at a point of integration.
    #[error("{kind} element {tag} is inverted or flat: det J = {det_j_mm3:.3e} mm^3")]
    Inverted {
        /// Kind of the element, for instance `hex8`.
        kind: &'static str,
        /// The file's tag of the element.
        tag: u64,
        /// Determinant of the Jacobian there, mm^3.
        det_j_mm3: f64,
    },
    /// An element names a node that the mesh does not have.
    #[error("element {tag} uses node {node}, but the mesh has {node_count} nodes")]
    NodeOutOfRange {
        /// The file's tag of the element.
        tag: u64,
        /// The node it names.
        node: u32,
        /// Number of nodes in the mesh.
        node_count: usize,
    },
    /// Element connectivity and tags of a block do not fit each other.
    #[error("a block of {kind} has {connectivity} node numbers and {tags} tags")]
    RaggedBlock {
        /// Kind of the block's elements.
        kind: &'static str,
        /// Length of the connectivity list.
        connectivity: usize,
        /// Length of the tag list.
        tags: usize,
    },
    /// Sizes that should agree do not.
    #[error("{what}: expected {expected}, found {found}")]
    Shape {
        /// What was measured.
        what: &'static str,
        /// The size it should have.
        expected: usize,
        /// The size it has.
        found: usize,
    },
    /// A list of degrees of freedom names one that is out of range or twice there.
    #[error("degree of freedom {dof} is out of range (0..{count}) or listed twice")]
    BadDof {
        /// The offending entry.
        dof: usize,
        /// Number of degrees of freedom.
        count: usize,
    },
    /// A matrix entry is not a finite number.
    #[error("matrix entry ({row}, {column}) is not finite")]
    NotFinite {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
    },
    /// A stiffness matrix is not positive definite: something can move freely.
    #[error(
        "stiffness is not positive definite at degree of freedom {dof}: pivot {pivot_ratio:.1e} of the diagonal entry"
    )]
    NotPositiveDefinite {
        /// Degree of freedom (matrix row) where elimination broke down.
        dof: usize,
        /// Pivot over diagonal entry there; not above zero, or as small as round-off.
        pivot_ratio: f64,
    },
    /// A symmetric indefinite matrix has no inverse.
    #[error("the matrix is singular at degree of freedom {dof}")]
    Singular {
        /// Degree of freedom (matrix row) where elimination broke down.
        dof: usize,
    },
    /// The search for the eigenvalues of a matrix did not end.
    #[error("no eigenvalues of a matrix of {size} rows were found")]
    NoEigenvalues {
        /// Rows of the matrix.
        size: usize,
    },
    /// The fill-reducing ordering failed.
    #[error("nested dissection of {nodes} nodes failed with METIS status {status}")]
    Ordering {
        /// Number of graph nodes.
        nodes: usize,
        /// Status METIS returned.
        status: i32,
    },
    /// The matrix is too large for 32-bit graph indices.
    #[error("{entries} graph entries are too many for the ordering (limit 2147483647)")]
    TooLarge {
        /// Number of entries asked for.
        entries: usize,
    },
    /// Nobody waits for the factor any more ([`crate::unless_unwanted`]).
    #[error("nobody waits for this factor any more")]
    Unwanted,
    /// The factor does not fit into memory.
    #[error("out of memory: the factor needs {bytes} bytes")]
    OutOfMemory {
        /// Bytes asked for.
        bytes: usize,
    },
}

impl FemError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        let text = match self {
            Self::YoungNotPositive { .. } => "steel has young_mpa = 2.06e5",
            Self::PoissonOutOfRange { .. } => {
                "steel has 0.3; nearly incompressible materials need mixed elements, which are not here"
            }
            Self::DensityNotPositive { .. } => "steel has 7.85e-9 t/mm^3 (7850 kg/m^3)",
            Self::Section { .. } => "a solid shaft has inner diameter 0",
            Self::Length { .. } => "shafts begin at z = 0, and every segment is longer than nothing",
            Self::Inverted { .. } => "check the node order of that element, or mesh the region more evenly",
            Self::NodeOutOfRange { .. } | Self::RaggedBlock { .. } => {
                "read the mesh again: its connectivity is damaged"
            }
            Self::NotPositiveDefinite { .. } => {
                "is the bore fixed, and are there parts of the mesh that hang on nothing?"
            }
            Self::Singular { .. } => "is some body free to move, or is one constraint given twice?",
            Self::TooLarge { .. } | Self::OutOfMemory { .. } => {
                "take a coarser mesh, or a cyclic sector instead of the whole gear"
            }
            Self::NoEigenvalues { .. } => "are stiffnesses, masses and damping in their units?",
            Self::NotFinite { .. } => "does the mesh have coordinates that are not numbers?",
            Self::Shape { .. } | Self::BadDof { .. } | Self::Ordering { .. } | Self::Unwanted => return None,
        };
        Some(text.to_owned())
    }
}

/// Whether the answer of a long computation is still wanted; threads share it.
pub type Wanted<'a> = &'a (dyn Fn() -> bool + Sync);

/// Ends a computation whose answer nobody waits for any more.
///
/// # Errors
/// [`FemError::Unwanted`].
pub fn unless_unwanted(wanted: Wanted<'_>) -> Result<(), FemError> {
    if wanted() { Ok(()) } else { Err(FemError::Unwanted) }
}
