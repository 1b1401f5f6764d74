//! Reduction of gears by itself: into the cache, and what it took.

use answer::Remark;
use fem::{ElementOptions, Material};
use geometry::Side;
use ltca::StaticModel;
use mesh::MeshedGear;
use reduction::{ElasticGear, GearReducer, ReductionOptions, Window};
use scene::Scene;
use serde::Serialize;

use crate::{
    AnalysisError, GearCache, Observer, PhaseWork,
    elastic_gears::{ElasticGears, RecordKeys, elastic_gears},
    error::nothing_to_reduce,
    estimated_time::announced_seconds,
    meshes, options,
    refused::Refusal,
    run_phase, solver_error,
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
    /// File of the record, where the caller keeps one.
    pub file: Option<String>,
}

/// Both gears of a scene, reduced.
#[derive(Debug)]
pub struct ReducedScene {
    /// Pinion and wheel.
    pub rows: Vec<ReducedRow>,
    /// What the cache knows them by.
    pub keys: RecordKeys,
    /// What a user should hear.
    pub remarks: Vec<Remark>,
}

/// Reduces both gears of a scene for their first window, as a run does, and keeps the records in `cache`.
///
/// # Errors
/// [`AnalysisError::Refused`] when the scene's model reduces nothing; those of a run.
pub fn reduce_scene(
    scene: &Scene,
    observer: &mut dyn Observer,
    cache: &dyn GearCache,
) -> Result<ReducedScene, AnalysisError> {
    if !scene.analysis.model.is_reduced() {
        return Err(nothing_to_reduce(scene));
    }
    let pair = run_phase(observer, "geometry", PhaseWork::Unknown, |_| scene.gear_pair())?;
    let meshes = run_phase(observer, "mesh", PhaseWork::Unknown, |_| meshes::known_pair_meshes(scene, &pair, cache))?;
    let options = options(scene, &pair);
    let work = PhaseWork::Seconds(announced_seconds(observer, (scene.analysis.is_general(), &meshes), 1.0));
    let ElasticGears { gears, keys, mut remarks } = run_phase(observer, "reduce", work, |progress| {
        elastic_gears(scene, &pair, &options, &meshes, (cache, progress, &|| true), false)
    })?;
    let set_up = || StaticModel::new(pair.clone(), gears, options);
    let model = run_phase(observer, "contact", PhaseWork::Unknown, |_| set_up());
    let model = model.map_err(|e| solver_error(scene, e))?;
    if cache.is_on() {
        remarks.extend(run_phase(observer, "store", PhaseWork::Unknown, |_| keys.save(cache, model.gears())));
    }
    let row = |i: usize| {
        let ElasticGear::Reduced(gear) = &model.gears()[i] else { return None };
        let window = &model.contact_set().windows()?[i];
        Some(row(["pinion", "wheel"][i].to_owned(), gear, window))
    };
    Ok(ReducedScene { rows: (0..2).filter_map(row).collect(), keys, remarks })
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

/// Reduces the gear of a mesh file, whose parts have names, to a window of `window` teeth with both flanks; nothing is
/// kept: a record belongs to the data of a gear, which a scene has.
///
/// # Errors
/// [`AnalysisError::Refused`] when the mesh has not so many teeth, [`AnalysisError::Reduction`] when it is not what a
/// gear needs.
pub fn reduce_mesh(
    name: &str,
    gear: MeshedGear,
    material: Material,
    window: usize,
    observer: &mut dyn Observer,
) -> Result<ReducedRow, AnalysisError> {
    let teeth = gear.teeth();
    let whole = gear.is_periodic_sector() || gear.is_whole_gear();
    let all = if whole { gear.tooth_count() as usize } else { teeth.len() };
    if window == 0 || window > all {
        let hint = "give `--window-teeth` up to the number of teeth of the mesh";
        let refusal = Refusal::input(format!("a window of {window} teeth of {all}"), hint);
        return Err(AnalysisError::from(refusal).of_part(name));
    }
    let first = teeth.first().copied().unwrap_or(0);
    let sides = vec![Side::Left, Side::Right];
    let options = ReductionOptions { sides, window, first, elements: ElementOptions::default() };
    let reduce = || GearReducer::new(gear, material, options).and_then(|g| Ok((g.window(first)?, g)));
    let reduced = run_phase(observer, "reduce", PhaseWork::Unknown, |_| reduce());
    let (window, reduced) = reduced.map_err(|source| AnalysisError::from(source).of_part(name))?;
    Ok(row(name.to_owned(), &reduced, &window))
}
