//! From meshes to elastic gears: reduced, from the cache, or with all degrees of freedom.

use answer::Remark;
use fem::{ElementOptions, Material, Wanted};
use geometry::GearPair;
use ltca::{StaticModel, StaticOptions};
use mesh::MeshedGear;
use reduction::{
    ElasticGear, FullGear, GearReducer, LayerStack, PartFault, RecordKey, ReductionOptions, ReductionStage,
    ReductionWatch, record_key,
};

use scene::{Model, Scene};

use crate::{
    AnalysisError, GearCache, Progress,
    error::{in_scene, solver_error},
    estimated_time::estimated_gear_seconds,
    layers::shorter_gear,
    meshes::SceneMesh,
    remark,
};

/// Both gears in the form that the analysis needs.
#[derive(Debug)]
pub struct ElasticGears {
    /// Pinion and wheel.
    pub gears: [ElasticGear; 2],
    /// Keys of the gears in the cache.
    pub keys: RecordKeys,
    /// Faults of files in the cache.
    pub remarks: Vec<Remark>,
}

/// Keys of the gears in the cache; `None` if nothing is cached.
#[derive(Debug)]
pub struct RecordKeys([Option<RecordKey>; 2]);

impl RecordKeys {
    /// Keys of pinion and wheel; `None` if nothing is cached.
    pub fn keys(&self) -> &[Option<RecordKey>; 2] {
        &self.0
    }

    /// Writes the gears reduced in this run; the remarks report write errors.
    pub fn save(&self, cache: &dyn GearCache, gears: &[ElasticGear; 2]) -> Vec<Remark> {
        let reducers = || {
            self.0.iter().zip(gears).filter_map(|(key, gear)| match gear {
                ElasticGear::Reduced(reducer) => Some((key.as_ref()?, reducer)),
                ElasticGear::Full(_) => None,
            })
        };
        reducers().for_each(|(_, reducer)| reducer.keep_parts());
        let records = reducers().filter_map(|(key, reducer)| cache.save(key, &reducer.record()?));
        records.chain(part_faults(gears)).collect()
    }
}

/// Remarks about faults of stored files since the last call.
pub fn part_faults(gears: &[ElasticGear; 2]) -> impl Iterator<Item = Remark> {
    let of = |gear: &ElasticGear| match gear {
        ElasticGear::Reduced(reducer) => reducer.part_faults(),
        ElasticGear::Full(_) => Vec::new(),
    };
    gears.iter().flat_map(of).map(of_part)
}

fn of_part(PartFault { file, what, writing }: PartFault) -> Remark {
    if writing { remark::gear_not_stored(file, what) } else { remark::gear_not_loaded(file, what) }
}

