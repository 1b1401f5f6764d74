//! One motion of a scene.

use std::sync::Arc;

use ale::solve_widening;
use answer::{Remark, RowStore};
use gearbox::motion::PairModel;
use geometry::GearPair;
use integrate::{Periodicity, SteadySteps};
use mesh::Mesh;
use scene::{MotionScene, Run, Scene};
use study::Window;

use super::{
    CampbellDiagram, MotionCheckpoint, MotionHeadline, MotionLayout, MotionRow, MotionSeries, MotionSink,
    MotionSpectrum, NoMotionSink, RunUp, Waterfall,
    course::{self, FinishedMotion, ResumedState, Span},
    dropped::dropped_by,
    headline, motion_remarks,
    setup::{MotionInputs, PreparedMotion, QuasiStatic, Vibration, mesh_range_hz, prepare, speed},
    step_estimate::{Pace, StepDemand},
    window,
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer,
    error::{in_scene, unasked},
    facts::RunInfo,
    failure::Failure,
    flank_orders::{FlankWaves, orders_of_no_turn},
    in_motion::{MeshRecord, StepKeys, steps_of_cycle, stretched},
    inputs::resolved_scene,
    refused::Refusal,
    results::{GearPattern, root_stress_remarks},
    run_up::RunUpTorque,
};

/// A scene to be solved in time: `run` "steady", "shooting", "span" or "ramp" with reduced gears.
#[derive(Clone)]
pub struct MotionAnalysis<'a> {
    scene: &'a Scene,
    meshes: Option<[&'a Mesh; 2]>,
    cache: &'a dyn GearCache,
    from: Option<ResumedState>,
    stop_after: Option<u64>,
}

impl std::fmt::Debug for MotionAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MotionAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

/// How a motion ended.
#[derive(Debug)]
pub enum MotionOutcome {
    /// It was completed.
    Finished(Box<MotionResult>),
    /// It stopped where requested; the sink has a checkpoint.
    Stopped {
        /// Number of completed mesh cycles.
        cycles: u64,
    },
}

/// Result of a scene in time.
#[derive(Debug, Clone)]
pub struct MotionResult {
    /// The nominal gear pair.
    pub pair: GearPair,
    /// Rows, the same number in each mesh cycle.
    pub rows: Arc<RowStore<MotionRow>>,
    /// Properties that all rows have in common.
    pub layout: MotionLayout,
    /// Headline values.
    pub headline: MotionHeadline,
    /// The static mesh cycle with which the motion starts.
    pub quasi_static: QuasiStatic,
    /// Spectrum of a motion at constant speed.
    pub spectrum: Option<MotionSpectrum>,
    /// Waves on the driving flanks, beside the orders of the spectrum.
    pub flank_waves: FlankWaves,
    /// Results of a motion with a speed ramp.
    pub ramp: Option<RampResult>,
    /// Pressure patterns on the driving flanks.
    pub patterns: [GearPattern; 2],
    /// Facts about the model, with its certificate.
    pub facts: RunInfo,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

/// Results of a run-up or run-down over speed.
#[derive(Debug, Clone)]
pub struct RampResult {
    /// Results per mesh cycle.
    pub run_up: RunUp,
    /// Order spectra, section by section.
    pub waterfall: Waterfall,
    /// Campbell diagram: mesh orders and the pair's frequencies.
    pub campbell: CampbellDiagram,
}

impl<'a> MotionAnalysis<'a> {
    /// Analysis of a scene, with its meshes read or generated as it says.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, meshes: None, cache: &NoCache, from: None, stop_after: None }
    }

