//! Errors from mesh to factor.

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
    /// Poisson's ratio is outside the range of displacement elements.
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
    /// Diameters that do not make a round section.
    #[error("a section needs 0 <= inner < outer diameter, not {inner_mm} and {outer_mm} mm")]
    Section {
        /// Outer diameter, mm.
        outer_mm: f64,
        /// Inner diameter, mm.
        inner_mm: f64,
    },
    /// A length along a shaft that is not positive, or a position that is not on it.
    #[error("{length_mm} mm is no length of a shaft, or no place on it")]
    Length {
        /// The value given, mm.
        length_mm: f64,
    },
    /// The Jacobian of an element is not positive at an integration point.
    #[error("{kind} element {tag} is inverted or flat: det J = {det_j_mm3:.3e} mm^3")]
    Inverted {
        /// Kind of the element, such as `hex8`.
        kind: &'static str,
        /// Tag of the element in the file.
        tag: u64,
        /// Determinant of the Jacobian at this point, mm^3.
        det_j_mm3: f64,
    },
    /// An element names a node that the mesh does not have.
    #[error("element {tag} uses node {node}, but the mesh has {node_count} nodes")]
    NodeOutOfRange {
        /// Tag of the element in the file.
        tag: u64,
        /// The node that is named.
        node: u32,
        /// Number of nodes in the mesh.
        node_count: usize,
    },
    /// Connectivity and tags of a block of elements have inconsistent lengths.
    #[error("a block of {kind} has {connectivity} node numbers and {tags} tags")]
    RaggedBlock {
        /// Kind of the block's elements.
        kind: &'static str,
        /// Length of the connectivity list.
        connectivity: usize,
        /// Length of the tag list.
        tags: usize,
    },
    /// Two sizes that must agree differ.
    #[error("{what}: expected {expected}, found {found}")]
    Shape {
        /// Quantity whose size is wrong.
        what: &'static str,
        /// The size it should have.
        expected: usize,
        /// The size it has.
        found: usize,
    },
    /// An entry in a list of degrees of freedom is out of range or repeated.
    #[error("degree of freedom {dof} is out of range (0..{count}) or listed twice")]
    BadDof {
        /// The wrong entry.
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
    /// A stiffness matrix is not positive definite: some part can move freely.
    #[error(
        "stiffness is not positive definite at degree of freedom {dof}: pivot {pivot_ratio:.1e} of the diagonal entry"
    )]
    NotPositiveDefinite {
        /// Degree of freedom (matrix row) where elimination broke down.
        dof: usize,
        /// Pivot over diagonal entry in this row; not above zero, or as small as round-off.
        pivot_ratio: f64,
    },
    /// A symmetric indefinite matrix has no inverse.
    #[error("the matrix is singular at degree of freedom {dof}")]
    Singular {
        /// Degree of freedom (matrix row) where elimination broke down.
        dof: usize,
    },
    /// The iteration for the eigenvalues of a matrix did not converge.
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
        /// Status returned by METIS.
        status: i32,
    },
    /// The matrix is too large for 32-bit graph indices.
    #[error("{entries} graph entries are too many for the ordering (limit 2147483647)")]
    TooLarge {
        /// Number of entries requested.
        entries: usize,
    },
    /// The factor is no longer wanted by the caller ([`crate::unless_unwanted`]).
    #[error("nobody waits for this factor any more")]
    Unwanted,
    /// The factor does not fit into memory.
    #[error("out of memory: the factor needs {bytes} bytes")]
    OutOfMemory {
        /// Bytes requested.
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

/// Callback that tells whether the result of a long computation is still wanted. Threads share it.
pub type Wanted<'a> = &'a (dyn Fn() -> bool + Sync);

/// Returns an error, which ends the computation, if its result is no longer wanted.
///
/// # Errors
/// [`FemError::Unwanted`] if the result is no longer wanted.
pub fn unless_unwanted(wanted: Wanted<'_>) -> Result<(), FemError> {
    if wanted() { Ok(()) } else { Err(FemError::Unwanted) }
}
