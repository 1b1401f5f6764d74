//! A motion of a model with few coordinates.

use std::sync::Arc;

use answer::{Remark, RowStore};
use integrate::{State, SteadySteps};
use scene::{Model, MotionScene, Scene};
use study::{Lyapunov, Window};

use super::{
    LumpedRow, StaticPoint,
    campbell::{LumpedCampbell, campbell},
    excitation::ExcitationSource,
    exponent::exponent,
    free_turn::free_turn,
    headline::{HeadlineInputs, LumpedHeadline, headline},
    inputs::{LumpedInputs, LumpedSystem},
    integration::{MeshFrequencies, stable_step},
    mechanism::BoxedMechanism,
    remarks::{backlash_um, certificate_remarks, no_backlash},
    run_loop::{LumpedCheckpoint, LumpedResume, LumpedRun, LumpedSoFar, NoRunObserver, RunObserver, RunPlan},
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer, PhaseWork, Progress, SinkResult,
    certificate::Checks,
    error::in_scene,
    facts::{Resolution, RunInfo},
    flank_orders::{FlankWaves, orders_of_no_turn},
    gears,
    in_motion::{self, MeshRecord, StepKeys, coarse_steps, steps_of_cycle, stretched},
    inputs::motion_of,
    motion::{self, EnergyRow, MotionSeries, MotionSpectrum, RunUp, Waterfall, window},
    options, plausible,
    resolution::{resolution, with_slices},
    run_phase, unless_cancelled, worse,
};

/// Whether the model of a scene has few coordinates.
pub fn is_lumped(scene: &Scene) -> bool {
    matches!(scene.analysis.model, Model::Lumped8 | Model::Lumped12 | Model::Shaft18 | Model::Impact | Model::Mapped)
}

/// Mesh cycles over which the exponent of a motion is found that does not repeat itself.
const LYAPUNOV_INTERVALS: u32 = 200;

/// Damping ratio of a mesh whose damping is given in another way: the default of `mesh_damping_ratio`.
const USUAL_DAMPING: f64 = 0.05;

/// Receives the rows of a cheaper model as they are computed.
pub trait LumpedSink {
    /// Called for each row in order.
    ///
    /// # Errors
    /// Any error ends the analysis and is returned as [`AnalysisError::Sink`].
    fn row(&mut self, row: &LumpedRow) -> SinkResult;

    /// Called with a state from which the run can be continued, with rows and energy so far, as often as
    /// [`LumpedAnalysis::with_checkpoints`] requests.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn checkpoint(&mut self, _state: LumpedCheckpoint, _so_far: LumpedSoFar<'_>) -> SinkResult {
        Ok(())
    }
}

/// Sink that takes nothing: the result has all rows.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoLumpedSink;

impl LumpedSink for NoLumpedSink {
    fn row(&mut self, _: &LumpedRow) -> SinkResult {
        Ok(())
    }
}

/// Result of a scene with a cheaper model.
#[derive(Debug)]
pub struct LumpedResult {
    /// Facts about the run, with its certificate.
    pub facts: RunInfo,
    /// Rows, the same number in each mesh cycle.
    pub rows: Arc<RowStore<LumpedRow>>,
    /// Energy since the start, row by row and at the end.
    pub energy: Arc<RowStore<EnergyRow>>,
    /// Final state, from which another run may continue.
    pub end: State,
    /// The pair under the mean load in the limit of zero speed; `None` if it has no equilibrium.
    pub static_cycle: Option<Vec<StaticPoint>>,
    /// Spectral lines of the evaluated mesh cycles.
    pub spectrum: MotionSpectrum,
    /// Waves on the driving flanks, beside the orders of the spectrum.
    pub flank_waves: FlankWaves,
    /// Largest values over speed, for a ramp.
    pub run_up: Option<RunUp>,
    /// Frequencies over speed, for a linear model.
    pub campbell: Option<LumpedCampbell>,
    /// Headline values.
    pub headline: LumpedHeadline,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

impl LumpedResult {
    /// Certificate of the result.
    pub fn certificate(&self) -> &Checks {
        &self.facts.certificate
    }
}

/// A scene with a cheaper model, to be run in time.
#[derive(Clone, Copy)]
pub struct LumpedAnalysis<'a> {
    scene: &'a Scene,
    cache: &'a dyn GearCache,
    checkpoint_every: u64,
    resume: Option<&'a LumpedResume>,
}

impl std::fmt::Debug for LumpedAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LumpedAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

