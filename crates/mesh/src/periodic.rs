//! Pairs each node of one cut with a node of the other.

use crate::Mesh;

/// Nodes of the cuts must meet within this times the largest radius of the mesh (failure mode F8).
const FIT: f64 = 1e-9;

/// A direction in which distinct nodes of a regular mesh hardly ever have the same place.
const SKEW: [f64; 3] = [0.577_913_5, 0.706_231_7, 0.409_113_9];

/// Place of a point along [`SKEW`]; two points are never nearer than their places.
pub(crate) fn place(x: &[f64; 3]) -> f64 {
    x[0] * SKEW[0] + x[1] * SKEW[1] + x[2] * SKEW[2]
}

/// Distance of two points, mm.
pub(crate) fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// A turn about z.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    sin: f64,
    cos: f64,
}

impl Turn {
    /// Rotates by an angle, rad, counter-clockwise seen from +z.
    pub(crate) fn new(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
    }

    /// A point, turned.
    pub(crate) fn of(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y, z]
    }
}

/// Some nodes of a mesh, to be found by position.
#[derive(Debug)]
pub(crate) struct Places<'a> {
    mesh: &'a Mesh,
    by_place: Vec<(f64, u32)>,
    /// How far from a node its partner may lie, mm.
    pub(crate) tolerance: f64,
}

impl<'a> Places<'a> {
    /// The nodes `nodes` of `mesh`, sorted by place.
    pub(crate) fn new(mesh: &'a Mesh, nodes: &[u32]) -> Self {
        let mut by_place: Vec<(f64, u32)> = nodes.iter().map(|&n| (place(&mesh.nodes[n as usize]), n)).collect();
        by_place.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let largest = mesh.nodes.iter().map(|x| x[0].hypot(x[1])).fold(0.0, f64::max);
        Self { mesh, by_place, tolerance: FIT * largest }
    }

    /// The node nearest to a point, if one lies within the tolerance.
    pub(crate) fn at(&self, point: &[f64; 3]) -> Option<u32> {
        let middle = place(point);
        let start = self.by_place.partition_point(|t| t.0 < middle - self.tolerance);
        self.by_place[start..]
            .iter()
            .take_while(|t| t.0 <= middle + self.tolerance)
            .map(|&(_, node)| (distance(&self.mesh.nodes[node as usize], point), node))
            .filter(|&(away, _)| away <= self.tolerance)
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, node)| node)
    }

    /// Distance to the nearest node, mm; a search through all of them.
    pub(crate) fn nearest(&self, point: &[f64; 3]) -> f64 {
        self.by_place.iter().map(|t| distance(&self.mesh.nodes[t.1 as usize], point)).fold(f64::INFINITY, f64::min)
    }
}
