//! Accuracy against step size: the same motion by every method, compared with a fine reference.

use std::time::Instant;

use gearbox::GearboxError;
use integrate::{Integrator, Scheme, State, StepControl, StepLimit};

use scene::Scene;

use super::{
    NoMotionSink,
    course::failure,
    setup::{MotionInputs, PreparedMotion, prepare},
};
use crate::{AnalysisError, NoCache, Observer, PhaseWork, error::unasked, inputs::resolved_scene, run_phase};

/// Methods that a scene can ask for, with their usual parameters.
const METHODS: [(&str, Scheme); 4] = [
    ("energy", Scheme::Energy),
    ("generalised-alpha", Scheme::GeneralisedAlpha { rho: 0.9 }),
    ("newmark", Scheme::Newmark),
    ("dormand-prince", Scheme::DormandPrince),
];
/// Steps a mesh cycle: T_m/8 to T_m/512.
const STEPS: [u32; 7] = [8, 16, 32, 64, 128, 256, 512];
/// Places of a mesh cycle at which courses are compared.
const PLACES: u32 = 8;
/// Mesh cycles from the quasi-static start on.
const CYCLES: u32 = 1;

/// One method with one step length.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionPrecisionPoint {
    /// Name of the method, as in scenes.
    pub method: &'static str,
    /// Number of steps in a mesh cycle.
    pub steps: u32,
    /// Largest difference of the DTE from the reference; `None` if the method fails.
    pub error_um: Option<f64>,
    /// Wall-clock time of a mesh cycle, s.
    pub cycle_s: f64,
    /// Reason of the failure.
    pub note: String,
}

/// Results of all methods.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionPrecision {
    /// Method by method, step by step.
    pub points: Vec<MotionPrecisionPoint>,
    /// Name of the reference for the errors.
    pub reference: String,
    /// Mesh frequency divided by the mesh resonance.
    pub mesh_over_resonance: f64,
    /// Number of mesh cycles from the quasi-static start.
    pub cycles: u32,
}

impl MotionPrecision {
    /// Names of the methods in order.
    pub fn methods(&self) -> Vec<&'static str> {
        let mut names: Vec<_> = self.points.iter().map(|p| p.method).collect();
        names.dedup();
        names
    }

    /// Numbers of steps per mesh cycle in order.
    pub fn counts(&self) -> Vec<u32> {
        let mut counts: Vec<_> = self.points.iter().map(|p| p.steps).collect();
        counts.sort_unstable();
        counts.dedup();
        counts
    }
}

/// Runs every method with every step length; `quick`: only steps down to T_m/64.
///
/// # Errors
/// [`AnalysisError`] if the input is invalid, or if the reference fails.
pub fn motion_precision(
    scene: &Scene,
    observer: &mut dyn Observer,
    quick: bool,
) -> Result<MotionPrecision, AnalysisError> {
    let scene = &resolved_scene(scene, false);
    let motion = scene.motion.as_ref().filter(|_| scene.analysis.model.is_reduced());
    let motion = motion.ok_or_else(|| unasked(scene, "motion of reduced gears"))?;
    let inputs = MotionInputs::new((scene, motion), None, &NoCache, observer)?;
    let prepared = prepare(&inputs, observer, &mut NoMotionSink, None).map_err(|e| e.into_error(scene))?;
    let counts = &STEPS[..if quick { 4 } else { STEPS.len() }];
    let finest = 4 * counts[counts.len() - 1];
    let fail = |e: GearboxError| failure(scene, e.into()).into_error(scene);
    let total = (counts.len() * METHODS.len() + 1) as u64;
    run_phase(observer, "precision", PhaseWork::Steps(total), |progress| {
        let bench = Bench::new(scene, &prepared).map_err(fail)?;
        let (reference, _) = bench.course(Scheme::RungeKutta4, finest).map_err(fail)?;
        progress.tick();
        let mut points = Vec::new();
        for (method, scheme) in METHODS {
            for &steps in counts {
                points.push(bench.point((method, scheme), steps, &reference));
                progress.tick();
            }
        }
        Ok(MotionPrecision {
            points,
            reference: format!("Runge-Kutta 4 with {finest} steps"),
            mesh_over_resonance: 1.0 / (bench.period * prepared.system.mesh_resonance_hz()),
            cycles: CYCLES,
        })
    })
}

/// The motion that all methods are given.
struct Bench<'a> {
    prepared: &'a PreparedMotion,
    start: State,
    /// Of a mesh cycle, s.
    period: f64,
    /// Longest stable steps of the explicit methods.
    limits: Vec<(Scheme, StepLimit)>,
}

impl<'a> Bench<'a> {
    fn new(scene: &Scene, prepared: &'a PreparedMotion) -> Result<Self, GearboxError> {
        let start = prepared.system.machine().and_then(|mut machine| machine.start(0.0))?;
        let speed = scene.pinion_speed() / std::f64::consts::TAU * f64::from(scene.pinion.teeth);
        let mut limits = Vec::new();
        for (_, scheme) in METHODS {
            limits.extend(prepared.system.machine()?.stable_step(scheme)?.map(|limit| (scheme, limit)));
        }
        Ok(Self { prepared, start, period: 1.0 / speed, limits })
    }

    /// DTE (mm) at the places of all mesh cycles, and the wall time of one, s.
    fn course(&self, scheme: Scheme, steps: u32) -> Result<(Vec<f64>, f64), GearboxError> {
        let mut system = self.prepared.system.machine()?;
        let (slopes, mut state) = (system.error_slopes(0), self.start.clone());
        let step = StepControl::Fixed(self.period / f64::from(steps));
        let mut integrator = Integrator::new(scheme, step, self.prepared.times.scale.clone());
        let (mut all, mut done) = (Vec::new(), 0u32);
        let clock = Instant::now();
        integrator.advance(&mut system, &mut state, f64::from(CYCLES) * self.period, |_, seen| {
            done += 1;
            if done.is_multiple_of(steps / PLACES) {
                all.push(slopes.dot(&seen.state.q));
            }
        })?;
        Ok((all, clock.elapsed().as_secs_f64() / f64::from(CYCLES)))
    }

    fn point(&self, (method, scheme): (&'static str, Scheme), steps: u32, reference: &[f64]) -> MotionPrecisionPoint {
        let step = self.period / f64::from(steps);
        let unstable = self.limits.iter().find(|(of, limit)| *of == scheme && step > limit.step);
        if let Some((_, limit)) = unstable {
            let note = format!("a step of {step:.3e} s is beyond the stability limit, {:.3e} s", limit.step);
            return MotionPrecisionPoint { method, steps, error_um: None, cycle_s: f64::NAN, note };
        }
        let (error_um, cycle_s, note) = match self.course(scheme, steps) {
            Ok((found, time)) => {
                let off = found.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                (Some(1e3 * off).filter(|e| e.is_finite()), time, String::new())
            }
            Err(e) => (None, f64::NAN, e.to_string()),
        };
        MotionPrecisionPoint { method, steps, error_um, cycle_s, note }
    }
}
