//! Areas of a flank's nodes.

use super::FlankPatch;
use crate::flank::{GapSource, contact_points};

impl FlankPatch {
    /// Boundary nodes and the area each stands for, mm^2: the integral of |N_i|, every entry positive.
    pub(crate) fn nodal_areas(&self) -> Vec<(u32, f64)> {
        let mut areas: Vec<(u32, f64)> = self.nodes.iter().map(|n| (n.boundary, 0.0)).collect();
        for point in contact_points(self, 3, GapSource::Smooth) {
            let face = &self.faces[point.at.face];
            let weights = self.interpolation(point.at).weights;
            for (&node, w) in face.nodes[..face.kind.node_count()].iter().zip(weights) {
                areas[node as usize].1 += w.abs() * point.area;
            }
        }
        areas
    }
}
