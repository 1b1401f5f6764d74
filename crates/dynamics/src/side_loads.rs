//! Loads on the flanks at an instant, from which displacement fields are computed.

use contact::{ContactSet, Pose, nodal::ContactRow};
use reduction::ElasticGear;

/// The loads on the flanks of one side.
#[derive(Debug)]
pub struct SideLoads<'a> {
    /// Reduced gears of these flanks.
    pub gears: &'a [ElasticGear; 2],
    /// Flanks and matrices of the window.
    pub set: &'a ContactSet,
    /// Frames of the matrices.
    pub poses: [Pose; 2],
    /// Slices; those in contact have their nodes.
    pub rows: Vec<ContactRow>,
    /// Normal force of each slice, N, without damping.
    pub forces: &'a [f64],
}

impl SideLoads<'_> {
    /// Displacements of both gears' boundary coordinates under the loads, mm, in the frames of the matrices.
    pub fn displacements(&self) -> Option<[Vec<f64>; 2]> {
        self.set.displacements_under(&self.rows, self.forces)
    }
}