/// Computes both gears in parallel. The progress receives the stages, and between steps it is asked whether the rest is
/// still wanted. A gear that takes long is stored as soon as it is computed, so an interrupted run need not compute it
/// again. `by_layers`: wide gears may be condensed by their layers, for contact only.
///
/// # Errors
/// [`AnalysisError`] if a mesh is not suitable for the analysis.
pub fn elastic_gears(
    scene: &Scene,
    pair: &GearPair,
    options: &StaticOptions,
    meshes: &[SceneMesh; 2],
    waiting: (&dyn GearCache, &dyn Progress, Wanted<'_>),
    by_layers: bool,
) -> Result<ElasticGears, AnalysisError> {
    let first = StaticModel::first_teeth(pair, options).map_err(|e| solver_error(scene, e))?;
    let window = options.window_teeth(pair);
    let build = |i: usize| {
        let elements = ElementOptions::default();
        let options = ReductionOptions { sides: options.contact.sides(), window, first: first[i], elements };
        let geometry = [&pair.pinion, &pair.wheel][i];
        match by_layers.then(|| shorter_gear(scene, geometry, &meshes[i], &options, i)).flatten() {
            Some(short) => of_layers(scene, short, options, waiting, i),
            None => one(scene, pair, options, meshes, waiting, i),
        }
    };
    let (pinion, wheel) = rayon::join(|| build(0), || build(1));
    let ((pinion, first_key, said), (wheel, second_key, also)) = (pinion?, wheel?);
    let remarks = said.into_iter().chain(also).collect();
    Ok(ElasticGears { gears: [pinion, wheel], keys: RecordKeys([first_key, second_key]), remarks })
}

const NAMES: [&str; 2] = ["pinion", "wheel"];

/// A gear that is foreseen to take longer is kept at once, s; others with all that a run has asked of them at its end.
const LONG_S: f64 = 0.8;

/// A gear, its key, and what is wrong with its file.
type Built = (ElasticGear, Option<RecordKey>, Option<Remark>);

/// A wide gear by a shorter one of the same layers; it is soon made, and no file knows it.
fn of_layers(
    scene: &Scene,
    (short, stack): (MeshedGear, LayerStack),
    options: ReductionOptions,
    (_, progress, wanted): (&dyn GearCache, &dyn Progress, Wanted<'_>),
    i: usize,
) -> Result<Built, AnalysisError> {
    let (name, LayerStack { layers, condensed, .. }) = (NAMES[i], stack);
    let tell = |stage: ReductionStage| progress.say(format!("{name} {stage} ({condensed} of {layers} layers)"));
    let watch = ReductionWatch { tell: &tell, wanted };
    match GearReducer::of_layers(short, material(scene, i)?, options, stack, watch) {
        Err(error) if error.is_unwanted() => Err(AnalysisError::Cancelled),
        Err(error) => {
            let error = AnalysisError::from(error).of_part(name).of_part("built-in mesher");
            Err(error.in_file(&scene.file))
        }
        Ok(gear) => Ok((ElasticGear::Reduced(gear), None, None)),
    }
}

fn one(
    scene: &Scene,
    pair: &GearPair,
    options: ReductionOptions,
    meshes: &[SceneMesh; 2],
    (cache, progress, wanted): (&dyn GearCache, &dyn Progress, Wanted<'_>),
    i: usize,
) -> Result<Built, AnalysisError> {
    let (mesh, material) = (&meshes[i], material(scene, i)?);
    if scene.analysis.model == Model::Full {
        let gear = FullGear::new(mesh.gear.clone(), material, &options.elements);
        return Ok((gear.map(ElasticGear::Full).map_err(|e| blame(scene, mesh, i, e))?, None, None));
    }
    let geometry = [&pair.pinion, &pair.wheel][i];
    let general = scene.analysis.is_general();
    let asked = if general { "general" } else { "auto" };
    let key = cache.is_on().then(|| record_key(&mesh.gear, geometry, &material, &options, asked));
    let (found, warning) = key.as_ref().map_or((None, None), |key| {
        let (kept, said) = cache.load(key);
        (kept.and_then(|kept| kept.of(key)), said)
    });
    let name = NAMES[i];
    let tell = |stage: ReductionStage| progress.say(format!("{name} {stage}"));
    let (gear, said) = match found {
        Some(record) => {
            progress.say(format!("{name} from the cache"));
            (GearReducer::from_record(mesh.gear.clone(), material, options, record), None)
        }
        None => {
            let watch = ReductionWatch { tell: &tell, wanted };
            let made = GearReducer::watched(mesh.gear.clone(), material, options, general, watch);
            let long = estimated_gear_seconds(general, mesh) >= LONG_S;
            let kept = made.as_ref().ok().filter(|_| long).and_then(|gear| Some((key.as_ref()?, gear.record()?)));
            let said = kept.and_then(|(key, record)| cache.save(key, &record));
            (made, said)
        }
    };
    match gear {
        Err(error) if error.is_unwanted() => Err(AnalysisError::Cancelled),
        gear => {
            let gear = gear.map_err(|e| blame(scene, mesh, i, e))?;
            let gear = match key.as_ref().and_then(|key| cache.parts(key)) {
                Some(store) => gear.with_parts(store),
                None => gear,
            };
            Ok((ElasticGear::Reduced(gear), key, warning.or(said)))
        }
    }
}

fn blame(scene: &Scene, mesh: &SceneMesh, i: usize, source: reduction::ReductionError) -> AnalysisError {
    let error = AnalysisError::from(source).of_part(NAMES[i]);
    match scene.gears()[i].mesher {
        None => error.of_part(&*mesh.facts.source),
        Some(_) => error.of_part("built-in mesher").in_file(&scene.file),
    }
}

/// Material of pinion (0) or wheel (1).
///
/// # Errors
/// [`AnalysisError`] for an invalid material.
pub fn material(scene: &Scene, i: usize) -> Result<Material, AnalysisError> {
    let (whose, m) = (NAMES[i], scene.gears()[i].material);
    let failed = |source| AnalysisError::from(source).of_part(format!("{whose}'s material"));
    Material::new(m.young_mpa, m.poisson, m.density()).map_err(failed).map_err(in_scene(scene))
}
