//! Reduction of a scene's gears by itself: into the cache, and what it took.

use analysis::GearCache;
use fem::{ElementOptions, Material};
use geometry::Side;
use ltca::StaticModel;
use mesh::GearMesh;
use reduction::{ElasticGear, GearReducer, ReductionOptions, Window};
use serde::Serialize;

use crate::{
    cache::Cache,
    elastic_gears::{ElasticGears, elastic_gears},
    error::CommandError,
    meshes,
    phases::Phases,
    run::{self, complaint},
    scene::Scene,
};

/// What the reduction of one gear came to.
#[derive(Debug, Clone, Serialize)]
pub struct ReducedRow {
    /// `pinion`, `wheel`, or the mesh file.
    pub gear: String,
    /// `cyclic sector` or `general`.
    pub way: &'static str,
    /// Whether the record was there already.
    pub from_cache: bool,
    /// Free degrees of freedom of the gear.
    pub dof_before: usize,
    /// Coordinates of a window.
    pub coordinates: usize,
    /// Teeth of a window.
    pub window_teeth: usize,
    /// File of the record, where one is kept.
    pub file: Option<String>,
}

/// Reduces both gears of a scene for their first window, as a run does, and keeps the records in `cache`. Warnings come second.
///
/// # Errors
/// Exit status 2 when the scene's model reduces nothing, or when a mesh is not what it needs.
pub fn reduce_scene(
    scene: &Scene,
    phases: &mut Phases,
    cache: &Cache,
) -> Result<(Vec<ReducedRow>, Vec<String>), CommandError> {
    if !scene.analysis.model.is_reduced() {
        let model = scene.place_of(&["analysis.model"]);
        let at = model.as_ref().map_or_else(|| scene.file.display().to_string(), ToString::to_string);
        let hint = "use `model = \"reduced\"` in [analysis], or `--set analysis.model=reduced`".to_owned();
        return Err(CommandError::input(format_args!("{at}: this model reduces nothing"), Some(hint))
            .about(model.as_ref().and_then(|p| p.excerpt())));
    }
    let pair = phases.run("geometry", || scene.gear_pair())?;
    let meshes = phases.run("mesh", || meshes::pair_meshes(scene, &pair))?;
    let options = run::options(scene, &pair);
    let foreseen = run::foreseen_s(scene, &meshes);
    let ElasticGears { gears, keys, mut warnings } =
        phases.run_foreseen("reduce", foreseen, || elastic_gears(scene, &pair, &options, &meshes, cache))?;
    let model = phases.run("contact", || StaticModel::new(pair.clone(), gears, options));
    let model = model.map_err(|e| complaint(scene, &e))?;
    if cache.is_on() {
        warnings.extend(phases.run("store", || keys.save(cache, model.gears())));
    }
    let files = keys.keys().each_ref().map(|key| cache.file(key.as_ref()?));
    let row = |i: usize| {
        let ElasticGear::Reduced(gear) = &model.gears()[i] else { return None };
        let file = files[i].as_ref().filter(|f| f.is_file()).map(|f| f.display().to_string());
        let window = &model.contact_set().windows()?[i];
        Some(ReducedRow { file, ..row(["pinion", "wheel"][i].to_owned(), gear, window) })
    };
    Ok(((0..2).filter_map(row).collect(), warnings))
}

fn row(gear: String, of: &GearReducer, window: &Window) -> ReducedRow {
    ReducedRow {
        gear,
        way: of.way().name(),
        from_cache: of.is_from_record(),
        dof_before: of.free_count(),
        coordinates: window.reduced.coordinates(),
        window_teeth: window.reduced.teeth.len(),
        file: None,
    }
}

/// Reduces the gear of a mesh file, whose parts have names, to a window of `window` teeth with both flanks; nothing is kept: a record
/// belongs to the data of a gear, which a scene has.
///
/// # Errors
/// Exit status 2 when the mesh has not so many teeth, or is not what a gear needs.
pub fn reduce_mesh(
    name: &str,
    gear: GearMesh,
    material: Material,
    window: usize,
    phases: &mut Phases,
) -> Result<ReducedRow, CommandError> {
    let teeth = gear.teeth();
    let whole = gear.is_periodic_sector() || gear.is_whole_gear();
    let all = if whole { gear.tooth_count() as usize } else { teeth.len() };
    if window == 0 || window > all {
        let hint = "give `--window-teeth` up to the number of teeth of the mesh".to_owned();
        return Err(CommandError::input(format_args!("{name}: a window of {window} teeth of {all}"), Some(hint)));
    }
    let first = teeth.first().copied().unwrap_or(0);
    let sides = vec![Side::Left, Side::Right];
    let options = ReductionOptions { sides, window, first, elements: ElementOptions::default() };
    let reduced =
        phases.run("reduce", || GearReducer::new(gear, material, options).and_then(|g| Ok((g.window(first)?, g))));
    let (window, reduced) = reduced.map_err(|e| CommandError::input(format_args!("{name}: {e}"), e.hint()))?;
    Ok(row(name.to_owned(), &reduced, &window))
}
