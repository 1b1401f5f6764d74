//! How a gear's bore follows its shaft.

/// Coupling of the bore to the shaft, with the names that finite-element programs use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BoreCoupling {
    /// Every node of the bore moves with the shaft's cross-section: a rigid bore.
    #[default]
    Kinematic,
    /// The bore is free to deform; its area-weighted mean displacement and mean rotation are those of the shaft.
    ///
    /// ```text
    /// integral of u dA = 0,   integral of (x - c) x u dA = 0      in the gear's frame; c: centroid of the held faces
    /// ```
    /// The holding force is spread over the bore as a traction t = a + b x (x - c): six numbers, no local reaction.
    Distributing,
}

impl BoreCoupling {
    /// Name used in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kinematic => "kinematic",
            Self::Distributing => "distributing",
        }
    }
}
