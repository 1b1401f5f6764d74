//! Files that Gmsh itself wrote (`tests/data/make.py`), every element kind in every flavour.

use crate::common::{FLAVOURS, data, volume};
use mesh::{ElementKind, FaceTable, Mesh, MeshError};

fn read(name: &str) -> Mesh {
    Mesh::read(data(name)).unwrap_or_else(|e| panic!("{e}"))
}

/// The model does not depend on the flavour; tags may, for format 2.2 counts elements anew.
/// Gmsh writes 16 digits in text, one less than exact, so text and binary may differ in the last bit.
fn assert_same_model(a: &Mesh, b: &Mesh, what: &str) {
    assert_eq!(a.nodes.len(), b.nodes.len(), "{what}: nodes");
    for (a, b) in a.nodes.iter().flatten().zip(b.nodes.iter().flatten()) {
        assert!((a - b).abs() <= 1e-15 * a.abs(), "{what}: {a} and {b}");
    }
    assert_eq!(a.surfaces, b.surfaces, "{what}: surfaces");
    assert_eq!(a.volumes, b.volumes, "{what}: volumes");
    assert_eq!(a.blocks.len(), b.blocks.len(), "{what}: blocks");
    for (a, b) in a.blocks.iter().zip(&b.blocks) {
        assert_eq!((a.kind, &a.connectivity), (b.kind, &b.connectivity), "{what}: elements");
    }
}

/// Equal digits give equal bits: 2.2 like 4.1 in text, and in binary.
#[test]
fn versions_of_one_coding_are_bit_identical() {
    for stem in ["hex8", "hex20", "hex27", "tet4", "tet10", "wedge6", "wedge15", "overlap", "plain", "parametric"] {
        for coding in ["a", "b"] {
            let [old, new] = ["22", "41"].map(|version| read(&format!("{stem}_{coding}{version}.msh")));
            assert_eq!(old.nodes, new.nodes, "{stem} {coding}");
        }
    }
}

#[test]
fn every_flavour_of_every_kind_gives_the_same_model() {
    let boxes = 2.0 * 1.1 * 1.3;
    let prism = 1.2 * 1.4;
    for (stem, kind, expected) in [
        ("hex8", ElementKind::Hex8, boxes),
        ("hex20", ElementKind::Hex20, boxes),
        ("hex27", ElementKind::Hex27, boxes),
        ("tet4", ElementKind::Tet4, boxes),
        ("tet10", ElementKind::Tet10, boxes),
        ("wedge6", ElementKind::Wedge6, prism),
        ("wedge15", ElementKind::Wedge15, prism),
    ] {
        let first = read(&format!("{stem}_{}.msh", FLAVOURS[0]));
        assert_eq!(first.blocks.len(), 1, "{stem}");
        assert_eq!(first.blocks[0].kind, kind);
        let names: Vec<&str> = first.surfaces.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["bore", "flank left 0", "flank right 0"], "{stem}");
        assert_eq!(first.volumes, ["gear"], "{stem}");
        let found = volume(&first);
        assert!((found - expected).abs() < 1e-12 * expected, "{stem}: volume {found}, not {expected}");
        for flavour in &FLAVOURS[1..] {
            assert_same_model(&first, &read(&format!("{stem}_{flavour}.msh")), &format!("{stem} {flavour}"));
        }
    }
}

/// Each named face is the face of exactly one element, with the same nodes in edge order.
#[test]
fn named_faces_bound_the_body() {
    for stem in ["hex8", "hex20", "hex27", "tet4", "tet10", "wedge6", "wedge15"] {
        let mesh = read(&format!("{stem}_b41.msh"));
        let table = FaceTable::new(&mesh);
        for group in &mesh.surfaces {
            for face in &group.faces {
                let owners: Vec<_> = table.owners(face.corner_key()).collect();
                assert_eq!(owners.len(), 1, "{stem} {}", group.name);
                let own = owners[0].face(&mesh);
                let turned = own.reversed();
                let around = |f: &mesh::Face| edges(f);
                assert!(around(face) == around(&own) || around(face) == around(&turned), "{stem} {}", group.name);
            }
        }
    }
}

/// Directed edges of a face with their middle nodes, sorted: the same whatever the first corner.
fn edges(face: &mesh::Face) -> Vec<[u32; 3]> {
    let (c, n) = (face.corners(), face.nodes());
    let k = c.len();
    let mut all: Vec<[u32; 3]> = (0..k).map(|i| [c[i], c[(i + 1) % k], n.get(k + i).copied().unwrap_or(0)]).collect();
    all.sort_unstable();
    all
}

