//! Where a checked scene becomes a call of the solvers.

use crate::error::CommandError;
use crate::facts::Solved;
use crate::output::ResultDirectory;
use crate::phases::Phases;
use crate::scene::{Model, Scene};
use crate::{gears, iso_model, meshes};

/// Solves a scene; ParaView files, when asked for, go into `results` on the way.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no solution is found.
pub fn solve(scene: &Scene, phases: &mut Phases, _results: &ResultDirectory) -> Result<Solved, CommandError> {
    let pair = phases.run("geometry", || gears::pair(scene))?;
    if scene.analysis.model == Model::Iso {
        return phases.run("solve", || iso_model::solve(scene, &pair));
    }
    let _meshes = phases.run("mesh", || {
        let pinion = meshes::gear_mesh(scene, "pinion", &scene.pinion, &pair.pinion)?;
        let wheel = meshes::gear_mesh(scene, "wheel", &scene.wheel, &pair.wheel)?;
        Ok::<_, CommandError>([pinion, wheel])
    })?;
    Err(CommandError::failed("the finite-element models are not linked into this build", None))
}
