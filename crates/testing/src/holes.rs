//! Gears with holes, from those without.

use std::collections::BTreeMap;

use mesh::{ElementBlock, Face, Mesh, SurfaceGroup};

/// A mesh without the elements whose middle lies in a hole. Nodes that nothing holds any more go, and the others move up.
pub fn with_holes(mesh: &Mesh, is_hole: impl Fn([f64; 3]) -> bool) -> Mesh {
    let middle = |element: &[u32]| {
        let sum = |axis: usize| element.iter().map(|&n| mesh.nodes[n as usize][axis]).sum::<f64>();
        [0, 1, 2].map(|axis| sum(axis) / element.len() as f64)
    };
    let mut blocks = Vec::new();
    for block in &mesh.blocks {
        let mut left = ElementBlock { kind: block.kind, connectivity: Vec::new(), tags: Vec::new() };
        for (element, &tag) in block.elements().zip(&block.tags) {
            if !is_hole(middle(element)) {
                left.connectivity.extend_from_slice(element);
                left.tags.push(tag);
            }
        }
        blocks.push(left);
    }
    let mut number: BTreeMap<u32, u32> = blocks.iter().flat_map(|b| &b.connectivity).map(|&n| (n, 0)).collect();
    number.values_mut().zip(0..).for_each(|(to, i)| *to = i);
    blocks.iter_mut().flat_map(|b| &mut b.connectivity).for_each(|n| *n = number[n]);
    let of_group = |group: &SurfaceGroup| {
        let renumbered = |face: &Face| -> Option<Face> {
            let nodes: Option<Vec<u32>> = face.nodes().iter().map(|n| number.get(n).copied()).collect();
            Some(Face::new(face.kind, &nodes?))
        };
        SurfaceGroup { name: group.name.clone(), faces: group.faces.iter().filter_map(renumbered).collect() }
    };
    // Side faces have holes too; who wants them names them anew.
    let kept = |group: &&SurfaceGroup| group.name == "bore" || group.name.starts_with("flank");
    Mesh {
        nodes: number.keys().map(|&n| mesh.nodes[n as usize]).collect(),
        node_tags: number.keys().map(|&n| mesh.node_tags[n as usize]).collect(),
        blocks,
        surfaces: mesh.surfaces.iter().filter(kept).map(of_group).collect(),
        volumes: mesh.volumes.clone(),
    }
}
