//! Scales and positions of the coordinates of reduced gears.

/// Sizes and places of coordinates.
#[derive(Debug, Clone)]
pub(super) struct ElasticFrame {
    /// What counts as a large motion of the flanks, mm.
    pub length: f64,
    /// Places of the free coordinates among the twelve of both gears.
    pub free: Vec<usize>,
    /// Transmission error of the mesh cycle at rest, mm.
    pub at_rest: Vec<f64>,
}
