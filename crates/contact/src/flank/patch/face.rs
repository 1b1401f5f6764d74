//! Faces and nodes of a patch.

use mesh::FaceKind;

use crate::Vec3;

#[derive(Debug, Clone, Copy)]
pub(super) struct PatchFace {
    pub kind: FaceKind,
    /// Into `nodes`.
    pub nodes: [u32; 9],
}

#[derive(Debug, Clone, Copy)]
pub(super) struct PatchNode {
    pub position: Vec3,
    pub at: [f64; 2],
    /// Number of the node among its gear's boundary nodes.
    pub boundary: u32,
}

pub(super) fn range(points: impl Iterator<Item = [f64; 2]>) -> [[f64; 2]; 2] {
    let mut r = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for p in points {
        for k in 0..2 {
            r[0][k] = r[0][k].min(p[k]);
            r[1][k] = r[1][k].max(p[k]);
        }
    }
    r
}
