//! Runs one point and says what it took.

use mesh::GearMesh;
use study::{Answer, Work};

use super::{Point, calculix_point, ladder_point, plan::Engine};
use crate::{
    cache::Cache,
    error::CommandError,
    facts::Solved,
    meshes,
    output::ResultDirectory,
    phases::Phases,
    run,
    scene::{Model, Scene, StiffnessFrom},
};

/// What one point gave and took.
#[derive(Debug, Clone)]
pub(super) struct Measured {
    pub work: Work,
    pub answer: Answer,
    /// What a reader of the chart should know of it.
    pub note: String,
}

/// Repeats of a cheap cycle, so that the clock's steps do not show.
pub(super) const REPEATS: u32 = 200;
/// A cycle that takes longer than this (s) is not run a second time: two cycles of a model that keeps nothing are alike.
const LONG: f64 = 20.0;

/// Runs a point.
///
/// # Errors
/// Whatever keeps it from a result; the message is for the chart's table.
pub(super) fn measure(point: &Point, results: &ResultDirectory) -> Result<Measured, CommandError> {
    let measured = match point.way.engine {
        Engine::Own(_) => own(point, results),
        Engine::Ladder(_) => ladder_point::measure(point),
        Engine::Calculix => calculix_point::measure(point),
    };
    measured.map(|mut m| {
        let (run, asked) = (point.positions, point.positions_asked);
        if run < asked {
            let part = format!("{run} of {asked} positions run, the cycle's time scaled from them");
            m.note = if m.note.is_empty() { part } else { format!("{}; {part}", m.note) };
        }
        m
    })
}

fn own(point: &Point, results: &ResultDirectory) -> Result<Measured, CommandError> {
    let mut phases = Phases::quiet();
    let (Solved { history, facts, .. }, model) =
        run::solve_and_keep(&point.scene, &mut phases, results, &Cache::off())?;
    run::certificate(&history.positions).verdict(&point.scene)?;
    let wall =
        |solve: bool| -> f64 { phases.rows().iter().filter(|p| (p.name == "solve") == solve).map(|p| p.wall_s).sum() };
    let scale = f64::from(point.positions_asked) / f64::from(point.positions);
    let (offline_s, run_s) = (wall(false), wall(true));
    let further_s = match model {
        Some(model) if run_s < LONG => Some(run::time_again(&point.scene, model)?),
        Some(_) => None,
        None => Some(time_closed_form(&point.scene, results)?),
    };
    let answer = Answer {
        ste_um: history.positions.iter().map(|p| 1e3 * p.transmission_error).collect(),
        line_length_mm: history.positions.iter().map(|p| p.contact_line_length).collect(),
    };
    let work = Work {
        offline_s,
        cycle_s: scale * run_s,
        further_cycle_s: further_s.map(|s| scale * s),
        positions_run: point.positions as usize,
        positions_asked: point.positions_asked as usize,
        peak_memory_mb: phases.peak_memory_mb(),
        dof_before: facts.dof_before.iter().sum(),
        dof_after: facts.dof_after.iter().sum(),
    };
    let widened = history.warnings.iter().find(|w| w.contains("the window was widened"));
    Ok(Measured { work, answer, note: widened.cloned().unwrap_or_default() })
}

/// Seconds of one cycle of a model without meshes, a mean of many.
fn time_closed_form(scene: &Scene, results: &ResultDirectory) -> Result<f64, CommandError> {
    let mut phases = Phases::quiet();
    for _ in 0..REPEATS {
        run::solve_and_keep(scene, &mut phases, results, &Cache::off())?;
    }
    let solve: f64 = phases.rows().iter().filter(|p| p.name == "solve").map(|p| p.wall_s).sum();
    Ok(solve / f64::from(REPEATS))
}

/// The meshes of a point, as its analysis takes them.
///
/// # Errors
/// As reading and meshing complain.
pub(super) fn point_meshes(scene: &Scene) -> Result<[GearMesh; 2], CommandError> {
    let pair = scene.gear_pair()?;
    let pinion = meshes::gear_mesh(scene, "pinion", &scene.pinion, &pair.pinion)?;
    let wheel = meshes::gear_mesh(scene, "wheel", &scene.wheel, &pair.wheel)?;
    Ok([pinion.gear, wheel.gear])
}

/// Degrees of freedom of both whole gears of a point, bores counted; 0 without meshes.
///
/// # Errors
/// As meshing complains.
pub(super) fn degrees_of_freedom(scene: &Scene) -> Result<usize, CommandError> {
    let fed = scene.mesh.as_ref().is_some_and(|m| m.stiffness_from == StiffnessFrom::Reduced);
    if scene.analysis.model == Model::Iso || (analysis::lumped::is_lumped(scene) && !fed) {
        return Ok(0);
    }
    let pair = scene.gear_pair()?;
    let pinion = meshes::gear_mesh(scene, "pinion", &scene.pinion, &pair.pinion)?;
    let wheel = meshes::gear_mesh(scene, "wheel", &scene.wheel, &pair.wheel)?;
    Ok(3 * (pinion.facts.nodes + wheel.facts.nodes))
}
