//! Loads on the flanks at an instant, from which fields of displacement are made.

use contact::{ContactSet, Pose, nodal::ContactRow};
use reduction::ElasticGear;

use crate::{Instant, PairMechanism};

/// The loads on the flanks of one side.
#[derive(Debug)]
pub struct SideLoads<'a> {
    /// Reduced gears of these flanks.
    pub gears: &'a [ElasticGear; 2],
    /// Flanks and matrices of the window.
    pub set: &'a ContactSet,
    /// Frames of the matrices.
    pub poses: [Pose; 2],
    /// Slices, those that press with the nodes that they rest on.
    pub rows: Vec<ContactRow>,
    /// Normal force of each, N, without damping.
    pub forces: &'a [f64],
}

impl SideLoads<'_> {
    /// Displacements of both gears' boundary coordinates under the loads, mm, in the matrices' frames.
    pub fn displacements(&self) -> Option<[Vec<f64>; 2]> {
        self.set.displacements_under(&self.rows, self.forces)
    }
}

impl PairMechanism {
    /// Loads on the flanks at the instant that was evaluated last: driving ones, and coast ones where they do.
    pub fn side_loads(&self, at: &Instant) -> Vec<SideLoads<'_>> {
        let presses = [true, at.normal_forces[1] > 0.0];
        let sides = self.sides().zip(presses).filter(|(_, presses)| *presses);
        sides
            .map(|(side, _)| {
                let (poses, contact) =
                    (side.poses(self.pair(), self.cycles(at.time), &at.displacement), side.contact());
                let (set, forces) = (contact.contact_set(), contact.solver().forces());
                let rows = set.supported_rows(&poses, contact.rows(), contact.slices(), forces);
                SideLoads { gears: side.gears(), set, poses, rows, forces }
            })
            .collect()
    }
}
