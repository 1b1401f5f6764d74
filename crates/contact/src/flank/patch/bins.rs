//! Bins for the search of faces that may contain a point.

use super::face::{PatchFace, PatchNode, range};

/// Uniform grid over surface coordinates: which faces may cover a spot.
#[derive(Debug)]
pub(super) struct Bins {
    low: [f64; 2],
    size: [f64; 2],
    count: [usize; 2],
    faces: Vec<Vec<u32>>,
}

impl Bins {
    pub fn new(faces: &[PatchFace], nodes: &[PatchNode]) -> Self {
        let [low, high] = range(nodes.iter().map(|n| n.at));
        let edge = ((faces.len() as f64).sqrt().ceil() as usize).max(1);
        let count = [edge, edge];
        let size = [0, 1].map(|k| ((high[k] - low[k]) / edge as f64).max(f64::MIN_POSITIVE));
        let mut bins = Self { low, size, count, faces: vec![Vec::new(); edge * edge] };
        for (i, f) in faces.iter().enumerate() {
            let r = range(f.nodes[..f.kind.node_count()].iter().map(|&n| nodes[n as usize].at));
            // Quadratic edges may bulge beyond their nodes by an eighth of the face.
            let grow = [0, 1].map(|k| 0.15 * (r[1][k] - r[0][k]));
            let from = [0, 1].map(|k| bins.index(k, r[0][k] - grow[k]));
            let to = [0, 1].map(|k| bins.index(k, r[1][k] + grow[k]));
            for a in from[0]..=to[0] {
                for b in from[1]..=to[1] {
                    bins.faces[a * edge + b].push(i as u32);
                }
            }
        }
        bins
    }

    fn index(&self, axis: usize, value: f64) -> usize {
        let i = ((value - self.low[axis]) / self.size[axis]).floor();
        i.clamp(0.0, (self.count[axis] - 1) as f64) as usize
    }

    pub fn around(&self, at: [f64; 2]) -> Option<&[u32]> {
        at.iter()
            .all(|v| v.is_finite())
            .then(|| &*self.faces[self.index(0, at[0]) * self.count[1] + self.index(1, at[1])])
    }
}
