//! The steady states of a scene over speed.

use ale::solve_widening;
use answer::Remark;
use gearbox::motion::SweepOutcome;
use ltca::StaticError;
use mesh::Mesh;
use scene::{MotionScene, Scene, SweepScene};

use super::{SweepHeadline, SweepRow, headline, rows, run};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer,
    error::unasked,
    facts::RunInfo,
    failure::Failure,
    inputs::resolved_scene,
    motion::{
        CampbellDiagram, MotionSink, NoMotionSink,
        analysis::{campbell_diagram, ready},
        motion_remarks,
        setup::{MotionInputs, PreparedMotion, QuasiStatic, Vibration, mesh_range_hz},
        step_estimate::{Pace, StepDemand},
    },
};

/// A scene with `run = "sweep"` to be solved.
#[derive(Clone, Copy)]
pub struct SweepAnalysis<'a> {
    scene: &'a Scene,
    meshes: Option<[&'a Mesh; 2]>,
    cache: &'a dyn GearCache,
}

impl std::fmt::Debug for SweepAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SweepAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

/// The steady states of a pair over speed.
#[derive(Debug, Clone)]
pub struct SweepResult {
    /// A row per direction and speed, including those without a motion.
    pub rows: Vec<SweepRow>,
    /// Headline values.
    pub headline: SweepHeadline,
    /// Campbell diagram: mesh orders and the pair's frequencies.
    pub campbell: CampbellDiagram,
    /// The static mesh cycle with which the motions start.
    pub quasi_static: QuasiStatic,
    /// Facts about the model, with its certificate.
    pub facts: RunInfo,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

impl SweepResult {
    /// Whether the result is valid: the certificate passes, and at least one speed has a valid motion.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]; [`AnalysisError::Refused`] if no speed has a result.
    pub fn verdict(&self, scene: &Scene) -> Result<(), AnalysisError> {
        crate::certificate::verdict(&self.facts.certificate, scene)?;
        rows::verdict(scene, &self.rows)
    }
}

impl<'a> SweepAnalysis<'a> {
    /// Analysis of a scene, with its meshes read or generated as it says.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, meshes: None, cache: &NoCache }
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

    /// Solves it without progress reports.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(&self) -> Result<SweepResult, AnalysisError> {
        self.solve_into(&mut NoObserver, &mut NoMotionSink)
    }

    /// Solves it. `sink` receives the quasi-static mesh cycle; there are no rows in time.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        &self,
        observer: &mut dyn Observer,
        sink: &mut dyn MotionSink,
    ) -> Result<SweepResult, AnalysisError> {
        let scene = &resolved_scene(self.scene, self.meshes.is_some());
        let other = || unasked(scene, "sweep of reduced gears over speed");
        let motion = scene.motion.as_ref().filter(|_| scene.analysis.model.is_reduced()).ok_or_else(other)?;
        let sweep = motion.sweep.as_ref().ok_or_else(other)?;
        let inputs = MotionInputs::new((scene, motion), self.meshes, self.cache, observer)?;
        let meshes: Vec<_> = inputs.meshes.iter().map(|m| m.facts.clone()).collect();
        sink.meshes(&meshes).map_err(AnalysisError::Sink)?;
        let mut widened = Vec::new();
        let solved = solve_widening(
            None,
            |window| {
                let prepared = ready(&inputs, observer, sink, window)?;
                let wider = |e: &StaticError| inputs.wider(window, e).is_some();
                let clock = std::time::Instant::now();
                let outcomes = run::run(scene, (motion, sweep), &prepared, &wider, observer)?;
                Ok((prepared, outcomes, clock.elapsed().as_secs_f64()))
            },
            |window, failure| {
                let Failure::Static(e) = failure else { return None };
                let teeth = inputs.wider(window, e)?;
                widened.push(motion_remarks::widened(e, teeth));
                Some(teeth)
            },
        );
        let (mut prepared, outcomes, wall_s) = solved.map_err(|e: Failure| e.into_error(scene))?;
        prepared.remarks.extend(widened);
        result(scene, (motion, sweep), prepared, &outcomes, wall_s)
    }
}

fn result(
    scene: &Scene,
    (motion, sweep): (&MotionScene, &SweepScene),
    prepared: PreparedMotion,
    outcomes: &[SweepOutcome],
    wall_s: f64,
) -> Result<SweepResult, AnalysisError> {
    let rows = rows::rows((scene, prepared.system.pair()), motion, &prepared.quasi_static, outcomes);
    let teeth = scene.driver_teeth();
    let mesh_hz = mesh_range_hz(scene, motion, None);
    let campbell = campbell_diagram(&prepared, teeth, mesh_hz[1])?;
    let resonance = prepared.system.mesh_resonance();
    let vibration = Vibration { mesh_hz, resonance, peak_to_peak_um: rows::largest(&rows) };
    let of = (&rows[..], &vibration);
    let headline = headline::headline((motion, sweep), &prepared, of, campbell.critical_speeds(), teeth);
    let waited: u64 = rows.iter().map(|r| r.warm_up_cycles + u64::from(scene.analysis.cycles)).sum();
    let cycles = waited as f64 / rows.len().max(1) as f64;
    // Steps are as long as rows ask for, or the resonance, at the mean speed.
    let own_steps = f64::from(motion.steps_per_mesh_cycle)
        .max(f64::from(motion.steps_per_resonance) * headline.mesh_resonance_hz / (0.5 * (mesh_hz[0] + mesh_hz[1])));
    let demand = StepDemand::new(scene, motion, cycles, mesh_hz);
    let pace = Pace::of(wall_s, waited as f64 * own_steps);
    let PreparedMotion { quasi_static, facts, elasticity, mut remarks, .. } = prepared;
    remarks.extend(elasticity.warning(&vibration, &demand, pace));
    remarks.extend(motion_remarks::of_sweep(&headline, rows.len()));
    Ok(SweepResult { rows, headline, campbell, quasi_static, facts, remarks })
}