impl<'a> LumpedAnalysis<'a> {
    /// Analysis of a scene with the model `mapped`, `lumped8`, `lumped12`, `shaft18` or `impact`, in motion at one
    /// speed or over a ramp.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, cache: &NoCache, checkpoint_every: 0, resume: None }
    }

    /// Returns a checkpoint after every `every` mesh cycles, including those of the warm-up; 0: none.
    #[must_use]
    pub fn with_checkpoints(self, every: u64) -> Self {
        Self { checkpoint_every: every, ..self }
    }

    /// Continues, to the same bits, from a state of an earlier run of the same scene with checkpoints at the same
    /// interval.
    #[must_use]
    pub fn resume(self, from: &'a LumpedResume) -> Self {
        Self { resume: Some(from), ..self }
    }

    /// Uses reduced gears from a cache, if the reduced model provides the mesh cycle.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Runs it without progress reports.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(&self) -> Result<LumpedResult, AnalysisError> {
        self.solve_into(&mut NoObserver, &mut NoLumpedSink)
    }

    /// Runs it; rows are passed to `sink` as they are computed. A result whose certificate fails is returned
    /// nevertheless; [`RunInfo::verdict`] tells.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        &self,
        observer: &mut dyn Observer,
        sink: &mut dyn LumpedSink,
    ) -> Result<LumpedResult, AnalysisError> {
        let scene = with_slices(self.scene.clone());
        let motion = motion_of(&scene)?;
        if motion.sweep.is_some() {
            return Err(crate::error::unasked(&scene, "motion at one speed or over a ramp"));
        }
        let inputs = LumpedInputs::gather(&scene, &mut ExcitationSource::new(observer, self.cache))?;
        let mut system = inputs.build()?;
        let (mut facts, mut remarks) = (facts(&inputs, system.coordinates()), std::mem::take(&mut system.remarks));
        remarks.extend(gears::remarks(&inputs.pair));
        remarks.extend(no_backlash(&inputs));
        if !scene.analysis.model.has_reduced_gears() {
            remarks.extend(plausible::remarks(&scene, &inputs.pair));
        }
        if let Some((resolution, said)) = slice_resolution(&inputs) {
            facts.resolution = Some(resolution);
            remarks.extend(said);
        }
        let frequencies = inputs.frequencies(motion, system.resonance_hz);
        refuse_unstable(&scene, motion, &mut system.model, frequencies)?;
        let campbell = run_phase(observer, "modes", PhaseWork::Unknown, |_| campbell(&inputs, &system))?;
        facts.model.extend(campbell.iter().flat_map(LumpedCampbell::facts));
        let positions = scene.analysis.positions_per_cycle as usize;
        let static_cycle = run_phase(observer, "quasi-static", PhaseWork::Unknown, |_| system.static_cycle(positions));
        // Standing, the model stands where it begins: this comes before the run.
        let free = free_turn(&mut system.model).map_err(in_scene(&scene))?;
        let steps = PhaseWork::Steps(u64::from(scene.analysis.cycles));
        let run = run_phase(observer, "motion", steps, |progress| {
            let Self { checkpoint_every, resume, .. } = *self;
            let plan = RunPlan { scene: &scene, motion, frequencies, from: None, checkpoint_every, resume };
            plan.run(&mut system.model, &mut RowsOnward { progress, sink })
        });
        let run = run.map_err(in_scene(&scene))?;
        let at_rest = static_cycle.iter().flatten().map(|point| 1e3 * point.error);
        facts.certificate = certificate(&inputs, &run, at_rest)?.and(Checks::new(system.model.checks()));
        let tolerance = motion.periodic_tolerance.unwrap_or(f64::INFINITY);
        let restless = scene.impact.is_none() && run.periodicity.as_ref().is_some_and(|p| p.residual > tolerance);
        let mut found = || {
            let of = (&mut system.model, free.as_ref());
            let found = run_phase(observer, "exponent", PhaseWork::Unknown, |_| {
                exponent(of, motion, &run.end, frequencies, LYAPUNOV_INTERVALS)
            });
            found.map_err(in_scene(&scene))
        };
        let lyapunov = restless.then(&mut found).transpose()?;
        result(&inputs, &system, run, RunResults { facts, static_cycle, campbell, lyapunov, remarks })
    }
}

/// What is known of a model beside its run.
struct RunResults {
    facts: RunInfo,
    static_cycle: Option<Vec<StaticPoint>>,
    campbell: Option<LumpedCampbell>,
    lyapunov: Option<Lyapunov>,
    remarks: Vec<Remark>,
}

