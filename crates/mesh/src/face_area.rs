//! Integration points of a face on its place in the mesh.

use nalgebra::Vector3;

use crate::{Face, Mesh};

/// A point of a face that stands for a part of its area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AreaPoint {
    /// Shape functions of the face's nodes.
    pub shape: [f64; 9],
    /// Place, mm.
    pub position: Vector3<f64>,
    /// Area, mm^2.
    pub area: f64,
}

impl Face {
    /// Points with which products of two shape functions are integrated over the face.
    pub(crate) fn area_points<'a>(&'a self, mesh: &'a Mesh) -> impl Iterator<Item = AreaPoint> + 'a {
        self.kind.quadrature().iter().map(|q| {
            let (mut shape, mut gradient) = ([0.0; 9], [[0.0; 2]; 9]);
            self.kind.shape(q.xi, &mut shape);
            self.kind.shape_gradient(q.xi, &mut gradient);
            let (mut position, mut tangents) = (Vector3::zeros(), [Vector3::zeros(); 2]);
            for ((n, g), &node) in shape.iter().zip(gradient).zip(self.nodes()) {
                let x = Vector3::from(mesh.nodes[node as usize]);
                position += *n * x;
                tangents[0] += g[0] * x;
                tangents[1] += g[1] * x;
            }
            AreaPoint { shape, position, area: q.weight * tangents[0].cross(&tangents[1]).norm() }
        })
    }
}
