//! Where a checked scene becomes a call of the solvers.

mod certificate;
mod coarse;
mod doubts;
mod foreseen;
mod options;

use ale::solve_widening;
use doubts::doubts;
use geometry::GearPair;
use ltca::{StaticError, StaticHistory, StaticModel, StaticOptions};
use reduction::{ElasticGear, GearReducer};
use report::{paraview::FieldWriter, view::ViewRecorder};

use crate::{
    cache::Cache,
    elastic_gears::{ElasticGears, elastic_gears},
    error::CommandError,
    facts::{Facts, Solved},
    gears, iso_model, iso_root,
    meshes::{self, SceneMesh},
    output::{self, ResultDirectory},
    phases::Phases,
    resolution::resolution,
    scene::{Analysis, Model, Scene},
};

pub(crate) use certificate::{certificate, worse};
pub(crate) use doubts::body_warnings;
pub(crate) use foreseen::foreseen_s;
pub(crate) use options::options;

/// Solves a scene; ParaView files, when asked for, go into `results` on the way. Reduced gears come from `cache` and go there.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no solution is found.
pub fn solve(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Solved, CommandError> {
    Ok(solve_scene(scene, phases, results, cache, true)?.0)
}

/// As [`solve`], without the gears in space; the model comes back too, its gears reduced: for more of the same. `None` for a model without meshes.
///
/// # Errors
/// Those of [`solve`].
pub(crate) fn solve_and_keep(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<(Solved, Option<StaticModel>), CommandError> {
    solve_scene(scene, phases, results, cache, false)
}

fn solve_scene(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    in_space: bool,
) -> Result<(Solved, Option<StaticModel>), CommandError> {
    let pair = phases.run("geometry", || gears::pair(scene))?;
    if scene.analysis.model == Model::Iso {
        let mut solved = phases.run("solve", || iso_model::solve(scene, &pair))?;
        solved.history.warnings.extend(gears::doubts(&pair));
        return Ok((solved, None));
    }
    let meshes = phases.run("mesh", || meshes::pair_meshes(scene, &pair))?;
    let mut warnings = gears::doubts(&pair);
    warnings.extend(meshes.iter().flat_map(|m| m.warnings.clone()));
    let options = options(scene, &pair);
    let (resolution, said) = resolution(scene, &pair, &options);
    warnings.extend(said);
    let inputs = Inputs { scene, results, cache, pair: &pair, meshes: &meshes };
    let with = |window| StaticOptions { window, ..options.clone() };
    let solved = solve_widening(
        options.window,
        |window| attempt(inputs, phases, &with(window)),
        |window, failure| {
            let Failure::Static(e) = failure else { return None };
            let teeth = wider_window(scene, &pair, &meshes, &with(window), e)?;
            warnings.push(format!("{e}; the window was widened to {teeth} teeth"));
            Some(teeth)
        },
    );
    let Attempt { model, mut history, first_result_s, recorder } = solved.map_err(|e| e.complaint(scene))?;
    let dof_before = [0, 1].map(|i| free_dofs(&model.gears()[i]));
    let mut facts = Facts {
        geometry: gears::geometry_facts(&pair),
        meshes: meshes.iter().map(|m| m.facts.clone()).collect(),
        dof_before,
        dof_after: dof_after(&model, dof_before),
        window_teeth: Some(model.window().count() as u32),
        first_result_s,
        contact_points: Some(model.contact_set().points().iter().map(Vec::len).sum()),
        resolution: Some(resolution),
        ..Facts::default()
    };
    if scene.output.root_stress {
        warnings.extend(iso_root::add(&mut facts, scene, &pair));
    }
    let cyclic = model.gears().iter().all(|g| reduced(g).is_some_and(GearReducer::is_cyclic));
    facts.model.insert("cyclic_gears".into(), cyclic.into());
    let stored = model.gears().iter().filter(|g| reduced(g).is_some_and(GearReducer::is_from_record)).count();
    facts.model.insert("gears_from_cache".into(), stored.into());
    facts.reduction = model.gears().iter().filter_map(|g| Some(reduced(g)?.way().name())).collect();
    warnings.extend(body_warnings(&model));
    warnings.extend(doubts(&history.positions, scene.pair.normal_module_mm));
    let root = output::root_stress_headline(&history).map(|root| root.largest_tensions());
    warnings.extend(root.into_iter().flat_map(output::root_stress_warnings));
    let view =
        in_space.then(|| phases.run("view", || recorder.view_or_warning(scene, &model, &mut warnings))).flatten();
    history.warnings.extend(warnings);
    Ok((Solved { history, facts, view }, Some(model)))
}

/// Wall time (s) of the scene's positions once more on gears that are reduced already.
///
/// # Errors
/// Those of [`solve`].
pub(crate) fn time_again(scene: &Scene, mut model: StaticModel) -> Result<f64, CommandError> {
    let complain = |e: StaticError| complaint(scene, &e);
    let start = std::time::Instant::now();
    let Analysis { positions_per_cycle, cycles, .. } = scene.analysis;
    model.run(positions_per_cycle as usize, cycles as usize, |_, _, _| ()).map_err(complain)?;
    Ok(start.elapsed().as_secs_f64())
}

/// Why an attempt with one width of the window failed.
pub(crate) enum Failure {
    /// The solver's own error, which another width may cure.
    Static(StaticError),
    /// Anything else.
    Command(CommandError),
}

impl From<CommandError> for Failure {
    fn from(e: CommandError) -> Self {
        Self::Command(e)
    }
}

impl Failure {
    /// What the user is told.
    pub(crate) fn complaint(self, scene: &Scene) -> CommandError {
        match self {
            Self::Command(e) => e,
            Self::Static(e) => complaint(scene, &e),
        }
    }
}

impl From<StaticError> for Failure {
    fn from(e: StaticError) -> Self {
        Self::Static(e)
    }
}

/// One more tooth, when a pair beside the window would touch, the user has not fixed the width, and the meshes have the teeth.
pub(crate) fn wider_window(
    scene: &Scene,
    pair: &GearPair,
    meshes: &[SceneMesh; 2],
    options: &StaticOptions,
    error: &StaticError,
) -> Option<usize> {
    let teeth = options.window_teeth(pair) + 1;
    let starved = error.is_starved();
    let available = |m: &SceneMesh| {
        if m.gear.is_periodic_sector() { m.gear.tooth_count() as usize } else { m.gear.teeth().len() }
    };
    let room = meshes.iter().all(|m| teeth < available(m));
    (starved && scene.analysis.window_teeth.is_none() && room).then_some(teeth)
}

/// What all attempts share.
#[derive(Clone, Copy)]
struct Inputs<'a> {
    scene: &'a Scene,
    results: &'a ResultDirectory,
    cache: &'a Cache,
    pair: &'a GearPair,
    meshes: &'a [SceneMesh; 2],
}

/// What comes of one width of the window.
struct Attempt {
    model: StaticModel,
    history: StaticHistory,
    first_result_s: Option<f64>,
    recorder: ViewRecorder,
}

/// Reduction and run with one width of the window.
fn attempt(inputs: Inputs<'_>, phases: &mut Phases, options: &StaticOptions) -> Result<Attempt, Failure> {
    let Inputs { scene, results, cache, pair, meshes } = inputs;
    let name = if scene.analysis.model == Model::Full { "assemble" } else { "reduce" };
    let ElasticGears { gears, keys, mut warnings } =
        phases.run_foreseen(name, foreseen_s(scene, meshes), || elastic_gears(scene, pair, options, meshes, cache))?;
    let mut model = phases.run("contact", || StaticModel::new(pair.clone(), gears, options.clone()))?;
    let per_cycle = scene.analysis.positions_per_cycle as usize;
    let steps = per_cycle * scene.analysis.cycles as usize;
    let mut fields = FieldWriter::new(scene, results);
    let mut recorder = ViewRecorder::new(scene);
    let (start, mut first_result_s) = (phases.start(), None);
    let mut history = phases.run_steps("solve", steps as u64, |progress| {
        let mut failed = None;
        let history = model.run(per_cycle, scene.analysis.cycles as usize, |index, position, model| {
            first_result_s.get_or_insert_with(|| start.elapsed().as_secs_f64());
            progress.tick();
            progress.say(format!("STE {:.3} um", 1e3 * position.transmission_error));
            recorder.position(index, position, model);
            if failed.is_none() {
                failed = fields.position(index, position, model).err();
            }
        });
        match failed {
            Some(error) => Err(Failure::Command(error.into())),
            None => history.map_err(Failure::Static),
        }
    })?;
    fields.finish().map_err(CommandError::from)?;
    if cache.is_on() {
        // After the run, when every window and half tooth that it took is known.
        warnings.extend(phases.run("store", || keys.save(cache, model.gears())));
    }
    history.warnings.extend(warnings);
    Ok(Attempt { model, history, first_result_s, recorder })
}

pub(crate) fn reduced(gear: &ElasticGear) -> Option<&GearReducer> {
    match gear {
        ElasticGear::Reduced(r) => Some(r),
        ElasticGear::Full(_) => None,
    }
}

pub(crate) fn free_dofs(gear: &ElasticGear) -> usize {
    match gear {
        ElasticGear::Reduced(r) => r.free_count(),
        ElasticGear::Full(f) => f.dofs.free_count(),
    }
}

pub(crate) fn dof_after(model: &StaticModel, before: [usize; 2]) -> [usize; 2] {
    match model.contact_set().windows() {
        Some(windows) => [0, 1].map(|i| windows[i].reduced.coordinates()),
        None => before,
    }
}

/// Wrong input is status 2, a solver that finds no answer status 1.
pub(crate) fn complaint(scene: &Scene, error: &StaticError) -> CommandError {
    let keys: &[&str] = match error {
        StaticError::Overloaded { .. } => &["operation.torque_nm"],
        error if error.is_starved() => &["analysis.window_teeth"],
        _ => &[],
    };
    let place = scene.place_of(keys);
    let at = place.as_ref().map_or_else(|| scene.file.display().to_string(), ToString::to_string);
    let message = format!("{at}: {error}");
    let told = match error {
        StaticError::Contact { .. } | StaticError::NoEquilibrium { .. } => CommandError::failed(message, error.hint()),
        _ => CommandError::input(message, error.hint()),
    };
    told.about(place.as_ref().and_then(|p| p.excerpt()))
}
