//! Surfaces between which gaps are measured.

/// Surfaces between which a gap is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GapSource {
    /// The smooth flanks.
    #[default]
    Smooth,
    /// The finite-element faces themselves. This shows the facet error h^2 / (8 rho) and is for study only.
    Facet,
}