/// Reads headline and spectra off a run.
fn result(
    inputs: &LumpedInputs,
    system: &LumpedSystem,
    run: LumpedRun,
    known: RunResults,
) -> Result<LumpedResult, AnalysisError> {
    let RunResults { facts, static_cycle, campbell, lyapunov, mut remarks } = known;
    let scene = &inputs.scene;
    let motion = motion_of(scene)?;
    let frequencies = inputs.frequencies(motion, system.resonance_hz);
    let static_errors: Option<Vec<f64>> = static_cycle.as_ref().map(|all| all.iter().map(|p| p.error).collect());
    let static_normal_force = inputs.static_normal_force();
    let run_up = motion.ramp.map(|_| {
        let driver = (motion::speed(scene), scene.driver_teeth());
        let series = MotionSeries::over_speed(&run.rows)?;
        Ok::<_, AnalysisError>(RunUp::of(&series, run.per_cycle, driver, static_normal_force, &Waterfall::default())?)
    });
    let run_up = run_up.transpose()?;
    let beside = HeadlineInputs {
        coordinates: system.coordinates(),
        mesh_frequency_hz: frequencies.mesh_hz,
        resonance_hz: (system.resonance_hz > 0.0).then_some(system.resonance_hz),
        static_normal_force,
        static_errors: static_errors.as_deref(),
        lyapunov,
    };
    let mut headline = headline(scene, motion, &run, &beside)?;
    let judged = &run.survey.series;
    headline.ramp = run_up.as_ref().and_then(RunUp::headline);
    remarks.extend(certificate_remarks(motion, &headline));
    remarks.extend(inputs.remarks_of(motion, &headline));
    remarks.extend(stretched(motion.duration_s, run.cycles, Some(run.cycles as f64 / frequencies.mesh_hz)));
    let whole = window(run.periodicity, motion.periodic_tolerance.unwrap_or(1e-6), run.cycles);
    if motion.ramp.is_none() {
        let (samples, cycles) = (&judged.dte_um[..], run.judged as f64);
        let comes_back = whole == Window::Rectangular;
        let steps = time_steps((scene, motion), frequencies, run.steps_per_cycle);
        let resolved =
            MeshRecord { samples, cycles, steps, comes_back, keys: StepKeys::PAIR.by(motion.error_tolerance) }
                .resolved();
        headline.certificate.step_error_percent = resolved.step_error_percent;
        remarks.extend(resolved.remarks);
        remarks.extend(orders_of_no_turn(&inputs.pair, run.judged));
        if motion.error_tolerance.is_none() && system.resonance_hz > 0.0 {
            let steps = 1.0 / (frequencies.step(motion) * system.resonance_hz);
            remarks.extend(coarse_steps(steps, ("mesh resonance", system.resonance_hz), (StepKeys::PAIR, "")));
        }
    }
    let spectrum = judged.spectrum((run.judged as f64, frequencies.mesh_hz), whole)?;
    let LumpedRun { rows, energy, end, .. } = run;
    let (rows, energy) = (Arc::new(rows), Arc::new(energy));
    let flank_waves = FlankWaves::of(scene, &inputs.pair);
    Ok(LumpedResult {
        facts,
        rows,
        energy,
        end,
        static_cycle,
        spectrum,
        flank_waves,
        run_up,
        campbell,
        headline,
        remarks,
    })
}

/// Steps of a motion at constant speed, `mean` of them in a mesh cycle on average; `None` of a ramp, of a mesh without one
/// stiffness, and where they do not tell their error.
fn time_steps(
    (scene, motion): (&Scene, &MotionScene),
    frequencies: MeshFrequencies,
    mean: Option<f64>,
) -> Option<SteadySteps> {
    let MeshFrequencies { mesh_hz, resonance_hz } = frequencies;
    let is_known = motion.ramp.is_none() && resonance_hz > 0.0;
    let damping = scene.lumped12.as_ref().map(|own| own.damping_ratio).or(motion.mesh_damping_ratio);
    let equal = 1.0 / (frequencies.step(motion) * mesh_hz);
    let per_period = steps_of_cycle(motion.scheme(), motion.error_tolerance, (equal, mean)).filter(|_| is_known)?;
    Some(SteadySteps {
        per_period,
        scheme: motion.scheme(),
        resonance: resonance_hz / mesh_hz,
        damping: damping.unwrap_or(USUAL_DAMPING),
    })
}

/// Passes rows on, and counts mesh cycles.
struct RowsOnward<'a> {
    progress: &'a dyn Progress,
    sink: &'a mut dyn LumpedSink,
}

impl RunObserver for RowsOnward<'_> {
    fn row(&mut self, row: &LumpedRow, begins_cycle: bool) -> SinkResult {
        if begins_cycle {
            self.progress.tick();
            unless_cancelled(self.progress)?;
        }
        self.sink.row(row)
    }

    fn checkpoint(&mut self, state: LumpedCheckpoint, so_far: LumpedSoFar<'_>) -> SinkResult {
        self.sink.checkpoint(state, so_far)
    }
}

