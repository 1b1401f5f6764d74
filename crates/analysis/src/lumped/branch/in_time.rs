//! Periodic motions integrated in time: where the branch says that a motion stays, it must stay.

use periodic::{FourierSeries, PeriodicMotion};
use scene::{MotionScene, Run, Scene};
use serde::Serialize;
use study::extent;

use super::{
    super::{LumpedInputs, LumpedRow, analysis::motion_of, run_loop::RunPlan},
    family::ModelFamily,
    point::state,
};
use crate::AnalysisError;
use nalgebra::DMatrix;

/// Mesh cycles that pass before one is looked at, in periods of the motion.
const PASS: u32 = 20;
/// Mesh cycles to settle from rest, in periods.
const SETTLE: u32 = 200;
/// Harmonics of a motion that has settled.
const HARMONICS: usize = 12;

/// A motion of the branch, integrated in time from there on; units are in the names.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TimePoint {
    /// Value of the key.
    pub value: f64,
    /// Of the mesh cycles that are looked at.
    pub peak_to_peak_dte_um: f64,
    /// Of the branch.
    pub branch_peak_to_peak_dte_um: f64,
}

impl TimePoint {
    /// Difference over that of the branch.
    pub fn difference(&self) -> f64 {
        (self.peak_to_peak_dte_um / self.branch_peak_to_peak_dte_um - 1.0).abs()
    }
}

/// Runs a motion of the branch on.
///
/// # Errors
/// Those of the run.
pub(super) fn integrated(
    family: &ModelFamily<'_>,
    inputs: &LumpedInputs,
    (motion, peak_to_peak): (&PeriodicMotion, f64),
    cycles: u32,
) -> Result<TimePoint, AnalysisError> {
    let rows = run(&inputs.in_scene(family.scene_at(motion.parameter)), Some(motion), PASS * cycles, cycles)?;
    let errors: Vec<f64> = rows.iter().map(|row| row.transmission_error_um).collect();
    let [low, high] = extent(&errors);
    Ok(TimePoint { value: motion.parameter, peak_to_peak_dte_um: high - low, branch_peak_to_peak_dte_um: peak_to_peak })
}

/// Coordinates of a motion that has settled from rest, as a series: where a search from rest finds nothing.
///
/// # Errors
/// Those of the run.
pub(super) fn settled(inputs: &LumpedInputs, cycles: u32) -> Result<Option<FourierSeries>, AnalysisError> {
    let system = inputs.build()?;
    let (mut model, scene) = (system.model, &inputs.scene);
    let motion = motion_of(scene)?;
    let frequencies = inputs.frequencies(motion, system.resonance_hz);
    let first = model.start().map_err(|e| e.of(scene))?;
    let (per_cycle, mut state) = (motion.steps_per_mesh_cycle, first);
    let mut integrator = super::super::run_loop::integrator(&model, motion, frequencies.step(motion));
    let row = 1.0 / (f64::from(per_cycle) * frequencies.mesh_hz);
    let (from, count) = (u64::from(SETTLE * cycles * per_cycle), (cycles * per_cycle) as usize);
    let mut samples = DMatrix::zeros(state.q.len(), count);
    for k in 0..from + count as u64 {
        if k >= from {
            samples.set_column((k - from) as usize, &state.q);
        }
        let until = (k + 1) as f64 * row;
        let advanced = integrator.advance(&mut model, &mut state, until, |_, _| ());
        advanced.map_err(|e| super::super::mechanism::ModelFailure::from(e).of(scene))?;
    }
    Ok(FourierSeries::of_samples(&samples, HARMONICS * cycles as usize))
}

/// Rows of the last mesh cycles of a run.
fn run(
    inputs: &LumpedInputs,
    from: Option<&PeriodicMotion>,
    pass: u32,
    cycles: u32,
) -> Result<Vec<LumpedRow>, AnalysisError> {
    let mut system = inputs.build()?;
    let spans = MotionScene { run: Run::Span, duration_s: None, ..motion_of(&inputs.scene)?.clone() };
    let frequencies = inputs.frequencies(&spans, system.resonance_hz);
    let mut scene: Scene = inputs.scene.clone();
    scene.analysis.cycles = pass + cycles;
    let from = from.map(|motion| state(motion, 0.0));
    let plan = RunPlan { scene: &scene, motion: &spans, frequencies, from: from.as_ref() };
    let run = plan.run(&mut system.model, &mut super::super::run_loop::NoRunObserver).map_err(|e| e.of(&scene))?;
    let kept = cycles as usize * run.per_cycle;
    Ok(run.rows[run.rows.len().saturating_sub(kept)..].to_vec())
}
