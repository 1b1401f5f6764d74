//! A static gearbox, position by position.

use std::f64::consts::TAU;

use gearbox::{GearboxError, GearboxPosition, MeshSample, Operation, StaticGearbox, Torque, Train};
use scene::gearbox::Gearbox;

use super::{
    meshes::{ReducedMesh, wheel_turns},
    vibration::Parts,
};
use crate::{AnalysisError, Progress, unless_cancelled};

/// Positions of a gearbox under the torques of its operation, and what a vibration reads of its meshes.
///
/// # Errors
/// [`AnalysisError::Gearbox`], [`AnalysisError::Cancelled`].
pub(super) fn at_all_angles(
    parts: &Parts<'_>,
    reduced: &[ReducedMesh],
    progress: &dyn Progress,
) -> Result<(Vec<GearboxPosition>, Vec<Vec<MeshSample>>), AnalysisError> {
    let Parts { file, structure, meshes, operation, .. } = *parts;
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&file.file);
    let mut common = Vec::new();
    let made = StaticGearbox::new(structure.clone(), meshes.to_vec(), operation.clone(), |i, mesh, _| {
        reduced[i].element(mesh, &mut common)
    });
    let mut gearbox = made.map_err(failed)?.joined();
    let mut positions: Vec<GearboxPosition> = Vec::new();
    let mut samples: Vec<Vec<MeshSample>> = vec![Vec::new(); meshes.len()];
    for angle in angles(file, gearbox.train()) {
        let position = gearbox.solve(angle).map_err(failed)?;
        for (i, own) in samples.iter_mut().enumerate() {
            own.extend(MeshSample::at(&gearbox, &position, i));
        }
        positions.push(position);
        progress.tick();
        unless_cancelled(progress)?;
    }
    Ok((positions, samples))
}

/// Positions of a gearbox that turns the other way round under torques the other way round: its coast flanks press. Of
/// meshes whose gears are reduced for both flanks.
///
/// # Errors
/// As of [`at_all_angles`].
pub(super) fn on_coast_flanks(
    parts: &Parts<'_>,
    reduced: &[ReducedMesh],
    progress: &dyn Progress,
) -> Result<Vec<GearboxPosition>, AnalysisError> {
    let Parts { file, structure, meshes, operation, .. } = *parts;
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&file.file);
    let torques = operation.torques.iter().map(|own| Torque { torque: -own.torque, ..*own }).collect();
    let operation = Operation { sense: operation.sense.opposite(), torques, ..operation.clone() };
    let train = Train::new(structure, meshes, &operation.keys, operation.input, operation.sense).map_err(failed)?;
    let turns = wheel_turns(file, &train);
    let made = StaticGearbox::new(structure.clone(), meshes.to_vec(), operation, |i, mesh, meshing| {
        reduced[i].turned_round(mesh, (meshing, turns[i]))
    });
    let mut gearbox = made.map_err(failed)?.joined();
    let one = |angle: f64| {
        unless_cancelled(progress)?;
        gearbox.solve(angle).map_err(failed)
    };
    angles(file, &train).map(one).collect()
}

/// Positions at which a gearbox is solved.
pub(super) fn count(file: &Gearbox) -> u32 {
    file.positions_per_cycle.saturating_mul(file.cycles)
}

/// Angles of the input (rad about +z) at which the first mesh has gone through its cycles, evenly spaced from where it
/// starts.
fn angles(file: &Gearbox, train: &Train) -> impl Iterator<Item = f64> + use<> {
    let first = &train.meshing()[0];
    let teeth = f64::from(file.meshes[0].scene.pinion.teeth);
    let pitch = first.sense.sign() as f64 * TAU / teeth / first.ratio;
    let per_cycle = f64::from(file.positions_per_cycle);
    (0..count(file)).map(move |i| pitch * f64::from(i) / per_cycle)
}
