//! What can go wrong in contact.

/// Contact could not be set up or solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactError {
    /// A node of a flank face does not lie on the flank's smooth surface.
    #[error(
        "node {node} of {patch} is {distance_mm:.4} mm away from the flank's smooth surface (allowed: {tolerance_mm:.4} mm)"
    )]
    OffSurface {
        /// Which flank.
        patch: String,
        /// Node of the mesh.
        node: u32,
        /// Its distance, mm.
        distance_mm: f64,
        /// Largest distance allowed, mm.
        tolerance_mm: f64,
    },
    /// No point of the one body comes near the other.
    #[error("no flank point is within {reach_mm} mm of the other gear")]
    NoCandidates {
        /// Search distance, mm.
        reach_mm: f64,
    },
    /// The set of points in contact did not settle.
    #[error("contact did not converge after {iterations} iterations: {infeasible} points of {points} still change")]
    NotConverged {
        /// Active-set iterations.
        iterations: usize,
        /// Points that violate the contact conditions.
        infeasible: usize,
        /// Points in all.
        points: usize,
    },
    /// The load cannot be carried by the points at hand.
    #[error("no contact point can carry the torque: the largest lever is {lever_mm:.3e} mm")]
    NoLever {
        /// Largest lever arm, mm.
        lever_mm: f64,
    },
    /// A linear solve failed.
    #[error("the contact compliance of {points} points is not positive definite")]
    NotPositiveDefinite {
        /// Points in the system.
        points: usize,
    },
    /// The caller's elastic model failed.
    #[error("the elastic model failed: {0}")]
    Elastic(String),
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
            Self::NoLever { .. } => "the contact normals point at the axis: check the flank groups".into(),
            Self::NotPositiveDefinite { .. } => "the mesh compliance is damaged: run `ale-gear mesh check`".into(),
            Self::Elastic(_) => return None,
        })
    }
}
