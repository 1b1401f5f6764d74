//! The models in motion of a scene at its torque and speed: the dynamic transmission error of each compared with the
//! reduced model, and the cost of a mesh cycle.

use std::time::Instant;

use scene::Scene;

use super::{Density, lumped_scene, measured::ChartTools, phase_times::PhaseTimes, plan};
use crate::{
    AnalysisError, NoCache,
    lumped::{ExcitationSource, LumpedInputs, steady_rows},
    motion::{MotionAnalysis, MotionOutcome, NoMotionSink},
};

/// Mesh cycles that are judged.
const CYCLES: u32 = 4;
/// Models that are run.
pub(super) const WAYS: usize = 6;
/// Name of the model with which the others are compared.
pub const REDUCED: &str = "reduced";

/// A model in motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionRow {
    /// Name of the method.
    pub way: &'static str,
    /// Result, or the reason why there is none.
    pub outcome: Result<MotionPoint, String>,
}

/// Result and cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPoint {
    /// Number of rigid coordinates that are integrated.
    pub coordinates: usize,
    /// Time before the first step, s.
    pub offline_s: f64,
    /// Time per mesh cycle, s.
    pub cycle_s: f64,
    /// Mean of the dynamic transmission error, um.
    pub mean_um: f64,
    /// Root mean square about it.
    pub rms_um: f64,
    /// Largest minus smallest.
    pub peak_to_peak_um: f64,
}

type Edit = fn(&mut Scene);

/// The reduced model with slices, in motion.
fn reduced(scene: &mut Scene) {
    plan::slice(scene);
    lumped_scene::in_motion(scene);
}

/// Every model in motion, `reduced` first.
pub(super) fn rows(
    scene: &Scene,
    density: Density,
    tools: ChartTools<'_>,
    mut seen: impl FnMut(&str),
) -> Vec<MotionRow> {
    let ways: [(&'static str, Edit); WAYS] = [
        (REDUCED, reduced),
        ("lumped8", lumped_scene::lumped8),
        ("lumped12", lumped_scene::lumped12),
        (plan::FED, lumped_scene::lumped12_fed),
        ("shaft18", lumped_scene::shaft18),
        ("impact", lumped_scene::impact),
    ];
    let one = |(way, edit): (&'static str, Edit)| {
        seen(&format!("{way} in motion"));
        let mut own = plan::meshed(scene, Some(density));
        edit(&mut own);
        own.analysis.cycles = CYCLES;
        own.output.root_stress = false;
        own.output.contact_lines = false;
        own.output.vtu = false;
        let outcome = if way == REDUCED { elastic(&own, tools) } else { cheap(&own, tools) };
        MotionRow { way, outcome: outcome.map_err(|e| e.to_string().replace('\n', " ")) }
    };
    ways.into_iter().map(one).collect()
}

/// The reduced model.
fn elastic(scene: &Scene, tools: ChartTools<'_>) -> Result<MotionPoint, AnalysisError> {
    let mut phases = PhaseTimes::new(tools.memory);
    let outcome = MotionAnalysis::new(scene).solve_into(&mut phases, &mut NoMotionSink)?;
    let MotionOutcome::Finished(result) = outcome else {
        // Nobody asked it to stop.
        return Err(crate::error::unasked(scene, "motion"));
    };
    crate::certificate::verdict(&result.facts.certificate, scene)?;
    let dte = result.rows.series(0..result.rows.len(), |row| row.dte_um)?;
    let offline_s = phases.wall_s(|name| !matches!(name, "settle" | "solve"));
    Ok(MotionPoint::of(&dte, 1, offline_s, phases.wall_s(|name| name == "solve") / f64::from(CYCLES)))
}

fn cheap(scene: &Scene, tools: ChartTools<'_>) -> Result<MotionPoint, AnalysisError> {
    let mut phases = PhaseTimes::new(tools.memory);
    let start = Instant::now();
    let inputs = LumpedInputs::gather(scene, &mut ExcitationSource::new(&mut phases, &NoCache))?;
    let system = inputs.build()?;
    let coordinates = system.coordinates();
    let offline_s = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let (rows, cycles) = steady_rows(&inputs, system)?;
    let dte = rows.series(0..rows.len(), |row| row.transmission_error_um)?;
    Ok(MotionPoint::of(&dte, coordinates, offline_s, start.elapsed().as_secs_f64() / cycles as f64))
}

impl MotionPoint {
    /// Point of dynamic transmission errors, um, evenly spaced in time, and what they took.
    fn of(dte_um: &[f64], coordinates: usize, offline_s: f64, cycle_s: f64) -> Self {
        let mean_um = study::mean(dte_um);
        let squares: f64 = dte_um.iter().map(|x| (x - mean_um).powi(2)).sum();
        Self {
            coordinates,
            offline_s,
            cycle_s,
            mean_um,
            rms_um: (squares / dte_um.len().max(1) as f64).sqrt(),
            peak_to_peak_um: study::peak_to_peak(dte_um),
        }
    }
}
