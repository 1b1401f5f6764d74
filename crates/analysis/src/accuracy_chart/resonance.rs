//! Models in motion over a range of speeds: the error of each dynamic transmission error compared with elastic gears
//! with normal modes, and the cost of the curve.

use std::time::Instant;

use scene::{Model, ModesScene, MotionScene, Run, Scene, SweepScene, SweepWay};

use super::{NoGauge, lumped_scene, phase_times::PhaseTimes, plan};
use crate::{
    AnalysisError, Observer, PhaseWork,
    lumped::{KeySweep, LumpedQuantity, SweepOptions, SweepPoint},
    motion::{NoMotionSink, SweepAnalysis, SweepRow},
    run_phase,
};

/// Edit of a scene into one of a model.
type Edit = fn(&mut Scene);

/// Models, cheapest first. One more is one more line.
const MODELS: [(&str, Edit); 6] = [
    ("lumped8", lumped_scene::lumped8),
    ("lumped12", lumped_scene::lumped12),
    (plan::FED, lumped_scene::lumped12_fed),
    ("mapped", mapped),
    ("reduced", reduced),
    ("reduced+modes", with_modes),
];
/// Halves of the scene's steps: of the points, and of the reference.
const HALVES: (&[u32], u32) = (&[1, 2, 4], 8);
/// Halves of the scene's steps of a quick look: of the points, and of the reference.
const QUICK_HALVES: (&[u32], u32) = (&[2], 4);
/// Modes of each gear where the scene says none.
const MODES: u32 = 12;
/// Their damping ratio.
const MODAL_DAMPING: f64 = 0.02;
/// Phase of the motions; all before is preparation.
const SWEEP: &str = "sweep";

/// A steady motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedPoint {
    /// Direction of the sweep.
    pub way: SweepWay,
    /// Speed of the driver, 1/min.
    pub speed_rpm: f64,
    /// Largest minus smallest dynamic transmission error, um; `None` if there is no motion.
    pub peak_to_peak_um: Option<f64>,
}

/// Result of a model over the speeds, and its cost.
#[derive(Debug, Clone, PartialEq)]
pub struct ResonanceCurve {
    /// Time before the first motion, s.
    pub offline_s: f64,
    /// Time of all motions, s.
    pub sweep_s: f64,
    /// Direction by direction, speed by speed.
    pub speeds: Vec<SpeedPoint>,
    /// Root mean square of the differences of its peaks to peaks from the reference, divided by that of the reference;
    /// `None` if no speed has both.
    pub error: Option<f64>,
}

