//! Number of teeth of a window: predicted from the load before gears are reduced, one more if it was too narrow.

use answer::Remark;
use geometry::GearPair;
use ltca::{ForeseenWindow, StaticError, StaticOptions};
use scene::{Model, Scene};

use crate::{loaded_pair::LoadedPair, meshes::SceneMesh, plausible::LoadEstimate, remark};

/// Share of the estimated deflection that surely bends the teeth: a window is widened in advance only where it would
/// starve.
const SURE: f64 = 0.85;

/// The window that the load asks for before anything is reduced, and what a user should hear of it: teeth bend by the
/// deflection of ISO 6336-1. `None` where that of the contact ratio seems to do, the user has fixed the width, or the
/// meshes have too few teeth.
pub(crate) fn foreseen_window(
    scene: &Scene,
    pair: &GearPair,
    meshes: &[SceneMesh; 2],
    options: &StaticOptions,
) -> Option<(usize, Remark)> {
    if options.window.is_some() || scene.analysis.model == Model::Full {
        return None;
    }
    let deflection = LoadEstimate::deflection_mm(&LoadedPair::of(scene, pair));
    let ForeseenWindow { teeth, pair } = ForeseenWindow::new(pair, options, SURE * deflection)?;
    let (torque, least) = (1e-3 * options.torque, teeth - 1);
    let said = format!(
        "under {torque} N m teeth bend by some {:.0} um (ISO 6336-1), and pair {pair} outside a window of {least} teeth would overlap",
        1e3 * deflection
    );
    has_room(meshes, teeth).then(|| (teeth, remark::window_widened(said, teeth)))
}

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
    (error.is_starved() && scene.analysis.window_teeth.is_none() && has_room(meshes, teeth)).then_some(teeth)
}

/// Whether both meshes have more teeth than a window.
fn has_room(meshes: &[SceneMesh; 2], teeth: usize) -> bool {
    let available = |m: &SceneMesh| {
        if m.gear.is_periodic_sector() { m.gear.tooth_count() as usize } else { m.gear.teeth().len() }
    };
    meshes.iter().all(|m| teeth < available(m))
}
