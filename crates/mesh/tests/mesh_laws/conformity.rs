//! Findings about meshes that look whole but are not: elements that do not join, gears that lie elsewhere.

use std::path::PathBuf;

use mesh::{ElementBlock, ElementKind, Finding, FindingKind, GroupNames, Mesh, MeshReport, Severity};

/// Two blocks of eight nodes each side by side along x, the second of the given elements (nodes of a hexahedron).
fn beside(kind: ElementKind, second: &[[usize; 8]], of_each: usize) -> Mesh {
    let nodes: Vec<[f64; 3]> = (0..12)
        .map(|n| [10.0 + f64::from(n / 4), f64::from(n % 4 == 1 || n % 4 == 2), f64::from(n % 4 > 1) - 0.5])
        .collect();
    let hex = |first: u32| [0, 4, 5, 1, 3, 7, 6, 2].map(|n| first + n);
    let connectivity = second.iter().flat_map(|e| e[..of_each].iter().map(|&n| hex(4)[n])).collect::<Vec<_>>();
    let tags = (2..2 + second.len() as u64).collect();
    Mesh {
        node_tags: (1..=12).collect(),
        nodes,
        blocks: vec![
            ElementBlock { kind: ElementKind::Hex8, connectivity: hex(0).to_vec(), tags: vec![1] },
            ElementBlock { kind, connectivity, tags },
        ],
        ..Mesh::default()
    }
}

fn findings(mesh: &Mesh, kind: FindingKind) -> Vec<Finding> {
    let report = MeshReport::new(mesh);
    assert_eq!(report.of(FindingKind::Inverted).count(), 0, "{report:?}");
    report.of(kind).cloned().collect()
}

const FIVE_TETRAHEDRA: [[usize; 8]; 5] = [
    [0, 1, 3, 4, 0, 0, 0, 0],
    [1, 2, 3, 6, 0, 0, 0, 0],
    [1, 3, 4, 6, 0, 0, 0, 0],
    [1, 4, 5, 6, 0, 0, 0, 0],
    [3, 4, 6, 7, 0, 0, 0, 0],
];

/// A hexahedron joins a hexahedron and wedges, whose faces are quadrilaterals too; not tetrahedra.
#[test]
fn quadrilaterals_beside_triangles() {
    let whole = beside(ElementKind::Hex8, &[[0, 1, 2, 3, 4, 5, 6, 7]], 8);
    // the cut across: faces towards the hexahedron stay quadrilaterals
    let wedges = beside(ElementKind::Wedge6, &[[0, 1, 2, 4, 5, 6, 0, 0], [0, 2, 3, 4, 6, 7, 0, 0]], 6);
    for mesh in [&whole, &wedges] {
        assert_eq!(findings(mesh, FindingKind::NotConforming), []);
    }
    let found = findings(&beside(ElementKind::Tet4, &FIVE_TETRAHEDRA, 4), FindingKind::NotConforming);
    assert_eq!((found.len(), found[0].count, found[0].elements[0]), (1, 1, 1), "{found:?}");
}

/// Two blocks of tetrahedra that split the face between them along different diagonals.
#[test]
fn crossed_diagonals() {
    let mut mesh = beside(ElementKind::Tet4, &FIVE_TETRAHEDRA, 4);
    // the same split in the first block: its face at the far end has the other diagonal
    let second = mesh.blocks.remove(1);
    let mut both = second.clone();
    both.connectivity = second.connectivity.iter().map(|n| n - 4).chain(second.connectivity.iter().copied()).collect();
    both.tags = (1..=10).collect();
    mesh.blocks = vec![both];
    let found = findings(&mesh, FindingKind::NotConforming);
    assert_eq!((found.len(), found[0].count), (1, 1), "{found:?}");

    for name in ["sector3_tet4.msh", "sector3_tet10.msh", "sector3_wedge15.msh", "free_tet10_pinion.msh"] {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes").join(name);
        let mesh = Mesh::read(path).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(findings(&mesh, FindingKind::NotConforming), [], "{name}");
    }
}

/// A middle node that only one of two neighbours has.
#[test]
fn a_middle_node_on_one_side() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes/sector3_hex20.msh");
    let mut mesh = Mesh::read(path).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(findings(&mesh, FindingKind::NotConforming), []);
    // the last element's middle nodes all become its own
    let last = mesh.blocks[0].connectivity.len() - 12;
    for slot in last..last + 12 {
        let node = mesh.blocks[0].connectivity[slot] as usize;
        mesh.nodes.push(mesh.nodes[node]);
        mesh.node_tags.push(1_000_000 + slot as u64);
        mesh.blocks[0].connectivity[slot] = mesh.nodes.len() as u32 - 1;
    }
    assert_eq!(findings(&mesh, FindingKind::NotConforming).len(), 1);
}

/// A gear along x, and one that starts at z = 0.
#[test]
fn gears_out_of_place() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes/coarse_hex8_pinion.msh");
    let mesh = Mesh::read(path).unwrap_or_else(|e| panic!("{e}"));
    for kind in [FindingKind::Axis, FindingKind::MidFace] {
        assert_eq!(findings(&mesh, kind), []);
    }
    let mut along_x = mesh.clone();
    along_x.nodes.iter_mut().for_each(|x| x.rotate_right(1));
    assert_eq!(findings(&along_x, FindingKind::Axis).len(), 1);
    let mut from_zero = mesh;
    from_zero.nodes.iter_mut().for_each(|x| x[2] += 10.0);
    assert_eq!(findings(&from_zero, FindingKind::MidFace).len(), 1);
}

/// Cuts of a sector of three teeth need not match, whether its flanks are named or not; those of one tooth must.
#[test]
fn free_cuts_without_named_flanks() {
    for (name, worst) in [("sector3_tet10.msh", Severity::Note), ("periodic_hex8.msh", Severity::Error)] {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes").join(name);
        let mut mesh = Mesh::read(path).unwrap_or_else(|e| panic!("{e}"));
        let node = mesh.surface("cut_0").unwrap_or_else(|| panic!("{name}: no cut")).nodes()[0] as usize;
        mesh.nodes[node][2] += 1e-3;
        for bare in [false, true] {
            mesh.surfaces.retain(|s| !bare || !s.name.starts_with("flank"));
            let report = MeshReport::of_gear(&mesh, &GroupNames::default(), Some(30));
            assert_eq!(report.of(FindingKind::CutsDiffer).map(|f| f.severity).max(), Some(worst), "{name}: {report:?}");
        }
    }
}