    /// Uses meshes of pinion and wheel from the caller instead of those of the scene. They are checked like mesh files.
    #[must_use]
    pub fn with_meshes(self, meshes: [&'a Mesh; 2]) -> Self {
        Self { meshes: Some(meshes), ..self }
    }

    /// Uses reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Continues from a checkpoint. `rows` are all preceding rows, in the bits in which they were passed to the sink.
    #[must_use]
    pub fn resume(self, checkpoint: MotionCheckpoint, rows: impl Into<Arc<RowStore<MotionRow>>>) -> Self {
        Self { from: Some(ResumedState { checkpoint, rows: rows.into() }), ..self }
    }

    /// Stops after a number of mesh cycles, settling included, and returns a checkpoint; `None`: only at its end.
    #[must_use]
    pub fn stop_after(self, cycles: Option<u64>) -> Self {
        Self { stop_after: cycles, ..self }
    }

    /// Solves it to its end without progress reports; a request to stop before that is ignored.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(self) -> Result<MotionResult, AnalysisError> {
        result(self.stop_after(None).follow(&mut NoObserver, &mut NoMotionSink)?)
    }

    /// Solves it; rows are passed to `sink` as they are computed.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        self,
        observer: &mut dyn Observer,
        sink: &mut dyn MotionSink,
    ) -> Result<MotionOutcome, AnalysisError> {
        let followed = self.follow(observer, sink)?;
        if followed.done.stopped {
            return Ok(MotionOutcome::Stopped { cycles: followed.done.motion.cycle() });
        }
        Ok(MotionOutcome::Finished(Box::new(result(followed)?)))
    }

    /// Follows the motion to its end, or to where it is to stop, with window after window until one suffices.
    fn follow(self, observer: &mut dyn Observer, sink: &mut dyn MotionSink) -> Result<FollowedMotion, AnalysisError> {
        let Self { meshes, cache, mut from, stop_after, .. } = self;
        let scene = resolved_scene(self.scene, meshes.is_some());
        if !scene.accuracy.is_none() {
            return Err(in_scene(&scene)(Refusal::with_accuracy()));
        }
        let one_motion = |m: &&MotionScene| m.sweep.is_none() && scene.analysis.model.is_reduced();
        let motion = scene
            .motion
            .as_ref()
            .filter(one_motion)
            .ok_or_else(|| unasked(&scene, "single motion of reduced gears"))?;
        from.as_ref().map_or(Ok(()), |from| check_rows(&scene, motion, from))?;
        let inputs = MotionInputs::new((&scene, motion), meshes, cache, observer)?;
        let facts: Vec<_> = inputs.meshes.iter().map(|m| m.facts.clone()).collect();
        sink.meshes(&facts).map_err(AnalysisError::Sink)?;
        let mut widened = Vec::new();
        let solved = solve_widening(
            from.as_ref().map(|f| f.checkpoint.window),
            |window| {
                let prepared = ready(&inputs, observer, sink, window)?;
                let span = Span { from: from.take(), stop_after };
                let done = course::run((&scene, motion), &prepared, observer, sink, span)?;
                let system = done.motion.system();
                let force = system.extremes(0).largest_force;
                match dropped_by(&prepared.system, system.changes(0).jump, force)
                    .filter(|e| inputs.wider(window, e).is_some())
                {
                    Some(e) => Err(Failure::Static(e)),
                    None => Ok((prepared, done)),
                }
            },
            |window, failure| {
                let Failure::Static(e) = failure else { return None };
                let teeth = inputs.wider(window, e)?;
                widened.push(motion_remarks::widened(e, teeth));
                Some(teeth)
            },
        );
        let (mut prepared, done) = solved.map_err(|e: Failure| e.into_error(&scene))?;
        prepared.remarks.extend(widened);
        let (pair, motion) = (inputs.pair, motion.clone());
        Ok(FollowedMotion { scene, motion, pair, prepared, done })
    }
}

/// A motion as far as it was followed, and what it was made of.
struct FollowedMotion {
    scene: Scene,
    motion: MotionScene,
    pair: GearPair,
    prepared: PreparedMotion,
    done: FinishedMotion,
}

fn check_rows(scene: &Scene, motion: &MotionScene, from: &ResumedState) -> Result<(), AnalysisError> {
    let wanted = (from.checkpoint.motion.stage.recorded as usize).saturating_mul(motion.steps_per_mesh_cycle as usize);
    let found = from.rows.len();
    if found == wanted {
        return Ok(());
    }
    let what = format!("{found} rows are given, {wanted} came before the checkpoint");
    let hint = "give all rows that the run before handed out, and no more";
    Err(in_scene(scene)(Refusal::input(what, hint)))
}

