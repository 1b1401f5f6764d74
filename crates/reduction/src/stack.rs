//! A wide gear that is one layer of elements after another: a shorter gear of the same layers tells what contact reads.

/// How the layers of a wide gear are told from those of a shorter one.
///
/// Every layer of elements along the face is the one before it, moved along the axis and turned with the helix. Held
/// along its whole bore, the gear answers a force near by alone: some rim thicknesses away it does not move. Compliance
/// between two places is that of a shorter gear with the same distances to the nearer end faces, where it is as good as
/// none beyond its width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LayerStack {
    /// Layers of the gear.
    pub layers: usize,
    /// Layers of the shorter gear that is condensed in its place.
    pub condensed: usize,
    /// Free degrees of freedom of the gear.
    pub free_count: usize,
}
