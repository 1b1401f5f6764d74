//! Where a checked scene becomes a call of the solvers.

use crate::error::CommandError;
use crate::facts::Solved;
use crate::output::ResultDirectory;
use crate::phases::Phases;
use crate::scene::{Model, Scene};
use crate::{gears, iso_model};

/// Solves a scene; ParaView files, when asked for, go into `results` on the way.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no solution is found.
pub fn solve(scene: &Scene, phases: &mut Phases, _results: &ResultDirectory) -> Result<Solved, CommandError> {
    let pair = phases.run("geometry", || gears::pair(scene))?;
    match scene.analysis.model {
        Model::Iso => phases.run("solve", || iso_model::solve(scene, &pair)),
        Model::Reduced | Model::Full => {
            Err(CommandError::failed("the finite-element models are not linked into this build", None))
        }
    }
}
