//! A cheaper model at the positions of the chart: its result for the static pair under load.

use std::time::Instant;

use study::{Answer, Work};

use super::{
    Point,
    measured::{ChartTools, Measured, REPEATS, degrees_of_freedom},
    phase_times::PhaseTimes,
};
use crate::{
    AnalysisError, NoCache,
    lumped::{ExcitationSource, LumpedInputs},
    refused::Refusal,
};

/// A cycle that takes longer than this (s) is timed once.
const LONG: f64 = 0.05;

/// Runs a point; time before the first position is that of making the model, the reduced one that feeds it included.
///
/// # Errors
/// [`AnalysisError`] for a scene that the model cannot be made of, and where it finds nothing to rest on.
pub(super) fn measure(point: &Point, tools: ChartTools<'_>) -> Result<Measured, AnalysisError> {
    let mut phases = PhaseTimes::new(tools.memory);
    let start = Instant::now();
    let system = LumpedInputs::gather(&point.scene, &mut ExcitationSource::new(&mut phases, &NoCache))?.build()?;
    let offline_s = start.elapsed().as_secs_f64();
    let count = point.positions as usize;
    let nothing = || nothing_holds(&point.scene);
    let cycle = || system.static_cycle(count).ok_or_else(nothing);
    let start = Instant::now();
    let found = cycle()?;
    let cycle_s = start.elapsed().as_secs_f64();
    let repeats = if cycle_s > LONG { 1 } else { REPEATS };
    let start = Instant::now();
    for _ in 0..repeats {
        cycle()?;
    }
    let further_s = start.elapsed().as_secs_f64() / f64::from(repeats);
    let lengths: Option<Vec<f64>> = found.iter().map(|p| p.line_length).collect();
    let coordinates = system.coordinates();
    // What feeds it was meshed.
    let meshed = degrees_of_freedom(&point.scene)?;
    Ok(Measured {
        work: Work {
            offline_s,
            cycle_s,
            further_cycle_s: Some(further_s),
            positions_run: count,
            positions_asked: point.positions_asked as usize,
            peak_memory_mb: phases.peak_mb(),
            dof_before: if meshed > 0 { meshed } else { coordinates },
            dof_after: coordinates,
        },
        answer: Answer {
            ste_um: found.iter().map(|p| 1e3 * p.error).collect(),
            line_length_mm: lengths.unwrap_or_default(),
        },
        note: system.remarks.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "),
        accuracy: Err("no bounds of models with rigid gears".into()),
    })
}

fn nothing_holds(scene: &scene::Scene) -> AnalysisError {
    AnalysisError::from(Refusal::no_result("nothing holds the loaded pair", None)).in_file(&scene.file)
}
