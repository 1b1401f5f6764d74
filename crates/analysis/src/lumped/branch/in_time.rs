//! Periodic motions integrated in time: a motion that the branch classifies as stable must persist.

use integrate::{Course, EvenRows, Row, State, StepControl};
use nalgebra::DMatrix;
use periodic::{FourierSeries, PeriodicMotion};
use scene::{MotionScene, Run};
use study::extent;

use super::{
    super::{
        LumpedInputs,
        analysis::refuse_unstable,
        inputs::LumpedSystem,
        integration::method,
        mechanism::BoxedMechanism,
        run_loop::{LumpedRun, NoRunObserver, RunPlan},
    },
    family::ModelFamily,
};
use crate::{
    AnalysisError,
    branch::{TimePoint, state},
    error::in_scene,
    inputs::motion_of,
};

/// Difference after a period over the peak to peak that is none for a guess.
const ROUGHLY: f64 = 1e-2;
/// Harmonics of a motion that has settled.
const HARMONICS: usize = 12;

/// Runs a motion of the branch on, until it repeats itself or for as long as the scene waits for that.
///
/// # Errors
/// Those of the run.
pub(super) fn integrated(
    family: &ModelFamily<'_>,
    inputs: &LumpedInputs,
    (motion, peak_to_peak): (&PeriodicMotion, f64),
) -> Result<TimePoint, AnalysisError> {
    let here = inputs.in_scene(family.scene_at(motion.parameter));
    let run = steady(&here, &mut here.build()?, Some(&state(motion, 0.0)))?;
    let errors = run.rows.series(0..run.rows.len(), |row| row.transmission_error_um)?;
    let [low, high] = extent(&errors);
    Ok(TimePoint { value: motion.parameter, peak_to_peak_dte_um: high - low, branch_peak_to_peak_dte_um: peak_to_peak })
}

/// Coordinates of the motion that a start from rest settles to, as a series: where a branch begins. `None` where it
/// does not repeat itself, not even roughly.
///
/// # Errors
/// Those of the run.
pub(super) fn settled(inputs: &LumpedInputs, cycles: u32) -> Result<Option<FourierSeries>, AnalysisError> {
    let (mut system, scene) = (inputs.build()?, &inputs.scene);
    let motion = motion_of(scene)?;
    let run = steady(inputs, &mut system, None)?;
    let residual = run.periodicity.as_ref().map_or(f64::INFINITY, |p| p.residual);
    if residual.is_nan() || residual > ROUGHLY {
        return Ok(None);
    }
    let frequencies = inputs.frequencies(motion, system.resonance_hz);
    let count = (cycles * motion.steps_per_mesh_cycle) as usize;
    let times = EvenRows {
        method: method(&system.model, motion),
        control: StepControl::new(motion.error_tolerance, frequencies.step(motion)),
        first: run.end.time,
        spacing: 1.0 / (f64::from(motion.steps_per_mesh_cycle) * frequencies.mesh_hz),
        rows: count,
    };
    let mut samples = DMatrix::zeros(run.end.q.len(), count);
    let mut columns = samples.column_iter_mut();
    let mut course = Course::new(&mut system.model, times, run.end);
    let mut sampled = |at: Row<'_, &mut BoxedMechanism>| {
        if let Some(mut column) = columns.next() {
            column.copy_from(&at.state.q);
        }
        Ok::<_, AnalysisError>(())
    };
    let done = course.run_cycle(Some(&mut sampled)).and_then(|_| course.run_cycle(Some(&mut sampled)));
    done.map_err(in_scene(scene))?;
    Ok(FourierSeries::of_samples(&samples, HARMONICS * cycles as usize))
}

/// A run to the steady state, and the mesh cycles that the scene writes of one.
fn steady(inputs: &LumpedInputs, system: &mut LumpedSystem, from: Option<&State>) -> Result<LumpedRun, AnalysisError> {
    let scene = &inputs.scene;
    let motion = MotionScene { run: Run::Steady, ..motion_of(scene)?.clone() };
    let frequencies = inputs.frequencies(&motion, system.resonance_hz);
    refuse_unstable(scene, &motion, &mut system.model, frequencies)?;
    let plan = RunPlan { scene, motion: &motion, frequencies, from, checkpoint_every: 0, resume: None };
    plan.run(&mut system.model, &mut NoRunObserver).map_err(in_scene(scene))
}
