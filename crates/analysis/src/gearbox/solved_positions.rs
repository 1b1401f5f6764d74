//! A gearbox at rest, position after position.

use std::f64::consts::TAU;

use gearbox::{GearboxError, GearboxPosition, MeshSample, StaticGearbox, Train};
use scene::gearbox::Gearbox;

use super::{meshes::ReducedMesh, vibration::Parts};
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
    let made = StaticGearbox::new(structure.clone(), meshes.to_vec(), operation.clone(), |i, mesh, _| {
        reduced[i].element(mesh)
    });
    let mut gearbox = made.map_err(failed)?;
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
