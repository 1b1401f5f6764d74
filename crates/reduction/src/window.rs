//! The reduced gear of one window.

use std::sync::Arc;

use faer::Mat;
use geometry::Side;

/// A gear reduced to the flank nodes of some neighbouring teeth.
#[derive(Debug, Clone)]
pub struct ReducedGear {
    /// Teeth, counter-clockwise, 0 .. z-1, as the frame of the matrices numbers them.
    pub teeth: Vec<u32>,
    /// Sides of the teeth whose nodes are kept.
    pub sides: Vec<Side>,
    /// Boundary nodes, numbers of the mesh, ascending; coordinate 3 i + axis belongs to `nodes[i]`.
    pub nodes: Vec<u32>,
    /// K^, N/mm, 3 n x 3 n; empty for a gear reduced to grids, which may have more nodes than the mesh can tell apart.
    pub stiffness: Mat<f64>,
    /// C = K^^-1, mm/N.
    pub compliance: Mat<f64>,
}

impl ReducedGear {
    /// Number of coordinates, three a boundary node.
    pub fn coordinates(&self) -> usize {
        3 * self.nodes.len()
    }

    /// Position of a mesh node among the boundary nodes.
    pub fn position(&self, node: u32) -> Option<usize> {
        self.nodes.binary_search(&node).ok()
    }

    /// Strain energy u' K^ u / 2, N mm; NaN where there is no K^.
    pub fn strain_energy(&self, u: &[f64]) -> f64 {
        let k = &self.stiffness;
        if k.ncols() != u.len() {
            return f64::NAN;
        }
        let mut sum = 0.0;
        for j in 0..u.len() {
            let column = k.col(j);
            sum += u[j] * u.iter().zip(column.iter()).map(|(a, b)| a * b).sum::<f64>();
        }
        0.5 * sum
    }
}

/// A reduced gear at its place on the gear.
#[derive(Debug, Clone)]
pub struct Window {
    /// Matrices, shared by all windows of a cyclic gear.
    pub reduced: Arc<ReducedGear>,
    /// Pitches by which the frame of the matrices is turned against the gear's own frame: tooth t of the matrices is the
    /// gear's tooth t + `shift` (mod z).
    pub shift: u32,
}
