//! Errors of contact.

/// Contact cannot be set up or solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactError {
    /// A node of a flank face does not lie on the flank's smooth surface.
    #[error(
        "node {node} of {patch} is {distance_mm:.4} mm away from the flank's smooth surface (allowed: {tolerance_mm:.4} mm)"
    )]
    OffSurface {
        /// Name of the flank.
        patch: String,
        /// Number of the node.
        node: u32,
        /// Distance of the node, mm.
        distance_mm: f64,
        /// Tolerance for the distance, mm.
        tolerance_mm: f64,
    },
    /// A node of a flank is not among the nodes of the gear's matrices.
    #[error("node {node} of {patch} is no boundary node of the gear's matrices")]
    NotOnBoundary {
        /// Name of the flank.
        patch: String,
        /// Number of the node.
        node: u32,
    },
    /// No point of one body is near the other.
    #[error("no flank point is within {reach_mm} mm of the other gear")]
    NoCandidates {
        /// Search distance, mm.
        reach_mm: f64,
    },
    /// The active set did not converge.
    #[error("contact did not converge after {iterations} iterations: {infeasible} points of {points} still change")]
    NotConverged {
        /// Active-set iterations.
        iterations: usize,
        /// Number of points that violate the contact conditions.
        infeasible: usize,
        /// Total number of points.
        points: usize,
    },
    /// The available points cannot carry the load.
    #[error("no contact point can carry the torque: the largest lever is {lever_mm:.3e} mm")]
    CannotCarryTorque {
        /// Largest lever arm, mm.
        lever_mm: f64,
    },
    /// A linear solve failed.
    #[error("the contact compliance of {points} points is not positive definite")]
    NotPositiveDefinite {
        /// Number of points in the system.
        points: usize,
    },
    /// The stiffness of a whole gear cannot be factored or solved.
    #[error("the elastic model failed: {0}")]
    Stiffness(#[from] fem::FemError),
    /// One gear is reduced and the other is not.
    #[error("one gear is reduced, the other is not")]
    MixedGears,
    /// Forces at given poses were requested for contact other than slices on reduced gears.
    #[error("forces at given poses need slice contact on reduced gears")]
    NotSliced,
    /// Normal modes were requested for a gear that is not reduced.
    #[error("{gear}: normal modes need a reduced gear, and this one keeps all its degrees of freedom")]
    ModesOnFullGear {
        /// Name of the gear, `pinion` or `wheel`.
        gear: &'static str,
    },
    /// A gear has no matrices for the window.
    #[error("{gear}: {source}")]
    Reduction {
        /// Name of the gear, `pinion` or `wheel`.
        gear: &'static str,
        /// Error of the reduction.
        source: reduction::ReductionError,
    },
    /// The flanks of a gear's mesh do not match its geometry.
    #[error("{gear}: {source}")]
    Flank {
        /// Name of the gear, `pinion` or `wheel`.
        gear: &'static str,
        /// Error of the contact.
        source: Box<ContactError>,
    },
    /// The table of a gear condensed by its layers is not accurate enough.
    #[error("the compliance of a gear condensed by its layers is off by {error:.1e} of itself, {most:.1e} at most")]
    Layers {
        /// Relative error of the table.
        error: f64,
        /// Largest permitted error.
        most: f64,
    },
    /// A value outside its range.
    #[error("{name} = {value} is out of range: {expected}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The permitted range.
        expected: &'static str,
    },
}

impl From<reduction::ReductionError> for ContactError {
    fn from(source: reduction::ReductionError) -> Self {
        Self::Reduction { gear: "gear", source }
    }
}

impl ContactError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::OffSurface { .. } => {
                "the scene's gear data and the mesh must describe the same gear: check module, helix angle (hand), profile \
                 shift, thickness allowance, and that tooth 0 points along +x"
                    .into()
            }
            Self::NoCandidates { .. } => "check centre distance, hands of helix and the flank groups of the meshes".into(),
            Self::NotConverged { .. } => "try a finite penalty (contact.penalty_mpa_per_mm) or other points_per_face_edge".into(),
            Self::CannotCarryTorque { .. } => "the contact normals point at the axis: check the flank groups".into(),
            Self::NotPositiveDefinite { .. } => "the mesh compliance is damaged: run `ale-gear mesh check`".into(),
            Self::Reduction { source, .. } => return source.hint(),
            Self::Flank { source, .. } => return source.hint(),
            Self::NotOnBoundary { .. } => "the flank groups of the mesh must not reach into its clamped bore".into(),
            Self::ModesOnFullGear { .. } => "use `model = \"reduced+modes\"`, or leave out the modes".into(),
            Self::NotSliced => "use `contact.method = \"slice\"`".into(),
            Self::Layers { .. } => "take the general way (`reduction = \"general\"` in [analysis]), or a finer mesh".into(),
            Self::OutOfRange { name, expected, .. } => format!("give {name} {expected}"),
            Self::Stiffness(_) | Self::MixedGears => return None,
        })
    }
}
