//! A gear of another body than a solid one: hub, thin web and rim, one periodic tooth, as a mesh file.

use std::{collections::BTreeMap, path::Path};

use geometry::Gear;
use mesh::{ElementBlock, Extent, Face, Mesh, MshFormat, StructuredOptions, SurfaceGroup};

/// Radii (mm) between which elements farther than `half_web` (mm) from mid-face are taken away.
#[derive(Debug, Clone, Copy)]
pub struct Pocket {
    pub from: f64,
    pub to: f64,
    pub half_web: f64,
}

/// Writes one periodic tooth of a gear with pockets at both sides.
pub fn write_webbed(gear: &Gear, pocket: Pocket, path: &Path) {
    let options = StructuredOptions {
        order: 2,
        elements_profile: 4,
        elements_fillet: 4,
        elements_thickness: 4,
        elements_face: 9,
        elements_rim: 8,
        extent: Extent::Periodic,
    };
    let solid = mesh::generate(gear, &options).unwrap();
    without(&solid, pocket).write(path, MshFormat::default()).unwrap();
}

/// The mesh without the elements whose centre lies in the pockets.
fn without(solid: &Mesh, pocket: Pocket) -> Mesh {
    let stays = |nodes: &[u32]| {
        let count = nodes.len() as f64;
        let [x, y, z] = [0, 1, 2].map(|k| nodes.iter().map(|&n| solid.nodes[n as usize][k]).sum::<f64>() / count);
        !((pocket.from..pocket.to).contains(&x.hypot(y)) && z.abs() > pocket.half_web)
    };
    let block = |b: &ElementBlock| {
        let kept: Vec<(&[u32], &u64)> = b.elements().zip(&b.tags).filter(|(nodes, _)| stays(nodes)).collect();
        let connectivity: Vec<u32> = kept.iter().flat_map(|(nodes, _)| nodes.iter().copied()).collect();
        ElementBlock { kind: b.kind, connectivity, tags: kept.iter().map(|(_, tag)| **tag).collect() }
    };
    let blocks: Vec<ElementBlock> = solid.blocks.iter().map(block).collect();
    let mut number = BTreeMap::new();
    for &node in blocks.iter().flat_map(|b| &b.connectivity) {
        number.insert(node, 0);
    }
    number.values_mut().zip(0..).for_each(|(new, k)| *new = k);
    let face = |f: &Face| {
        let nodes: Option<Vec<u32>> = f.nodes().iter().map(|n| number.get(n).copied()).collect();
        Some(Face::new(f.kind, &nodes?))
    };
    // A face may keep its nodes and lose its element: it would lie on nothing.
    let on_body = |f: &Face| stays(f.nodes());
    let surface = |s: &SurfaceGroup| SurfaceGroup {
        name: s.name.clone(),
        faces: s.faces.iter().filter(|f| on_body(f)).filter_map(face).collect(),
    };
    Mesh {
        nodes: number.keys().map(|&n| solid.nodes[n as usize]).collect(),
        node_tags: (1..=number.len() as u64).collect(),
        surfaces: solid.surfaces.iter().map(surface).collect(),
        volumes: solid.volumes.clone(),
        blocks: blocks
            .into_iter()
            .map(|b| ElementBlock { connectivity: b.connectivity.iter().map(|n| number[n]).collect(), ..b })
            .collect(),
    }
}
