//! What is written is read back the same, bit for bit.

use crate::common::{FLAVOURS, data, one_element};
use mesh::{ElementKind, Mesh, MshFormat};

fn assert_comes_back(mesh: &Mesh, what: &str) {
    for format in MshFormat::ALL {
        let bytes = mesh.to_msh(format).unwrap();
        let back = Mesh::parse(&bytes, what).unwrap_or_else(|e| panic!("{format:?}: {e}"));
        assert_eq!(&back, mesh, "{what} {format:?}");
    }
}

#[test]
fn every_kind_comes_back() {
    for kind in ElementKind::ALL {
        assert_comes_back(&one_element(kind), kind.name());
    }
}

#[test]
fn meshes_by_gmsh_come_back() {
    for stem in ["hex8", "hex20", "hex27", "tet4", "tet10", "wedge6", "wedge15", "overlap", "plain"] {
        for flavour in FLAVOURS {
            assert_comes_back(&Mesh::read(data(&format!("{stem}_{flavour}.msh"))).unwrap(), stem);
        }
    }
}

/// Coordinates that short decimal forms spoil, and tags that 32 bits cannot hold.
#[test]
fn numbers_are_exact() {
    let mut mesh = one_element(ElementKind::Hex8);
    for (i, position) in mesh.nodes.iter_mut().enumerate() {
        position[0] += [f64::MIN_POSITIVE, 1e-300, 1.0 / 3.0, 0.1 + 0.2, 1e17, f64::EPSILON, -0.0, 1e-9][i];
    }
    assert_comes_back(&mesh, "digits");
    mesh.node_tags[7] = 1 << 40;
    mesh.blocks[0].tags[0] = 1 << 50;
    for format in [MshFormat::Ascii41, MshFormat::Binary41] {
        assert_eq!(Mesh::parse(&mesh.to_msh(format).unwrap(), "tags").unwrap(), mesh);
    }
    for format in [MshFormat::Ascii22, MshFormat::Binary22] {
        assert!(mesh.to_msh(format).unwrap_err().to_string().contains("does not fit into format 2.2"));
    }
}

#[test]
fn a_file_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("one.msh");
    let mesh = one_element(ElementKind::Hex20);
    mesh.write(&path, MshFormat::default()).unwrap();
    assert_eq!(Mesh::read(&path).unwrap(), mesh);
    assert!(mesh.write(folder.path().join("no/such/folder.msh"), MshFormat::default()).is_err());
    assert!(Mesh::read(folder.path().join("none.msh")).is_err());
}

#[test]
fn lists_that_do_not_fit_are_refused() {
    let mut mesh = one_element(ElementKind::Tet4);
    mesh.blocks[0].connectivity[2] = 99;
    assert!(mesh.to_msh(MshFormat::Ascii41).unwrap_err().to_string().contains("node number 99"));
    mesh.node_tags.pop();
    assert!(mesh.to_msh(MshFormat::Ascii41).is_err());
}
