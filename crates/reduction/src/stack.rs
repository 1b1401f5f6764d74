//! A wide gear made of equal layers of elements; a shorter gear of the same layers gives what contact needs.

/// How the layers of a wide gear follow from those of a shorter one.
///
/// Every layer of elements along the face is the preceding one, moved along the axis and rotated with the helix. A gear
/// held along its whole bore responds to a force only near it: some rim thicknesses away it does not move. So the
/// compliance between two positions is that of a shorter gear with the same distances to the nearer end faces. Beyond
/// the width of the shorter gear the compliance is practically zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LayerStack {
    /// Number of layers of the gear.
    pub layers: usize,
    /// Number of layers of the shorter gear that is condensed instead.
    pub condensed: usize,
    /// Number of free degrees of freedom of the gear.
    pub free_count: usize,
}
