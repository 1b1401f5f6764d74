//! What can go wrong in the reduction.

use geometry::Side;

/// The gear could not be reduced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReductionError {
    /// Elements, assembly or factor.
    #[error(transparent)]
    Fem(#[from] fem::FemError),
    /// The copies of a sector do not join.
    #[error("the sector's copies do not join: {said}")]
    Sector {
        /// What the mesh says.
        said: String,
        /// Advice of the source.
        hint: Option<String>,
    },
    /// The mesh has no such flank.
    #[error("the mesh has no {} flank of tooth {tooth}; it has teeth {available:?}", side.name())]
    MissingFlank {
        /// Tooth asked for.
        tooth: u32,
        /// Side asked for.
        side: Side,
        /// Teeth of which the mesh has flanks.
        available: Vec<u32>,
    },
    /// No node of the mesh lies on this fillet.
    #[error("the mesh has no node on the {} root fillet of tooth {tooth}, between root circle and root form circle", side.name())]
    MissingFillet {
        /// Tooth.
        tooth: u32,
        /// Side.
        side: Side,
    },
    /// Bore and flank meet.
    #[error("node {node} belongs to both the bore and the {} flank of tooth {tooth}", side.name())]
    BoreOnFlank {
        /// Node of the mesh.
        node: u64,
        /// Tooth.
        tooth: u32,
        /// Side.
        side: Side,
    },
    /// Coordinates of another window.
    #[error("{given} coordinates for a window of {wanted}")]
    WrongLength {
        /// Coordinates given.
        given: usize,
        /// Coordinates of the window.
        wanted: usize,
    },
    /// A condensed matrix is not positive definite.
    #[error("the compliance of the window from tooth {first} on is not positive definite")]
    NotPositiveDefinite {
        /// First tooth.
        first: u32,
    },
    /// Normal modes were not found.
    #[error("{converged} normal modes were found with {vectors} vectors, fewer than asked for")]
    ModesNotConverged {
        /// Modes found.
        converged: usize,
        /// Vectors that the search held.
        vectors: usize,
    },
    /// Flanks with more coordinates than a consistent boundary can have.
    #[error("a consistent boundary would have {coordinates} coordinates, {most} at most")]
    LargeBoundary {
        /// Coordinates of all flanks.
        coordinates: usize,
        /// Most that are possible.
        most: usize,
    },
    /// Faces of a bore that have no mean turn.
    #[error("the {faces} held faces of the bore are too small to hold the gear by their mean displacement and turn")]
    NoMeanTurn {
        /// Held faces.
        faces: usize,
    },
    /// A bore that is held by its means, of a gear that keeps all its freedoms.
    #[error(
        "a bore with the coupling `distributing` is held by its means, which a gear with all its freedoms does not know"
    )]
    NotReduced,
    /// More asked of a gear condensed by its layers than contact reads.
    #[error(
        "a gear of {layers} layers along the face is condensed by {condensed} of them, and has no fields, modes or stress of its whole width"
    )]
    Layers {
        /// Layers of the gear.
        layers: usize,
        /// Layers of the gear that was condensed.
        condensed: usize,
    },
    /// A gear that does not repeat tooth by tooth.
    #[error("a gear that is to be condensed by its layers must be one sector, which its copies join")]
    NoSectorOfLayers,
    /// Two reductions of a gear that is in several meshes.
    #[error("a gear in several meshes has another mesh, material, bore or way of reduction in one of them")]
    OtherReduction,
    /// Normal modes of one gear asked for on the flanks of another.
    #[error("the normal modes belong to another gear, or to another way of reducing it")]
    OtherGear,
}

impl From<mesh::MeshError> for ReductionError {
    fn from(e: mesh::MeshError) -> Self {
        Self::Sector { said: e.to_string(), hint: e.hint() }
    }
}

impl ReductionError {
    /// Whether the work ended because nobody waits for it any more.
    pub fn is_unwanted(&self) -> bool {
        matches!(self, Self::Fem(fem::FemError::Unwanted))
    }

    /// Whether the input has a meaning and no result came out.
    pub fn is_without_result(&self) -> bool {
        matches!(self, Self::ModesNotConverged { .. } | Self::OtherGear)
    }

    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Fem(e) => e.hint(),
            Self::Sector { hint, .. } => hint.clone(),
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
            Self::OtherGear => Some("compute the modes with the reducer that they are used with".into()),
            Self::NotPositiveDefinite { .. } => Some("run `ale-gear mesh check` on the mesh".into()),
        }
    }
}
