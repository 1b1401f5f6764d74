//! Common start of all analyses: the scene as it is solved, its motion, its meshes.

use geometry::GearPair;
use mesh::Mesh;
use scene::{MotionScene, Scene};

use crate::{
    AnalysisError, GearCache,
    meshes::{self, SceneMesh},
    resolution::with_slices,
};

/// The scene with the slices that it asks for, chosen where it states none; the built-in mesher has no say over meshes
/// in memory.
pub(crate) fn resolved_scene(scene: &Scene, meshes_in_memory: bool) -> Scene {
    with_meshes_of(with_slices(scene.clone()), meshes_in_memory)
}

/// The scene; the built-in mesher has no say over meshes in memory.
pub(crate) fn with_meshes_of(mut scene: Scene, meshes_in_memory: bool) -> Scene {
    if meshes_in_memory {
        (scene.pinion.mesher, scene.wheel.mesher) = (None, None);
    }
    scene
}

/// The motion that a scene asks for.
pub(crate) fn motion_of(scene: &Scene) -> Result<&MotionScene, AnalysisError> {
    scene.motion.as_ref().ok_or_else(|| crate::error::unasked(scene, "motion"))
}

/// Meshes of pinion and wheel: those that the caller holds, checked as files are, else those of the scene, of which the
/// cache may know that they are sound.
pub(crate) fn meshes_of(
    scene: &Scene,
    pair: &GearPair,
    in_memory: Option<[&Mesh; 2]>,
    cache: &dyn GearCache,
) -> Result<[SceneMesh; 2], AnalysisError> {
    let Some([pinion, wheel]) = in_memory else { return meshes::known_pair_meshes(scene, pair, cache) };
    let one = |whose: &str, gear, exact, mesh: &Mesh| {
        let name = format!("the {whose}'s mesh in memory");
        meshes::checked_mesh(scene, whose, (gear, exact), mesh.clone(), [name.clone(), name])
    };
    Ok([one("pinion", &scene.pinion, &pair.pinion, pinion)?, one("wheel", &scene.wheel, &pair.wheel, wheel)?])
}
