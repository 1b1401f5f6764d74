//! Preparations before the first step: gears, the quasi-static cycle with which the motion starts, the mechanism.

use answer::Remark;
use std::{ops::ControlFlow, sync::Arc};

use gearbox::{
    GearboxError,
    motion::{CycleSteps, MotionTimes, PairModel},
};
use geometry::GearPair;
use ltca::{StaticError, StaticHistory, StaticModel, StaticOptions};
use mesh::Mesh;
use reduction::RecordKey;
use scene::{Flanks, MotionScene, Scene};

use super::{Elasticity, QuasiStatic, motion_options, scheme};
use crate::{
    AnalysisError, GearCache, Observer, PhaseWork, body_remarks,
    elastic_gears::{ElasticGears, RecordKeys, elastic_gears},
    error::in_scene,
    estimated_time::announced_seconds,
    facts::RunInfo,
    failure::Failure,
    gear_dofs::{dof_after, free_dofs, reduced},
    gears,
    inputs::meshes_of,
    iso_root,
    loaded_pair::LoadedPair,
    meshes::SceneMesh,
    motion::{MotionSink, step_estimate::fastest_hz},
    options::options,
    plausible::{self, refuse},
    resolution::resolution,
    run_phase, static_certificate, unless_cancelled,
    window::wider_window,
};

/// Gears, geometry and window of a run.
pub(crate) struct MotionInputs<'a> {
    pub scene: &'a Scene,
    pub motion: &'a MotionScene,
    pub pair: GearPair,
    pub meshes: [SceneMesh; 2],
    pub cache: &'a dyn GearCache,
}

impl<'a> MotionInputs<'a> {
    /// Geometry and meshes of the scene; `motion` is its [motion] table.
    pub fn new(
        (scene, motion): (&'a Scene, &'a MotionScene),
        in_memory: Option<[&Mesh; 2]>,
        cache: &'a dyn GearCache,
        observer: &mut dyn Observer,
    ) -> Result<Self, AnalysisError> {
        let pair = run_phase(observer, "geometry", PhaseWork::Unknown, |_| scene.gear_pair())?;
        refuse(scene, &pair)?;
        plausible::remarks(scene, &pair).into_iter().for_each(|said| observer.note(said.to_string()));
        let meshes = run_phase(observer, "mesh", PhaseWork::Unknown, |_| meshes_of(scene, &pair, in_memory, cache))?;
        Ok(Self { scene, motion, pair, meshes, cache })
    }

    /// The next wider window to try, if a pair next to it should carry load.
    pub fn wider(&self, window: Option<usize>, error: &StaticError) -> Option<usize> {
        let options = contact_options(self.scene, &self.pair, window);
        wider_window(self.scene, &self.pair, &self.meshes, &options, error)
    }
}

/// A pair that is ready to move.
pub(crate) struct PreparedMotion {
    pub system: PairModel,
    pub times: MotionTimes,
    pub quasi_static: QuasiStatic,
    pub elasticity: Elasticity,
    pub facts: RunInfo,
    pub remarks: Vec<Remark>,
    /// What the cache knows the gears by; none where nothing is cached.
    pub keys: Vec<RecordKey>,
}

/// Reduced gears of the driving flanks, and of the coast flanks where the scene has them.
struct Flanked {
    driving: ElasticGears,
    coast: Option<ElasticGears>,
}

