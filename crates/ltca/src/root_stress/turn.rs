//! Size of a fillet's faces relative to its radius: how far the surface turns within one face.

use std::collections::BTreeMap;

use mesh::{Face, Mesh};
use nalgebra::Vector3;

/// How coarse the faces of some fillets are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Coarseness {
    /// Largest angle between the normals at a face's corners, rad; faces of a fold count as flat. Of faces of order 1, which
    /// are flat, largest angle between faces about a node.
    pub turn: f64,
    /// Of elements of order 1, whose strain hardly changes below the surface: largest depth below a face over the radius of
    /// the surface; 0 of others.
    pub depth: f64,
}

impl Coarseness {
    /// The coarsest of some surfaces.
    ///
    /// The normal at a corner is the mean over the faces of its surface about it, so that faces of order 1 turn, too.
    pub fn of(mesh: &Mesh, surfaces: &[Vec<Face>]) -> Self {
        let each = surfaces.iter().map(|faces| Self::of_surface(mesh, faces));
        each.fold(Self::default(), |a, b| Self { turn: a.turn.max(b.turn), depth: a.depth.max(b.depth) })
    }

    fn of_surface(mesh: &Mesh, faces: &[Face]) -> Self {
        let mut normals: BTreeMap<u32, Vector3<f64>> = BTreeMap::new();
        let mut flat: BTreeMap<u32, Vec<Vector3<f64>>> = BTreeMap::new();
        for face in faces {
            for (corner, &node) in face.corners().iter().enumerate() {
                let own = normal(mesh, face, corner);
                *normals.entry(node).or_default() += own;
                if face.kind.order() == 1 {
                    flat.entry(node).or_default().push(own);
                }
            }
        }
        let place = |node: u32| Vector3::from(mesh.nodes[node as usize]);
        // Angle and curvature between the corners of each face.
        let (mut turn, mut curvature) = (0.0f64, 0.0f64);
        for face in faces {
            let all: Vec<_> = face.corners().iter().filter_map(|&n| Some((place(n), normals.get(&n)?))).collect();
            for (a, b) in all.iter().enumerate().flat_map(|(i, a)| all[..i].iter().map(move |b| (a, b))) {
                let (angle, apart) = (a.1.angle(b.1), (a.0 - b.0).norm());
                turn = turn.max(angle);
                curvature = if apart > 0.0 { curvature.max(angle / apart) } else { curvature };
            }
        }
        for about in flat.values() {
            let pairs = about.iter().enumerate().flat_map(|(i, a)| about[..i].iter().map(move |b| a.angle(b)));
            turn = pairs.fold(turn, f64::max);
        }
        let mut depth = 0.0f64;
        for block in mesh.blocks.iter().filter(|block| block.kind.order() == 1) {
            for element in block.connectivity.chunks(block.kind.node_count()) {
                let (on, below): (Vec<u32>, Vec<u32>) = element.iter().partition(|node| normals.contains_key(node));
                if on.len() < 3 {
                    continue;
                }
                let mean: Vector3<f64> = on.iter().filter_map(|node| normals.get(node)).sum();
                let Some(out) = mean.try_normalize(0.0) else { continue };
                let from = on.iter().map(|node| place(*node)).sum::<Vector3<f64>>() / on.len() as f64;
                let own = below.iter().map(|node| (from - place(*node)).dot(&out));
                depth = own.fold(depth, f64::max);
            }
        }
        Self { turn, depth: curvature * depth }
    }
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
