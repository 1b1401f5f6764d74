//! Runs one point and says what it took.

use std::path::Path;

use mesh::GearMesh;
use scene::{Model, Scene, StiffnessFrom};
use study::{Answer, Work};

use super::{MemoryGauge, Point, calculix_point, lumped_point, phase_times::PhaseTimes, plan::Engine};
use crate::{
    AnalysisError, NoSink, StaticAnalysis, StaticResult, lumped::is_lumped, meshes, static_certificate, time_again,
};

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
}

/// Phase of the positions.
const SOLVE: &str = "solve";
/// Repeats of a cheap cycle, so that the clock's steps do not show.
pub(super) const REPEATS: u32 = 200;
/// A cycle that takes longer than this (s) is not run a second time: two cycles of a model that keeps nothing are
/// alike.
const LONG: f64 = 20.0;

/// Runs a point.
///
/// # Errors
/// Whatever keeps it from a result; the message is for the chart's table.
pub(super) fn measure(point: &Point, tools: ChartTools<'_>) -> Result<Measured, AnalysisError> {
    let measured = match point.way.engine {
        Engine::Own(_) => own(point, tools),
        Engine::Lumped(_) => lumped_point::measure(point, tools),
        Engine::Calculix => calculix_point::measure(point, tools),
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

fn own(point: &Point, tools: ChartTools<'_>) -> Result<Measured, AnalysisError> {
    let mut phases = PhaseTimes::new(tools.memory);
    let solved = StaticAnalysis::new(&point.scene).with_slices_of_scene().solve_into(&mut phases, &mut NoSink)?;
    let StaticResult { history, facts, model, .. } = solved;
    static_certificate(&history.positions).verdict(&point.scene)?;
    let scale = f64::from(point.positions_asked) / f64::from(point.positions);
    let (offline_s, run_s) = (phases.wall_s(|name| name != SOLVE), phases.wall_s(|name| name == SOLVE));
    let further_s = match model {
        Some(model) if run_s < LONG => Some(time_again(&point.scene, model)?),
        Some(_) => None,
        None => Some(time_closed_form(&point.scene, tools)?),
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
        peak_memory_mb: phases.peak_mb(),
        dof_before: facts.dof_before.iter().sum(),
        dof_after: facts.dof_after.iter().sum(),
    };
    let widened = history.warnings.iter().find(|w| w.contains("the window was widened"));
    Ok(Measured { work, answer, note: widened.cloned().unwrap_or_default() })
}

/// Seconds of one cycle of a model without meshes, a mean of many.
fn time_closed_form(scene: &Scene, tools: ChartTools<'_>) -> Result<f64, AnalysisError> {
    let mut phases = PhaseTimes::new(tools.memory);
    for _ in 0..REPEATS {
        StaticAnalysis::new(scene).with_slices_of_scene().solve_into(&mut phases, &mut NoSink)?;
    }
    Ok(phases.wall_s(|name| name == SOLVE) / f64::from(REPEATS))
}

/// The meshes of a point, as its analysis takes them.
///
/// # Errors
/// As reading and meshing complain.
pub(super) fn point_meshes(scene: &Scene) -> Result<[GearMesh; 2], AnalysisError> {
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
