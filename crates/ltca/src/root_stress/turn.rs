//! Size of a fillet's faces relative to its radius: how far the surface turns within one face.

use std::collections::BTreeMap;

use mesh::{Face, Mesh};
use nalgebra::Vector3;

/// Largest angle between the normals at a face's corners, over all faces of some surfaces, rad; faces of a fold count
/// as flat.
///
/// The normal at a corner is the mean over the faces of its surface about it, so that faces of order 1 turn, too.
pub(super) fn largest_turn(mesh: &Mesh, surfaces: &[Vec<Face>]) -> f64 {
    surfaces.iter().map(|faces| turn(mesh, faces)).fold(0.0, f64::max)
}

fn turn(mesh: &Mesh, faces: &[Face]) -> f64 {
    let mut normals: BTreeMap<u32, Vector3<f64>> = BTreeMap::new();
    for face in faces {
        for (corner, &node) in face.corners().iter().enumerate() {
            *normals.entry(node).or_default() += normal(mesh, face, corner);
        }
    }
    let of_face = |face: &Face| {
        let all: Vec<_> = face.corners().iter().filter_map(|node| normals.get(node)).collect();
        let pairs = all.iter().enumerate().flat_map(|(i, a)| all[..i].iter().map(|b| a.angle(b)));
        pairs.fold(0.0, f64::max)
    };
    faces.iter().map(of_face).fold(0.0, f64::max)
}

/// Unit normal at a corner of a face, zero where the face is folded to a line.
fn normal(mesh: &Mesh, face: &Face, corner: usize) -> Vector3<f64> {
    let mut gradient = [[0.0; 2]; 9];
    face.kind.shape_gradient(face.kind.reference_nodes()[corner], &mut gradient);
    let tangent = |k: usize| -> Vector3<f64> {
        let terms = face.nodes().iter().zip(&gradient);
        terms.map(|(&n, dn)| Vector3::from(mesh.nodes[n as usize]) * dn[k]).sum()
    };
    tangent(0).cross(&tangent(1)).try_normalize(0.0).unwrap_or_default()
}
