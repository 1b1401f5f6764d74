//! The next width of a window of teeth that was too narrow.

use geometry::GearPair;
use ltca::{StaticError, StaticOptions};
use scene::Scene;

use crate::meshes::SceneMesh;

/// One more tooth, when a pair beside the window would touch, the user has not fixed the width, and the meshes have the
/// teeth.
pub(crate) fn wider_window(
    scene: &Scene,
    pair: &GearPair,
    meshes: &[SceneMesh; 2],
    options: &StaticOptions,
    error: &StaticError,
) -> Option<usize> {
    let teeth = options.window_teeth(pair) + 1;
    let available = |m: &SceneMesh| {
        if m.gear.is_periodic_sector() { m.gear.tooth_count() as usize } else { m.gear.teeth().len() }
    };
    let room = meshes.iter().all(|m| teeth < available(m));
    (error.is_starved() && scene.analysis.window_teeth.is_none() && room).then_some(teeth)
}
