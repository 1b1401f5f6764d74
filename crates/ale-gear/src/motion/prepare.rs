//! Everything before the first step: gears, the quasi-static cycle that the motion starts from, the mechanism.

use analysis::GearCache;
use std::sync::Arc;

use dynamics::{MotionSettings, PairMechanism};
use geometry::GearPair;
use ltca::{StaticError, StaticHistory, StaticModel, StaticOptions};

use super::{elasticity::Elasticity, motion_options, scheme};
use report::view::{View, ViewRecorder};

use crate::{
    cache::Cache,
    elastic_gears::{ElasticGears, elastic_gears},
    error::CommandError,
    facts::Facts,
    gears, iso_root, meshes,
    meshes::SceneMesh,
    phases::Phases,
    resolution::resolution,
    run::{self, Failure},
    scene::{Flanks, MotionScene, Scene},
};

/// Gears, geometry and window of a run.
pub(super) struct Inputs<'a> {
    pub scene: &'a Scene,
    pub words: &'a MotionScene,
    pub pair: GearPair,
    pub meshes: [SceneMesh; 2],
    pub cache: &'a Cache,
}

impl<'a> Inputs<'a> {
    /// Geometry and meshes.
    pub fn new(
        scene: &'a Scene,
        words: &'a MotionScene,
        phases: &mut Phases,
        cache: &'a Cache,
    ) -> Result<Self, CommandError> {
        let pair = phases.run("geometry", || scene.gear_pair())?;
        let meshes = phases.run("mesh", || meshes::pair_meshes(scene, &pair))?;
        Ok(Self { scene, words, pair, meshes, cache })
    }
}

/// The quasi-static mesh cycle.
#[derive(Debug, Clone)]
pub(crate) struct QuasiStatic {
    /// Transmission error, mm, position by position.
    pub transmission_error: Vec<f64>,
    /// Mean tangent stiffness, N/mm on the base circle.
    pub stiffness: f64,
    /// Mean length of the contact lines, mm.
    pub line_length: f64,
    /// Mean sum of the normal forces, N.
    pub normal_force: f64,
}

impl QuasiStatic {
    fn of(history: &StaticHistory) -> Self {
        let all = &history.positions;
        let mean = |f: &dyn Fn(&ltca::StaticPosition) -> f64| all.iter().map(f).sum::<f64>() / all.len() as f64;
        Self {
            transmission_error: all.iter().map(|p| p.transmission_error).collect(),
            stiffness: mean(&|p| p.tangent_stiffness),
            line_length: mean(&|p| p.contact_line_length),
            normal_force: mean(&|p| p.pairs.iter().map(|pair| pair.normal_force).sum()),
        }
    }

    /// Mean transmission error, mm.
    pub fn mean_error(&self) -> f64 {
        self.transmission_error.iter().sum::<f64>() / self.transmission_error.len() as f64
    }
}

/// A pair that is ready to move.
pub(super) struct Prepared {
    pub system: PairMechanism,
    pub settings: MotionSettings,
    pub quasi_static: QuasiStatic,
    pub elasticity: Elasticity,
    pub facts: Facts,
    pub view: Option<View>,
    pub warnings: Vec<String>,
}

