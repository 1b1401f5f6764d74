//! Errors of the reduction.

use geometry::Side;

/// Reasons for which a gear cannot be reduced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReductionError {
    /// Error of elements, assembly or factor.
    #[error(transparent)]
    Fem(#[from] fem::FemError),
    /// The copies of a sector cannot be joined.
    #[error("the sector's copies do not join: {said}")]
    Sector {
        /// Message of the mesh error.
        said: String,
        /// Hint of the mesh error.
        hint: Option<String>,
    },
    /// The springs under a bore do not fit its mesh.
    #[error("{said}")]
    Bore {
        /// Message of the mesh error.
        said: String,
        /// Hint of the mesh error.
        hint: Option<String>,
    },
    /// The mesh does not have this flank.
    #[error("the mesh has no {} flank of tooth {tooth}; it has teeth {available:?}", side.name())]
    MissingFlank {
        /// Tooth requested.
        tooth: u32,
        /// Side requested.
        side: Side,
        /// Teeth with flanks in the mesh.
        available: Vec<u32>,
    },
    /// No node of the mesh lies on this fillet.
    #[error("the mesh has no node on the {} root fillet of tooth {tooth}, between root circle and root form circle", side.name())]
    MissingFillet {
        /// Number of the tooth.
        tooth: u32,
        /// Side of the tooth.
        side: Side,
    },
    /// Bore and flank share a node.
    #[error("node {node} belongs to both the bore and the {} flank of tooth {tooth}", side.name())]
    BoreOnFlank {
        /// Tag of the node.
        node: u64,
        /// Number of the tooth.
        tooth: u32,
        /// Side of the tooth.
        side: Side,
    },
    /// The number of coordinates is that of another window.
    #[error("{given} coordinates for a window of {wanted}")]
    WrongLength {
        /// Number of coordinates given.
        given: usize,
        /// Number of coordinates of the window.
        wanted: usize,
    },
    /// A condensed matrix is not positive definite.
    #[error("the compliance of the window from tooth {first} on is not positive definite")]
    NotPositiveDefinite {
        /// First tooth of the window.
        first: u32,
    },
    /// The normal modes did not converge.
    #[error("{converged} normal modes were found with {vectors} vectors, fewer than asked for")]
    ModesNotConverged {
        /// Number of modes found.
        converged: usize,
        /// Number of vectors in the search space.
        vectors: usize,
    },
    /// The flanks have more coordinates than a consistent boundary can have.
    #[error("a consistent boundary would have {coordinates} coordinates, {most} at most")]
    LargeBoundary {
        /// Number of coordinates of all flanks.
        coordinates: usize,
        /// Largest possible number.
        most: usize,
    },
    /// The held faces of a bore do not define a mean rotation.
    #[error("the {faces} held faces of the bore are too small to hold the gear by their mean displacement and turn")]
    NoMeanTurn {
        /// Number of held faces.
        faces: usize,
    },
    /// A distributing coupling of the bore, on a gear with all its degrees of freedom.
    #[error(
        "a bore with the coupling `distributing` is held by its means, which a gear with all its freedoms does not know"
    )]
    NotReduced,
    /// A gear condensed by its layers was asked for a result that contact does not need.
    #[error(
        "a gear of {layers} layers along the face is condensed by {condensed} of them, and has no fields, modes or stress of its whole width"
    )]
    Layers {
        /// Number of layers of the gear.
        layers: usize,
        /// Number of layers of the shorter gear that was condensed.
        condensed: usize,
    },
    /// Condensation by layers of a gear whose teeth are not all equal.
    #[error("a gear that is to be condensed by its layers must be one sector, which its copies join")]
    NoSectorOfLayers,
    /// Two reductions of a gear that is in several meshes.
    #[error("a gear in several meshes has another mesh, material, bore or way of reduction in one of them")]
    OtherReduction,
    /// Pressures on a bore that does not take them.
    #[error("rolling elements press a bore with the coupling `distributing`, and this one is `{coupling}`")]
    NoBorePressures {
        /// Coupling of the bore.
        coupling: &'static str,
    },
    /// What bolts do was asked of a gear without any.
    #[error("the bore of the gear has no bolts")]
    NoBolts,
    /// Normal modes of one gear were requested on the flanks of another.
    #[error("the normal modes belong to another gear, or to another way of reducing it")]
    OtherGear,
}

impl From<mesh::MeshError> for ReductionError {
    fn from(e: mesh::MeshError) -> Self {
        Self::Sector { said: e.to_string(), hint: e.hint() }
    }
}

impl ReductionError {
    /// An error of the springs under a bore.
    pub(crate) fn bore(e: mesh::MeshError) -> Self {
        Self::Bore { said: e.to_string(), hint: e.hint() }
    }

    /// Whether the work was cancelled because its result is no longer wanted.
    pub fn is_unwanted(&self) -> bool {
        matches!(self, Self::Fem(fem::FemError::Unwanted))
    }

    /// Whether the input is valid but no result was found.
    pub fn is_without_result(&self) -> bool {
        matches!(self, Self::ModesNotConverged { .. } | Self::OtherGear)
    }

    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Fem(e) => e.hint(),
            Self::Sector { hint, .. } | Self::Bore { hint, .. } => hint.clone(),
            Self::MissingFlank { available, .. } => Some(format!(
                "the window slides over {} teeth of the mesh: mesh the whole gear, or run fewer cycles or a narrower window",
                available.len()
            )),
            Self::MissingFillet { .. } => Some(
                "root and tip of the mesh must be those of the gear data (dedendum, root radius, tooth 0 on +x); or leave \
                 root stress out"
                    .into(),
            ),
            Self::BoreOnFlank { .. } => Some("check the physical groups of the mesh".into()),
            Self::WrongLength { .. } => None,
            Self::ModesNotConverged { .. } => Some("ask for fewer modes, or for a lower bound of their frequencies".into()),
            Self::LargeBoundary { .. } => {
                Some("take the massless boundary, or coarse grids over the flanks, or a mesh that is cyclic".into())
            }
            Self::NoMeanTurn { .. } => {
                Some("hold a larger part of the bore (`held_mm`), or take the coupling `kinematic`".into())
            }
            Self::NotReduced => Some("take `model = \"reduced\"`, or the coupling `kinematic`".into()),
            Self::Layers { .. } => {
                Some("take the general way (`reduction = \"general\"` in [analysis]), or a narrower gear".into())
            }
            Self::NoSectorOfLayers => None,
            Self::OtherReduction => {
                Some("give it the same mesh, `[mesher]`, bore, material and `reduction` in the scenes of all its meshes".into())
            }
            Self::NoBorePressures { .. } => {
                Some("give the bore of the gear `coupling = \"distributing\"` in the scenes of all its meshes".into())
            }
            Self::NoBolts => Some("give the bore `coupling = \"elastic\"` and a table `bolts`".into()),
            Self::OtherGear => Some("compute the modes with the reducer that they are used with".into()),
            Self::NotPositiveDefinite { .. } => Some("run `ale-gear mesh check` on the mesh".into()),
        }
    }
}
