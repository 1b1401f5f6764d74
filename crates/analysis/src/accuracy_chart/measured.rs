//! Resources of a chart point, its result, and its meshes.

use std::path::Path;

use mesh::MeshedGear;
use scene::{Model, Scene, StiffnessFrom};
use study::{Answer, Work};

use super::MemoryGauge;
use crate::{AnalysisError, accuracy::Accuracy, lumped::is_lumped, meshes};

/// Repeats of a cheap cycle, so that the clock's steps do not show.
pub(super) const REPEATS: u32 = 200;

/// What a point may use of the machine.
#[derive(Clone, Copy)]
pub(super) struct ChartTools<'a> {
    pub memory: &'a dyn MemoryGauge,
    /// A folder for the files of CalculiX; `None`: it is not run.
    pub scratch: Option<&'a Path>,
}

/// What one point gave and took.
#[derive(Debug, Clone)]
pub(super) struct Measured {
    pub work: Work,
    pub answer: Answer,
    /// What a reader of the chart should know of it.
    pub note: String,
    /// What the model says of its own error, or why it says nothing.
    pub accuracy: Result<Accuracy, String>,
}

/// The meshes of a point, as its analysis takes them.
///
/// # Errors
/// As reading and meshing complain.
pub(super) fn point_meshes(scene: &Scene) -> Result<[MeshedGear; 2], AnalysisError> {
    let pair = scene.gear_pair()?;
    let pinion = meshes::gear_mesh(scene, "pinion", &scene.pinion, &pair.pinion)?;
    let wheel = meshes::gear_mesh(scene, "wheel", &scene.wheel, &pair.wheel)?;
    Ok([pinion.gear, wheel.gear])
}

/// Degrees of freedom of both whole gears of a point, bores counted; 0 without meshes.
///
/// # Errors
/// As meshing complains.
pub(super) fn degrees_of_freedom(scene: &Scene) -> Result<usize, AnalysisError> {
    let fed = scene.mesh.as_ref().is_some_and(|m| m.stiffness_from == StiffnessFrom::Reduced);
    if scene.analysis.model == Model::Iso || (is_lumped(scene) && !fed) {
        return Ok(0);
    }
    let pair = scene.gear_pair()?;
    let pinion = meshes::gear_mesh(scene, "pinion", &scene.pinion, &pair.pinion)?;
    let wheel = meshes::gear_mesh(scene, "wheel", &scene.wheel, &pair.wheel)?;
    Ok(3 * (pinion.facts.nodes + wheel.facts.nodes))
}
