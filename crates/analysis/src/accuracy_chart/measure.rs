//! Runs one point and measures its cost.

use ltca::StaticModel;
use scene::{Analysis, Scene};
use study::{Answer, Work};

use super::{
    Point, calculix_point, lumped_point,
    measured::{ChartTools, Measured, REPEATS},
    phase_times::PhaseTimes,
    plan::Engine,
};
use crate::{
    AnalysisError, NoSink, StaticResult, accuracy::BoundsOfResults, solver_error, static_certificate,
    statics::CycleAnalysis,
};

/// Phase of the positions.
const SOLVE: &str = "solve";
/// A cycle that takes longer than this (s) is not run a second time: two cycles of a model that keeps nothing are
/// alike.
const LONG: f64 = 20.0;

/// Runs a point; with `bounds`, what it says of its own error as well.
///
/// # Errors
/// Whatever keeps it from a result; the message is for the chart's table.
pub(super) fn measure(
    point: &Point,
    tools: ChartTools<'_>,
    bounds: Option<&mut BoundsOfResults>,
) -> Result<Measured, AnalysisError> {
    let measured = match point.way.engine {
        Engine::Own(_) => own(point, tools, bounds),
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

fn own(point: &Point, tools: ChartTools<'_>, bounds: Option<&mut BoundsOfResults>) -> Result<Measured, AnalysisError> {
    let mut phases = PhaseTimes::new(tools.memory);
    let solved = CycleAnalysis::new(&point.scene).with_slices_of_scene().solve_into(&mut phases, &mut NoSink)?;
    crate::certificate::verdict(&static_certificate(&point.scene, &solved.history.positions), &point.scene)?;
    let scale = f64::from(point.positions_asked) / f64::from(point.positions);
    let peak_memory_mb = phases.peak_mb();
    let (offline_s, run_s) = (phases.wall_s(|name| name != SOLVE), phases.wall_s(|name| name == SOLVE));
    // Past all clocks and readings of memory: what the point takes is without it.
    let accuracy = match bounds {
        Some(bounds) => bounds.of(&point.scene, &solved).map_err(|e| e.to_string().replace('\n', " ")),
        None => Err("nobody asked for bounds".into()),
    };
    let StaticResult { history, facts, model, .. } = solved;
    let further_s = match model {
        Some(model) if run_s < LONG => Some(warm_solve_seconds(&point.scene, model)?),
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
        peak_memory_mb,
        dof_before: facts.dof_before.iter().sum(),
        dof_after: facts.dof_after.iter().sum(),
    };
    let widened = history.remarks.iter().find(|w| w.code() == "window_widened");
    Ok(Measured { work, answer, note: widened.map(ToString::to_string).unwrap_or_default(), accuracy })
}

/// Wall time (s) of the scene's positions once more on gears that are reduced already.
///
/// # Errors
/// [`AnalysisError::Solver`].
fn warm_solve_seconds(scene: &Scene, mut model: StaticModel) -> Result<f64, AnalysisError> {
    let start = std::time::Instant::now();
    let Analysis { positions_per_cycle, cycles, .. } = scene.analysis;
    let run = model.run(positions_per_cycle as usize, cycles as usize, |_, _, _| ());
    run.map_err(|e| solver_error(scene, e))?;
    Ok(start.elapsed().as_secs_f64())
}

/// Seconds of one cycle of a model without meshes, a mean of many.
fn time_closed_form(scene: &Scene, tools: ChartTools<'_>) -> Result<f64, AnalysisError> {
    let mut phases = PhaseTimes::new(tools.memory);
    for _ in 0..REPEATS {
        CycleAnalysis::new(scene).with_slices_of_scene().solve_into(&mut phases, &mut NoSink)?;
    }
    Ok(phases.wall_s(|name| name == SOLVE) / f64::from(REPEATS))
}
