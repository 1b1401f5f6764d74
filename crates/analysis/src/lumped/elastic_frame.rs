//! Sizes and places of the coordinates of reduced gears.

use nalgebra::DVector;

/// Sizes and places of coordinates.
#[derive(Debug, Clone)]
pub(super) struct ElasticFrame {
    /// Lag of the driven gear at rest, mm: the mean of a mesh cycle.
    pub lag: f64,
    /// What counts as a large motion of each coordinate.
    pub scale: DVector<f64>,
    /// Places of the free coordinates among the twelve of both gears.
    pub free: Vec<usize>,
    /// Transmission error of the mesh cycle at rest, mm.
    pub at_rest: Vec<f64>,
}
