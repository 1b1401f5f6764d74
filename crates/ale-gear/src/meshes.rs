//! Meshes of a scene: read from a file or made, with the parts of the gear found.

use mesh::{ElementBlock, GearMesh, Mesh, MeshError};

use crate::error::CommandError;
use crate::facts::MeshFacts;
use crate::scene::{GearScene, Scene};

/// The mesh of one gear, and what the summary says of it.
///
/// # Errors
/// Exit status 2 when the file is not there, is damaged, or does not name the parts of this gear.
pub fn gear_mesh(scene: &Scene, gear: &GearScene) -> Result<(GearMesh, MeshFacts), CommandError> {
    let input = |e: MeshError| CommandError::input(&e, e.hint());
    let Some(path) = &gear.mesh else {
        return Err(CommandError::failed("the built-in mesher is not linked into this build", None));
    };
    let file = scene.resolve(path);
    let mesh = Mesh::read(&file).map_err(input)?;
    let facts = facts(path.display().to_string(), &mesh);
    let named = GearMesh::from_groups(mesh, &gear.groups, gear.teeth).map_err(|e| {
        let hint = e.hint();
        // The parts of a gear are known by name only, so the complaint must name the file that lacks them.
        CommandError::input(format_args!("{}: {e}", file.display()), hint)
    })?;
    Ok((named, facts))
}

/// Size of a mesh.
pub(crate) fn facts(source: String, mesh: &Mesh) -> MeshFacts {
    MeshFacts { source, nodes: mesh.nodes.len(), elements: mesh.element_count(), kinds: kinds(&mesh.blocks) }
}

/// Kinds of elements with their numbers, as `hex8 1200`.
pub(crate) fn kinds(blocks: &[ElementBlock]) -> Vec<String> {
    blocks.iter().map(|b| format!("{} {}", format!("{:?}", b.kind).to_lowercase(), b.len())).collect()
}