#[test]
fn an_element_in_two_groups_is_one_element() {
    for flavour in FLAVOURS {
        let mesh = read(&format!("overlap_{flavour}.msh"));
        assert_eq!(mesh.volumes, ["gear", "part"], "{flavour}");
        assert_eq!(mesh.element_count(), 4, "{flavour}");
        assert!((volume(&mesh) - 2.0 * 2.86).abs() < 1e-12, "{flavour}");
        let counts: Vec<usize> = mesh.surfaces.iter().map(|s| s.faces.len()).collect();
        assert_eq!(counts, [1, 2], "{flavour}");
    }
}

#[test]
fn what_lies_in_no_group_is_left_out_with_its_nodes() {
    for flavour in ["a41", "b41"] {
        let mesh = read(&format!("strays_{flavour}.msh"));
        assert_eq!((mesh.element_count(), mesh.nodes.len()), (2, 12), "{flavour}");
        assert!((volume(&mesh) - 2.86).abs() < 1e-12, "{flavour}");
    }
    // With SaveAll Gmsh writes no groups into format 2.2 at all: nothing tells the bodies apart.
    for flavour in ["a22", "b22"] {
        let mesh = read(&format!("strays_{flavour}.msh"));
        assert_eq!((mesh.element_count(), mesh.nodes.len()), (4, 24), "{flavour}");
        assert!(mesh.surfaces.is_empty(), "{flavour}");
    }
}

#[test]
fn without_groups_everything_is_taken() {
    for flavour in FLAVOURS {
        let mesh = read(&format!("plain_{flavour}.msh"));
        assert_eq!((mesh.element_count(), mesh.nodes.len()), (2, 12), "{flavour}");
        assert!(mesh.surfaces.is_empty() && mesh.volumes.is_empty(), "{flavour}");
    }
}

#[test]
fn parametric_nodes_are_nodes() {
    let plain = read("hex8_a41.msh");
    for flavour in FLAVOURS {
        assert_same_model(&plain, &read(&format!("parametric_{flavour}.msh")), flavour);
    }
}

/// Gmsh writes the nodes of partitions in another order, and their groups elsewhere.
#[test]
fn a_partitioned_mesh_is_the_whole_mesh() {
    let whole = read("whole_a41.msh");
    for flavour in FLAVOURS {
        let parts = read(&format!("partitioned_{flavour}.msh"));
        assert_eq!(parts.nodes.len(), whole.nodes.len(), "{flavour}");
        // Format 2.2 counts nodes anew, partition by partition.
        let near = |a: &[f64; 3], b: &[f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-14);
        assert!(parts.nodes.iter().all(|a| whole.nodes.iter().any(|b| near(a, b))), "{flavour}");
        assert_eq!(parts.element_count(), whole.element_count(), "{flavour}");
        assert!((volume(&parts) - volume(&whole)).abs() < 1e-12, "{flavour}");
        let count = |m: &Mesh| m.surfaces.iter().map(|s| (s.name.clone(), s.faces.len())).collect::<Vec<_>>();
        assert_eq!(count(&parts), count(&whole), "{flavour}");
    }
}

#[test]
fn version_40_is_refused_with_advice() {
    let error = Mesh::read(data("version_40.msh")).unwrap_err();
    assert!(error.to_string().contains("$MeshFormat, line 2: format version 4"), "{error}");
    assert!(error.hint().is_some_and(|h| h.contains("MshFileVersion")), "{error:?}");
    assert!(matches!(error, MeshError::Msh(_)));
}

/// Files from Windows, and files whose last line has no end.
#[test]
fn line_ends_do_not_matter() {
    for stem in ["hex8_a41", "hex8_a22", "hex20_a41"] {
        let text = std::fs::read_to_string(data(&format!("{stem}.msh"))).unwrap();
        let plain = Mesh::parse(text.as_bytes(), stem).unwrap();
        for variant in [text.replace('\n', "\r\n"), text.trim_end().to_owned(), format!("\u{feff}{text}\n\n")] {
            assert_eq!(Mesh::parse(variant.as_bytes(), stem).unwrap(), plain, "{stem}");
        }
    }
    for stem in ["hex8_b41", "hex8_b22"] {
        let bytes = std::fs::read(data(&format!("{stem}.msh"))).unwrap();
        let plain = Mesh::parse(&bytes, stem).unwrap();
        assert_eq!(Mesh::parse(bytes.trim_ascii_end(), stem).unwrap(), plain, "{stem}");
    }
}