/// Reduces the gears, solves the quasi-static cycle, and makes the mechanism.
///
/// # Errors
/// [`Failure::Static`] where another window may do.
pub(crate) fn prepare(
    inputs: &MotionInputs<'_>,
    observer: &mut dyn Observer,
    sink: &mut dyn MotionSink,
    window: Option<usize>,
) -> Result<PreparedMotion, Failure> {
    let MotionInputs { scene, motion, pair, meshes, cache } = inputs;
    sink.begin();
    let contact = contact_options(scene, pair, window);
    let Flanked { driving, coast } = reduce(inputs, &contact, observer)?;
    let ElasticGears { gears, keys, mut remarks } = driving;
    let set_up = || StaticModel::new(pair.clone(), gears, contact.clone());
    let mut model = run_phase(observer, "contact", PhaseWork::Unknown, |_| set_up())?;
    let positions = scene.analysis.positions_per_cycle;
    let steps = PhaseWork::Steps(u64::from(positions));
    if contact.root_stress {
        run_phase(observer, "root stress", PhaseWork::Unknown, |_| model.prepare_root_stress())?;
    }
    let history = run_phase(observer, "quasi-static", steps, |progress| {
        let history = model.run_while(positions as usize, 1, |index, position, model| {
            progress.tick();
            sink.position(index, position, model);
            if progress.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        unless_cancelled(progress)?;
        Ok::<_, Failure>(history?)
    })?;
    let quasi_static = QuasiStatic::of(&history);
    let (resolution, said) = resolution(scene, pair, &contact);
    remarks.extend(said);
    remarks.extend(gears::remarks(pair));
    remarks.extend(plausible::remarks(scene, pair));
    remarks.extend(meshes.iter().flat_map(|m| m.remarks.clone()));
    remarks.extend(body_remarks(&model));
    remarks.extend(sink.quasi_static(&model, observer));
    let mut facts = facts_of(&model, inputs, &history);
    facts.resolution = Some(resolution);
    if scene.output.root_stress {
        remarks.extend(iso_root::remark(&LoadedPair::of(scene, pair)));
    }
    let gears = model.into_gears();
    let (coast, coast_keys) = match coast {
        Some(ElasticGears { gears, keys, remarks: said }) => {
            remarks.extend(said);
            (Some(Arc::new(gears)), Some(keys))
        }
        None => (None, None),
    };
    let elasticity = Elasticity::new(scene, &gears, &quasi_static, observer)?;
    let options = motion_options(scene, pair, meshes, contact)?;
    let means = [quasi_static.stiffness, quasi_static.line_length];
    let system = run_phase(observer, "mechanism", PhaseWork::Unknown, |_| {
        let system = PairModel::new(pair.clone(), Arc::clone(&gears), coast.clone(), options, means)?;
        match elasticity.kept() {
            Some(modes) => system.with_modes(modes),
            None => Ok(system),
        }
    });
    let system = system.map_err(|e| match e {
        GearboxError::Contact(source) => Failure::Static(source),
        other => in_scene(scene)(other).into(),
    })?;
    if cache.is_on() {
        run_phase(observer, "store", PhaseWork::Unknown, |_| {
            remarks.extend(keys.save(*cache, &gears));
            if let (Some(keys), Some(gears)) = (&coast_keys, &coast) {
                remarks.extend(keys.save(*cache, gears));
            }
        });
    }
    let times = times(motion, &system, &quasi_static);
    let keys = [&keys].into_iter().chain(&coast_keys).flat_map(RecordKeys::keys).flatten().copied().collect();
    Ok(PreparedMotion { system, times, quasi_static, elasticity, facts, remarks, keys })
}

fn reduce(
    inputs: &MotionInputs<'_>,
    contact: &StaticOptions,
    observer: &mut dyn Observer,
) -> Result<Flanked, AnalysisError> {
    let MotionInputs { scene, pair, meshes, cache, .. } = inputs;
    let both = scene.contact.flanks == Flanks::Both;
    let sides = if both { 2.0 } else { 1.0 };
    let work = PhaseWork::Seconds(announced_seconds(observer, (scene.analysis.is_general(), meshes), sides));
    run_phase(observer, "reduce", work, |progress| {
        let driving = elastic_gears(scene, pair, contact, meshes, (*cache, progress, &|| true), false)?;
        let backwards =
            || elastic_gears(scene, pair, &contact.driven_backwards(), meshes, (*cache, progress, &|| true), false);
        Ok(Flanked { driving, coast: both.then(backwards).transpose()? })
    })
}

/// What the summary says of the model that the motion starts from.
fn facts_of(model: &StaticModel, inputs: &MotionInputs<'_>, history: &StaticHistory) -> RunInfo {
    let dof_before = [0, 1].map(|i| free_dofs(&model.gears()[i]));
    RunInfo {
        meshes: inputs.meshes.iter().map(|m| m.facts.clone()).collect(),
        dof_before,
        dof_after: dof_after(model, dof_before),
        window_teeth: Some(model.window().count() as u32),
        // The motion begins in it and is measured by it.
        certificate: static_certificate(inputs.scene, &history.positions),
        reduction: model.gears().iter().filter_map(|g| Some(reduced(g)?.way().name())).collect(),
        ..RunInfo::of_pair(inputs.scene, &inputs.pair)
    }
}

/// How the scene wants the motion to be integrated.
fn times(motion: &MotionScene, system: &PairModel, quasi_static: &QuasiStatic) -> MotionTimes {
    MotionTimes {
        scheme: scheme(motion),
        steps: CycleSteps::Showing {
            rows: u64::from(motion.steps_per_mesh_cycle),
            per_period: steps_per_resonance(motion, system),
            hz: system.mesh_resonance_hz(),
        },
        tolerance: motion.error_tolerance,
        stop_at_events: motion.stop_at_events,
        scale: system.scale(motion_length(system, quasi_static)),
    }
}

/// What counts as a large motion of the flanks, mm.
pub(crate) fn motion_length(system: &PairModel, quasi_static: &QuasiStatic) -> f64 {
    system.motion_size(quasi_static.mean_error()).max(1e-6)
}

/// Steps in a period of the mesh resonance that give the fastest motion as many as the scene asks for.
fn steps_per_resonance(motion: &MotionScene, system: &PairModel) -> u64 {
    let ratio = fastest_hz(system) / system.mesh_resonance_hz();
    (f64::from(motion.steps_per_resonance) * ratio).ceil() as u64
}

/// Contact of the driving flanks: the coast flanks are a contact of their own.
fn contact_options(scene: &Scene, pair: &GearPair, window: Option<usize>) -> StaticOptions {
    let asked = options(scene, pair);
    StaticOptions { window: window.or(asked.window), ..asked }.with_contact(|c| c.both_flanks = false)
}