/// A pair that is ready to move, with what a user should hear before it does.
pub(super) fn ready(
    inputs: &MotionInputs<'_>,
    observer: &mut dyn Observer,
    sink: &mut dyn MotionSink,
    window: Option<usize>,
) -> Result<PreparedMotion, Failure> {
    let MotionInputs { scene, motion, .. } = *inputs;
    let mut prepared = prepare(inputs, observer, sink, window)?;
    motion_remarks::endless(scene, &prepared)?;
    motion_remarks::unstable(scene, &prepared)?;
    prepared.remarks.extend(motion_remarks::coarse(scene, motion, &prepared));
    prepared.remarks.extend(motion_remarks::without_backlash(scene, &prepared));
    let slow =
        motion_remarks::slow(scene, motion, &prepared).or_else(|| motion_remarks::long(scene, motion, &prepared));
    if let Some(slow) = slow {
        // Who waits should hear it before the end.
        observer.note(slow.to_string());
        prepared.remarks.push(slow);
    }
    Ok(prepared)
}

/// Mesh orders through the mesh resonance and the gears' elastic frequencies, those with the bores held, at rest.
pub(super) fn campbell_diagram(
    prepared: &PreparedMotion,
    teeth: u32,
    highest_mesh_hz: f64,
) -> Result<CampbellDiagram, AnalysisError> {
    let resonance = (prepared.system.mesh_resonance_hz(), "mesh resonance".to_owned());
    let all = std::iter::once(resonance).chain(prepared.elasticity.frequencies_hz());
    Ok(CampbellDiagram::of(all, teeth, highest_mesh_hz)?)
}

fn result(followed: FollowedMotion) -> Result<MotionResult, AnalysisError> {
    let FollowedMotion { scene, motion, pair, prepared, done } = followed;
    let (scene, motion) = (&scene, &motion);
    let per_cycle = motion.steps_per_mesh_cycle as usize;
    let teeth = scene.driver_teeth();
    let series = MotionSeries::of(&done.rows, motion.ramp.is_some())?;
    let driver = 1 - prepared.system.options().statics.driven();
    let driver_rpm = done.rows.series(0..done.rows.len(), |row| row.speed_rpm[driver])?;
    let mesh_hz = mesh_range_hz(scene, motion, Some(&driver_rpm));
    let mut ramp = None;
    if let Some(asked) = motion.ramp {
        let waterfall = series.waterfall(per_cycle, asked.waterfall_cycles as usize, scene.pinion.teeth)?;
        let (law, force) = (speed(scene), prepared.quasi_static.normal_force);
        let run_up = RunUp::of(&series, per_cycle, (law, teeth), force, &waterfall)?;
        ramp = Some(RampResult { run_up, waterfall, campbell: campbell_diagram(&prepared, teeth, mesh_hz[1])? });
    }
    let run_up = ramp.as_ref().map(|r| &r.run_up);
    let mut headline = headline::headline((scene, motion), &prepared, (&done, &series, &driver_rpm), run_up)?;
    if let Some(ramp) = &ramp {
        headline.critical_speeds = ramp.campbell.critical_speeds();
    }
    let own = &headline.certificate;
    let found = own.period_cycles.zip(own.periodicity).map(|(period, residual)| Periodicity { period, residual });
    let window = window(found, motion.periodic_tolerance.unwrap_or(1e-6), headline.cycles);
    let spectrum = match &ramp {
        Some(_) => None,
        None => Some(series.spectrum((headline.cycles as f64, headline.mesh_frequency_hz), window)?),
    };
    let mean = done.motion.steps_per_cycle();
    let steps = time_steps((motion, mean), &prepared, headline.mesh_frequency_hz);
    let mut remarks = remarks_of((scene, motion), &prepared, &headline, mesh_hz, done.wall_s);
    if let Some(ramp) = &ramp {
        remarks.extend(run_up_torque(scene, &prepared.system));
        let cure = "a longer `duration_s` or fewer `waterfall_cycles` in [motion.ramp] show it better";
        remarks.extend(ramp.run_up.coarse_cut(cure));
    }
    if motion.ramp.is_none() {
        let (samples, cycles) = (&series.dte_um[..], headline.cycles as f64);
        let comes_back = window == Window::Rectangular;
        let resolved =
            MeshRecord { samples, cycles, steps, comes_back, keys: StepKeys::PAIR.by(motion.error_tolerance) }
                .resolved();
        headline.certificate.step_error_percent = resolved.step_error_percent;
        remarks.extend(resolved.remarks);
        remarks.extend(orders_of_no_turn(&pair, headline.cycles));
    }
    let PreparedMotion { quasi_static, mut facts, .. } = prepared;
    facts.certificate = facts.certificate.and(headline.checks(scene, &pair));
    let FinishedMotion { rows, layout, patterns, .. } = done;
    let (rows, flank_waves) = (Arc::new(rows), FlankWaves::of(scene, &pair));
    Ok(MotionResult {
        pair,
        rows,
        layout,
        headline,
        quasi_static,
        spectrum,
        flank_waves,
        ramp,
        patterns,
        facts,
        remarks,
    })
}

