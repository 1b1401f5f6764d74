//! Laws of pairs, applied to the meshes of a gearbox.

use gearbox::Train;
use gearbox::mesh_numbers::mean;
use scene::{Driver, Quantity, Scene, gearbox::Gearbox};

use crate::{
    AnalysisError, GearCache, NoObserver, NoSink,
    accuracy::{Accuracy, Bound, Companions, bounds_of},
    gearbox::{
        GearboxResult,
        solve::{Slices, running},
    },
    statics::CycleAnalysis,
};

/// Bounds of the pair of a mesh that stands alone under its mean load and misalignment; else why there are none.
pub(super) type OfPair = Result<Accuracy, String>;

/// Bounds of the pairs of all meshes of a solved gearbox, whose scenes are settled.
///
/// # Errors
/// [`AnalysisError::Cancelled`], and where meshes and shafts do not fit each other.
pub(super) fn pairs(
    file: &Gearbox,
    result: &GearboxResult,
    cache: &dyn GearCache,
    companions: &mut [Companions],
) -> Result<Vec<OfPair>, AnalysisError> {
    let (train, scenes) = running(file, Slices::AsTheyAre)?;
    let alone = |(i, (scene, companions)): (usize, (Scene, &mut Companions))| {
        let scene = alone(scene, result, i, positions(file, &train, i));
        if scene.operation.torque_nm == 0.0 {
            return Ok(Err("it carries no load".to_owned()));
        }
        let solved = CycleAnalysis::new(&scene).with_slices_of_scene().with_cache(cache);
        let bounds = solved
            .solve_into(&mut NoObserver, &mut NoSink)
            .and_then(|solved| bounds_of(&scene, &solved, cache, companions));
        match bounds {
            Err(e) if matches!(e.what(), AnalysisError::Cancelled) => Err(e),
            bounds => Ok(bounds.map_err(|e| e.to_string())),
        }
    };
    scenes.into_iter().zip(companions).enumerate().map(alone).collect()
}

/// Positions in a cycle of a mesh that are as near to each other as those of the gearbox.
fn positions(file: &Gearbox, train: &Train, mesh: usize) -> u32 {
    let turns = |i: usize| train.meshing()[i].ratio.abs() * f64::from(file.meshes[i].scene.pinion.teeth);
    let own = f64::from(file.positions_per_cycle) * turns(0) / turns(mesh);
    (2.0 * (0.5 * own).round()).clamp(2.0, 512.0) as u32
}

/// The scene of a mesh with the torque and the misalignment that it has in the gearbox, as means over all positions.
fn alone(mut scene: Scene, result: &GearboxResult, mesh: usize, positions: u32) -> Scene {
    let driven = usize::from(scene.operation.driver == Driver::Pinion);
    let torque = mean(result.positions.iter().map(|p| p.meshes[mesh].moment[driven][2]));
    scene.operation.torque_nm = 1e-3 * torque.abs();
    let [in_plane, across] = result.meshes[mesh].misalignment;
    scene.pair.misalignment.in_plane_of_action_um += 1e3 * in_plane;
    scene.pair.misalignment.across_plane_of_action_um += 1e3 * across;
    (scene.analysis.positions_per_cycle, scene.analysis.cycles) = (positions, 1);
    scene.output.root_stress = false;
    scene
}

/// The bound of a quantity.
pub(super) fn bound(of: &OfPair, quantity: Quantity) -> Option<&Bound> {
    of.as_ref().ok()?.bounds.iter().find(|b| b.quantity == quantity)
}
