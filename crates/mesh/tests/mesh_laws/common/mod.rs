//! What several tests need.

use std::path::PathBuf;

use mesh::{ElementBlock, ElementKind, Face, Mesh, SurfaceGroup};

/// A file beside the tests.
pub fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// The flavours that `tests/data/make.py` writes.
pub const FLAVOURS: [&str; 4] = ["a41", "b41", "a22", "b22"];

/// A mesh of one reference element of that kind, its first face named `bore`, its last `flank_left_0`.
pub fn one_element(kind: ElementKind) -> Mesh {
    let count = kind.node_count() as u32;
    let all: Vec<u32> = (0..count).collect();
    let group = |name: &str, local: usize| {
        let (face, order) = kind.faces()[local];
        let nodes: Vec<u32> = order.iter().map(|&l| all[l]).collect();
        SurfaceGroup { name: name.into(), faces: vec![Face::new(face, &nodes)] }
    };
    Mesh {
        nodes: kind.reference_nodes().iter().map(|x| x.map(|v| v * std::f64::consts::PI / 3.0)).collect(),
        node_tags: (1..=u64::from(count)).map(|t| 3 * t).collect(),
        surfaces: vec![group("bore", 0), group("flank_left_0", kind.faces().len() - 1)],
        volumes: vec!["gear".into()],
        blocks: vec![ElementBlock { kind, connectivity: all, tags: vec![7] }],
    }
}

/// Volume of the hexahedra, tetrahedra or wedges by quadrature, mm^3.
pub fn volume(mesh: &Mesh) -> f64 {
    mesh::MeshInfo::new(mesh).volume
}