/// Steps of a motion at constant speed, `mean` of them in a mesh cycle on average; `None` of a ramp, and where they do not
/// tell their error.
fn time_steps(
    (motion, mean): (&MotionScene, Option<f64>),
    prepared: &PreparedMotion,
    mesh_hz: f64,
) -> Option<SteadySteps> {
    let (resonance, scheme) = (prepared.system.mesh_resonance(), prepared.times.scheme);
    let equal = 1.0 / (prepared.times.step(1.0 / mesh_hz) * mesh_hz);
    let per_period = steps_of_cycle(scheme, motion.error_tolerance, (equal, mean)).filter(|_| motion.ramp.is_none())?;
    Some(SteadySteps { per_period, scheme, resonance: resonance.hz / mesh_hz, damping: resonance.damping })
}

/// Remark on the torque at the driven gear that the ramp of a scene takes.
fn run_up_torque(scene: &Scene, system: &PairModel) -> Option<Remark> {
    let driven = system.options().statics.driven();
    let gears = [&system.pair().pinion, &system.pair().wheel];
    let inertia = system.base_circle_masses()[driven] * gears[driven].base_radius().powi(2);
    let ratio = f64::from(gears[1 - driven].data().teeth) / f64::from(gears[driven].data().teeth);
    let torque = RunUpTorque::new(speed(scene), (inertia, ratio), scene.operation.torque());
    torque?.remark("the driven gear", "a longer `duration_s` in [motion.ramp] makes it gentler")
}

/// What was heard before the motion, and what its numbers say.
fn remarks_of(
    (scene, motion): (&Scene, &MotionScene),
    prepared: &PreparedMotion,
    headline: &MotionHeadline,
    mesh_hz: [f64; 2],
    wall_s: f64,
) -> Vec<Remark> {
    let mut all = prepared.remarks.clone();
    let asked = motion.duration_s.filter(|_| motion.run == Run::Span);
    all.extend(stretched(asked, headline.cycles, prepared.system.time_of_cycles(headline.cycles as f64)));
    all.extend(motion_remarks::of_motion((scene, motion), prepared, headline));
    let resonance = prepared.system.mesh_resonance();
    let vibration = Vibration { mesh_hz, resonance, peak_to_peak_um: headline.peak_to_peak_dte_um };
    let cycles = (headline.cycles + headline.certificate.warm_up_cycles) as f64;
    let demand = StepDemand::new(scene, motion, cycles, mesh_hz);
    let pace = Pace::of(wall_s, headline.certificate.steps as f64);
    all.extend(prepared.elasticity.warning(&vibration, &demand, pace));
    all.extend(prepared.elasticity.rotation_warning(&vibration));
    all.extend(headline.root_tensions().into_iter().flat_map(root_stress_remarks));
    all
}