impl ResonanceCurve {
    /// The motion with the largest peak to peak, um.
    pub fn largest(&self) -> Option<(SpeedPoint, f64)> {
        let known = self.speeds.iter().filter_map(|p| Some((*p, p.peak_to_peak_um?)));
        known.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Number of missing motions.
    pub fn missing(&self) -> usize {
        self.speeds.iter().filter(|p| p.peak_to_peak_um.is_none()).count()
    }

    /// Total time, s.
    pub fn whole_s(&self) -> f64 {
        self.offline_s + self.sweep_s
    }

    fn error_against(&self, reference: &Self) -> Option<f64> {
        let both = || {
            let pairs = self.speeds.iter().zip(&reference.speeds);
            pairs.filter_map(|(own, known)| Some((own.peak_to_peak_um?, known.peak_to_peak_um?)))
        };
        let squares = |of: fn((f64, f64)) -> f64| both().map(of).map(|x| x * x).sum::<f64>();
        let error = (squares(|(own, known)| own - known) / squares(|(_, known)| known)).sqrt();
        error.is_finite().then_some(error)
    }
}

/// A model with one step length.
#[derive(Debug, Clone, PartialEq)]
pub struct ResonancePoint {
    /// Name of the model.
    pub model: &'static str,
    /// Steps per mesh cycle; more if the scene's `steps_per_resonance`, in proportion, requires it.
    pub steps: u32,
    /// Result, or the reason why there is none.
    pub outcome: Result<ResonanceCurve, String>,
}

/// The models of a scene over its speeds.
#[derive(Debug, Clone, PartialEq)]
pub struct ResonancePrecision {
    /// Model by model, longest steps first.
    pub points: Vec<ResonancePoint>,
    /// Reference: normal modes and shorter steps.
    pub reference: ResonanceCurve,
    /// Steps per mesh cycle of the reference.
    pub reference_steps: u32,
    /// The speeds of the sweep.
    pub sweep: SweepScene,
}

/// Runs all models over the speeds of a scene's `[motion.sweep]`, with half, once and twice the scene's number of
/// steps. With `quick` only the scene's number is used.
///
/// The driver rotates at constant speed; axes are held, or so stiff that it makes no difference. A model that fails is
/// a point with the reason.
///
/// # Errors
/// [`AnalysisError`] for a scene without this table, or if the reference fails.
pub fn resonance_precision(
    scene: &Scene,
    observer: &mut dyn Observer,
    quick: bool,
) -> Result<ResonancePrecision, AnalysisError> {
    let motion = scene.motion.as_ref().ok_or_else(|| crate::error::unasked(scene, SWEEP))?;
    let sweep = motion.sweep.clone().ok_or_else(|| crate::error::unasked(scene, SWEEP))?;
    let (halves, finest) = if quick { QUICK_HALVES } else { HALVES };
    let total = (MODELS.len() * halves.len() + 1) as u64;
    run_phase(observer, "chart", PhaseWork::Steps(total), |progress| {
        let run = |model: &str, edit: Edit, halves: u32| {
            let own = edited(scene, motion, edit, halves);
            progress.say(format!("{model}, {} steps", steps(motion, halves)));
            let found = curve(&own, &sweep);
            progress.tick();
            found
        };
        let reference = run("reference", with_modes, finest)?;
        let mut points = Vec::new();
        for (model, edit) in MODELS {
            for &halves in halves {
                let outcome = run(model, edit, halves).map_err(|e| e.to_string().replace('\n', " ")).map(|found| {
                    let error = found.error_against(&reference);
                    ResonanceCurve { error, ..found }
                });
                points.push(ResonancePoint { model, steps: steps(motion, halves), outcome });
            }
        }
        Ok(ResonancePrecision { points, reference, reference_steps: steps(motion, finest), sweep })
    })
}

/// Steps of a mesh cycle, so many halves of the scene's.
fn steps(motion: &MotionScene, halves: u32) -> u32 {
    (motion.steps_per_mesh_cycle * halves / 2).max(1)
}

/// The scene as one of a model.
fn edited(scene: &Scene, motion: &MotionScene, edit: Edit, halves: u32) -> Scene {
    let mut own = scene.clone();
    for gear in [&mut own.pinion, &mut own.wheel] {
        // Axes that the scene leaves free are held, as those of the cheaper models are.
        if let Some(body) = &mut gear.body {
            body.free.clear();
        }
        gear.bearing = Default::default();
    }
    edit(&mut own);
    let ratio = motion.mesh_damping_ratio;
    own.motion = Some(MotionScene {
        run: Run::Sweep,
        steps_per_mesh_cycle: steps(motion, halves),
        steps_per_resonance: motion.steps_per_resonance * halves / 2,
        checkpoint_every_cycles: None,
        ..motion.clone()
    });
    if let (Some(twelve), Some(ratio)) = (&mut own.lumped12, ratio) {
        twelve.damping_ratio = ratio;
    }
    own.output.root_stress = false;
    own.output.contact_lines = false;
    own.output.vtu = false;
    own
}

fn reduced(scene: &mut Scene) {
    plan::slice(scene);
    lumped_scene::in_motion(scene);
}

fn mapped(scene: &mut Scene) {
    reduced(scene);
    scene.analysis.model = Model::Mapped;
}

fn with_modes(scene: &mut Scene) {
    let own = scene.modes;
    reduced(scene);
    scene.analysis.model = Model::ReducedModes;
    let usual =
        ModesScene { count: Some(MODES), fixed_modes: None, damping_ratio: MODAL_DAMPING, ..ModesScene::default() };
    scene.modes = own.or(Some(usual));
}

/// Motions of a scene over its speeds, not yet compared.
fn curve(scene: &Scene, sweep: &SweepScene) -> Result<ResonanceCurve, AnalysisError> {
    let mut phases = PhaseTimes::new(&NoGauge);
    let clock = Instant::now();
    let known = |value: f64| Some(value).filter(|x| x.is_finite());
    let speeds = if scene.analysis.model.is_reduced() {
        let found = SweepAnalysis::new(scene).solve_into(&mut phases, &mut NoMotionSink)?;
        found.verdict(scene)?;
        let of = |row: &SweepRow| SpeedPoint {
            way: row.way,
            speed_rpm: row.speed_rpm,
            peak_to_peak_um: known(row.peak_to_peak_dte_um),
        };
        found.rows.iter().map(of).collect()
    } else {
        let of_row = LumpedQuantity::transmission_error();
        let (scenes, options) = SweepOptions::over_speed(scene, sweep, of_row);
        let found = KeySweep::new(&scenes, &options).solve_with(&mut phases)?;
        crate::certificate::verdict(&found.facts.certificate, scene)?;
        let of = |point: &SweepPoint| SpeedPoint {
            way: point.way,
            speed_rpm: point.value,
            peak_to_peak_um: known(point.peak_to_peak()),
        };
        found.points.iter().map(of).collect()
    };
    let sweep_s = phases.wall_s(|name| name == SWEEP);
    Ok(ResonanceCurve { offline_s: clock.elapsed().as_secs_f64() - sweep_s, sweep_s, speeds, error: None })
}