/// Reduces the gears, solves the quasi-static cycle, and makes the mechanism.
///
/// # Errors
/// [`Failure::Static`] where another window may do.
pub(super) fn prepare(inputs: &Inputs<'_>, phases: &mut Phases, window: Option<usize>) -> Result<Prepared, Failure> {
    let Inputs { scene, words, pair, meshes, cache } = inputs;
    let contact = contact_options(scene, pair, window);
    let both = scene.contact.flanks == Flanks::Both;
    let sides = if both { 2.0 } else { 1.0 };
    let (driving, coast) = phases.run_foreseen("reduce", sides * run::foreseen_s(scene, meshes), || {
        let driving = elastic_gears(scene, pair, &contact, meshes, *cache)?;
        let coast =
            both.then(|| elastic_gears(scene, pair, &contact.driven_backwards(), meshes, *cache)).transpose()?;
        Ok::<_, CommandError>((driving, coast))
    })?;
    let ElasticGears { gears, keys, mut warnings } = driving;
    let mut model = phases.run("contact", || StaticModel::new(pair.clone(), gears, contact.clone()))?;
    let positions = scene.analysis.positions_per_cycle;
    let mut recorder = ViewRecorder::new(scene);
    let history = phases.run_steps("quasi-static", u64::from(positions), |progress| {
        model.run(positions as usize, 1, |index, position, model| {
            progress.tick();
            recorder.position(index, position, model);
        })
    })?;
    let quasi_static = QuasiStatic::of(&history);
    let (resolution, said) = resolution(scene, pair, &contact);
    warnings.extend(said);
    warnings.extend(gears::warnings(pair));
    warnings.extend(meshes.iter().flat_map(|m| m.warnings.clone()));
    warnings.extend(run::body_warnings(&model));
    let view = phases.run("view", || recorder.view_or_warning(scene, &model, &mut warnings)).map(View::quasi_static);
    let dof_before = [0, 1].map(|i| run::free_dofs(&model.gears()[i]));
    let mut facts = Facts {
        geometry: gears::geometry_facts(pair),
        meshes: meshes.iter().map(|m| m.facts.clone()).collect(),
        dof_before,
        dof_after: run::dof_after(&model, dof_before),
        window_teeth: Some(model.window().count() as u32),
        resolution: Some(resolution),
        // The motion begins in it and is measured by it.
        certificate: run::certificate(&history.positions),
        reduction: model.gears().iter().filter_map(|g| Some(run::reduced(g)?.way().name())).collect(),
        ..Facts::default()
    };
    if scene.output.root_stress {
        warnings.extend(iso_root::add(&mut facts, scene, pair));
    }
    let gears = model.into_gears();
    let (coast, coast_keys) = match coast {
        Some(ElasticGears { gears, keys, warnings: said }) => {
            warnings.extend(said);
            (Some(Arc::new(gears)), Some(keys))
        }
        None => (None, None),
    };
    let elasticity = Elasticity::new(scene, &gears, &quasi_static, phases)?;
    let options = motion_options(scene, pair, meshes, contact)?;
    let means = [quasi_static.stiffness, quasi_static.line_length];
    let system = phases.run("mechanism", || {
        let system = PairMechanism::new(pair.clone(), Arc::clone(&gears), coast.clone(), options, means)?;
        match elasticity.kept() {
            Some(modes) => system.with_modes(modes),
            None => Ok(system),
        }
    })?;
    let cache: &dyn GearCache = *cache;
    if cache.is_on() {
        phases.run("store", || {
            warnings.extend(keys.save(cache, &gears));
            if let (Some(keys), Some(gears)) = (&coast_keys, &coast) {
                warnings.extend(keys.save(cache, gears));
            }
        });
    }
    let driven = [&pair.pinion, &pair.wheel][system.options().statics.driven()];
    let length = quasi_static.mean_error().abs().max(1e-6);
    let scale = system.scales(&system.coordinates().scales(length, driven.base_radius()), length);
    let settings = MotionSettings {
        scheme: scheme(words),
        rows: words.steps_per_mesh_cycle as usize,
        steps_per_resonance: steps_per_resonance(words, &system),
        tolerance: words.error_tolerance,
        stop_at_events: words.stop_at_events,
        scale,
    };
    Ok(Prepared { system, settings, quasi_static, elasticity, facts, view, warnings })
}

/// The fastest motion that steps have to show, Hz: the mesh resonance, or the highest mode that is kept.
pub(super) fn fastest_hz(system: &PairMechanism) -> f64 {
    system.mode_frequencies_hz().into_iter().fold(system.mesh_resonance_hz(), f64::max)
}

/// Steps in a period of the mesh resonance that give the fastest motion as many as the scene asks for.
fn steps_per_resonance(words: &MotionScene, system: &PairMechanism) -> usize {
    let ratio = fastest_hz(system) / system.mesh_resonance_hz();
    (f64::from(words.steps_per_resonance) * ratio).ceil() as usize
}

/// Contact of the driving flanks: the coast flanks are a contact of their own.
fn contact_options(scene: &Scene, pair: &GearPair, window: Option<usize>) -> StaticOptions {
    let asked = run::options(scene, pair);
    StaticOptions { window: window.or(asked.window), ..asked }.with_contact(|c| c.both_flanks = false)
}

/// The width of the window to try next, where a pair beside it ought to carry load.
pub(super) fn wider(inputs: &Inputs<'_>, window: Option<usize>, error: &StaticError) -> Option<usize> {
    let options = contact_options(inputs.scene, &inputs.pair, window);
    run::wider_window(inputs.scene, &inputs.pair, &inputs.meshes, &options, error)
}