/// Rows of a run to the steady state alone, and the mesh cycles that it took in all: for comparing models.
///
/// # Errors
/// [`AnalysisError`], also where the certificate does not hold.
pub(crate) fn steady_rows(
    inputs: &LumpedInputs,
    system: LumpedSystem,
) -> Result<(RowStore<LumpedRow>, u64), AnalysisError> {
    let mut model = system.model;
    let (run, _) = checked_run(inputs, &mut model, system.resonance_hz, None)?;
    Ok((run.rows, run.warm_up + run.cycles))
}

/// A run whose certificate holds, with that certificate.
///
/// # Errors
/// [`AnalysisError`].
pub(super) fn checked_run(
    inputs: &LumpedInputs,
    model: &mut BoxedMechanism,
    resonance_hz: f64,
    from: Option<&State>,
) -> Result<(LumpedRun, Checks), AnalysisError> {
    let scene = &inputs.scene;
    let motion = motion_of(scene)?;
    let frequencies = inputs.frequencies(motion, resonance_hz);
    refuse_unstable(scene, motion, model, frequencies)?;
    let plan = RunPlan { scene, motion, frequencies, from, checkpoint_every: 0, resume: None };
    let run = plan.run(model, &mut NoRunObserver).map_err(in_scene(scene))?;
    let checks = certificate(inputs, &run, std::iter::empty())?.and(Checks::new(model.checks()));
    crate::certificate::verdict(&checks, scene)?;
    Ok((run, checks))
}

/// Refuses steps of given length that are too long for an explicit method.
pub(super) fn refuse_unstable(
    scene: &Scene,
    motion: &MotionScene,
    model: &mut BoxedMechanism,
    frequencies: MeshFrequencies,
) -> Result<(), AnalysisError> {
    let MeshFrequencies { mesh_hz, resonance_hz } = frequencies;
    let limit = stable_step(model, motion, mesh_hz).map_err(in_scene(scene))?;
    let Some(limit) = limit else { return Ok(()) };
    let steps = motion::Steps::of_pair(frequencies.step(motion), mesh_hz, resonance_hz);
    motion::refuse_unstable(scene, limit, steps)
}

/// What must hold of a run: energy closes, no flank of a slice pulls, reduced gears bend as far as linear elasticity holds,
/// and rigid teeth stay in mesh, also `at_rest` (transmission errors, um).
///
/// # Errors
/// [`AnalysisError`] for a row that holds what is no number.
fn certificate(
    inputs: &LumpedInputs,
    run: &LumpedRun,
    at_rest: impl Iterator<Item = f64>,
) -> Result<Checks, AnalysisError> {
    let survey = &run.survey;
    survey.finite()?;
    let LumpedInputs { scene, pair, .. } = inputs;
    let mut all = vec![in_motion::energy_check(run.ledger.open_over_vibration(), StepKeys::of_pair(&inputs.scene))];
    all.extend(survey.least_slice_force.map(|least| in_motion::pulling_check(least, survey.largest_force)));
    let errors = survey.errors_um.ends.into_iter();
    if scene.analysis.model.has_reduced_gears() {
        all.push(in_motion::deflection_check_in_motion(scene, pair, errors.map(|um| 1e-3 * um)));
    } else {
        // Beyond the backlash the other flanks are in each other.
        let backlash = backlash_um(inputs);
        let beyond = |error_um: f64| 1e-3 * error_um.max(-error_um - backlash);
        all.push(in_motion::excursion_check(
            errors.chain(at_rest).map(beyond).fold(0.0, worse),
            scene.pair.normal_module_mm,
        ));
    }
    Ok(Checks::new(all))
}

/// Geometry, and coordinates as degrees of freedom.
pub(super) fn facts(inputs: &LumpedInputs, coordinates: usize) -> RunInfo {
    let dof_after = [coordinates.div_ceil(2), coordinates / 2];
    RunInfo { dof_after, ..RunInfo::of_pair(&inputs.scene, &inputs.pair) }
}

/// How rigid gears are cut into slices, with what a user should hear of it; other models are not.
fn slice_resolution(inputs: &LumpedInputs) -> Option<(Resolution, Vec<Remark>)> {
    let LumpedInputs { scene, pair, .. } = inputs;
    matches!(scene.analysis.model, Model::Impact | Model::Mapped)
        .then(|| resolution(scene, pair, &options(scene, pair)))
}
