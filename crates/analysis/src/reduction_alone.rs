//! Reduces gears without an analysis: stores them in the cache and reports the cost.

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

/// Result of the reduction of one gear.
#[derive(Debug, Clone, Serialize)]
pub struct ReducedRow {
    /// Name of the gear: `pinion`, `wheel`, or the mesh file.
    pub gear: String,
    /// Method of reduction: `cyclic sector` or `general`.
    pub way: &'static str,
    /// Whether the record already existed.
    pub from_cache: bool,
    /// Free degrees of freedom of the gear.
    pub dof_before: usize,
    /// Number of coordinates of a window.
    pub coordinates: usize,
    /// Number of teeth of a window.
    pub window_teeth: usize,
    /// File of the record, if the caller stores one.
    pub file: Option<String>,
}

/// Both gears of a scene, reduced.
#[derive(Debug)]
pub struct ReducedScene {
    /// Rows for pinion and wheel.
    pub rows: Vec<ReducedRow>,
    /// Keys of the gears in the cache.
    pub keys: RecordKeys,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

/// Reduces both gears of a scene for their first window, as a run does, and stores the records in `cache`.
///
/// # Errors
/// [`AnalysisError::Refused`] if the scene's model reduces no gears; the errors of a run.
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

/// Reduces the gear of a mesh file with named parts to a window of `window` teeth with both flanks. Nothing is stored,
/// because a record belongs to the data of a gear, which only a scene has.
///
/// # Errors
/// [`AnalysisError::Refused`] if the mesh has fewer teeth, [`AnalysisError::Reduction`] if it is not suitable.
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
