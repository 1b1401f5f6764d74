//! Gmsh's mesh files.

use mesh::{GroupNames, Mesh, MeshInfo, MeshReport, MeshedGear};

/// Teeth of the gear that a mesh is taken for.
const TEETH: u32 = 3;

/// A mesh, and what `ale-gear mesh info` says of it.
pub fn mesh(bytes: &[u8]) {
    match Mesh::parse(bytes, "fuzz.msh") {
        Ok(mesh) => drop(MeshInfo::new(&mesh)),
        Err(e) => drop((e.to_string(), e.hint())),
    }
}

/// A mesh, what `ale-gear mesh check` says of it, and the gear in it.
pub fn gear_mesh(bytes: &[u8]) {
    let Ok(mesh) = Mesh::parse(bytes, "fuzz.msh") else { return };
    let names = GroupNames::default();
    for teeth in [None, Some(TEETH)] {
        let _ = MeshReport::of_gear(&mesh, &names, teeth);
    }
    if let Err(e) = MeshedGear::from_groups(mesh, &names, TEETH) {
        drop((e.to_string(), e.hint()));
    }
}
