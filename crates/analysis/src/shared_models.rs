//! Data that successive static scenes share: meshes, reduced gears, tables of the contact.

use answer::Remark;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use fem::Wanted;
use geometry::GearPair;
use ltca::{NominalLines, StaticModel, StaticOptions, slices_needed_on};
use mesh::Mesh;
use scene::{Model, Scene};

use crate::{
    AnalysisError, GearCache, NoObserver,
    alike::kind,
    elastic_gears::{ElasticGears, elastic_gears},
    failure::Failure,
    inputs::{meshes_of, with_meshes_of},
    meshes::SceneMesh,
    options::options,
    reduced_pairs::ReducedPairs,
    resolution::with_slices_by,
    solution_remarks::body_remarks,
};

/// Models that are kept at the most; which of them goes first is the one that was made first.
const MOST_MODELS: usize = 8;

/// Models of pairs that differ only in quantities on which neither their matrices nor their contact tables depend:
/// micro-geometry, pitch errors, misalignment, friction, slices, torque, positions.
///
/// Meshes of gearboxes share their reduced gears in the same way. Threads share this object. Sharing does not change
/// any bit of a result ([`StaticModel::modified`]).
pub struct SharedModels<'a> {
    cache: Arc<dyn GearCache + Send + 'a>,
    /// Those that the caller holds, in place of those of the scenes.
    meshes: Option<[Mesh; 2]>,
    known: Mutex<Vec<Known>>,
    /// Reduced pairs of the meshes of gearboxes.
    pub(crate) pairs: ReducedPairs,
    read: Mutex<Vec<(Scene, Arc<[SceneMesh; 2]>)>>,
    /// Nominal contact lines of the last pair that asked for them.
    lines: Mutex<Option<Arc<NominalLines>>>,
}

/// What belongs to one kind of scene, made when the first of them comes.
struct Known {
    kind: Scene,
    window: Option<usize>,
    base: Arc<Mutex<Option<Arc<Base>>>>,
}

pub(crate) struct Base {
    pub meshes: Arc<[SceneMesh; 2]>,
    pub model: StaticModel,
    /// What a user should hear of its bodies, once somebody asks.
    of_bodies: OnceLock<Vec<Remark>>,
}

impl Base {
    /// Remarks about its bodies.
    pub fn body_remarks(&self) -> &[Remark] {
        self.of_bodies.get_or_init(|| body_remarks(&self.model))
    }
}

impl std::fmt::Debug for SharedModels<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SharedModels").finish_non_exhaustive()
    }
}

impl<'a> SharedModels<'a> {
    /// Empty at first; reduced gears are read from a cache and stored there.
    pub fn new(cache: &'a dyn GearCache) -> Self {
        Self::holding(Arc::new(cache))
    }

    /// Shared models with a cache that may itself be shared.
    pub fn holding(cache: Arc<dyn GearCache + Send + 'a>) -> Self {
        let (known, pairs, read, lines) = Default::default();
        Self { cache, meshes: None, known, pairs, read, lines }
    }

    /// Uses meshes of pinion and wheel instead of those of all scenes. They are checked like mesh files.
    #[must_use]
    pub fn with_meshes(self, meshes: [Mesh; 2]) -> Self {
        Self { meshes: Some(meshes), ..self }
    }

    /// Meshes of pinion and wheel that the caller has given.
    pub(crate) fn meshes(&self) -> Option<[&Mesh; 2]> {
        self.meshes.as_ref().map(|[pinion, wheel]| [pinion, wheel])
    }

    /// Where reduced gears come from and go to.
    pub(crate) fn cache(&self) -> &(dyn GearCache + Send + 'a) {
        &*self.cache
    }

    /// The scene with the slices that it asks for, as [`crate::inputs::resolved_scene`] has it.
    pub(crate) fn resolved_scene(&self, scene: &Scene) -> Scene {
        let needed = |pair: &GearPair, options: &StaticOptions| {
            let lines = {
                let mut known = self.lines.lock().unwrap_or_else(PoisonError::into_inner);
                let lines = known.take().filter(|lines| lines.serves(pair, options));
                Arc::clone(known.insert(lines.unwrap_or_else(|| Arc::new(NominalLines::new(pair, options)))))
            };
            slices_needed_on(&lines, pair, options)
        };
        with_meshes_of(with_slices_by(scene.clone(), needed), self.meshes.is_some())
    }

    /// Meshes of a scene, read or made once.
    pub(crate) fn scene_meshes(&self, scene: &Scene, pair: &GearPair) -> Result<Arc<[SceneMesh; 2]>, AnalysisError> {
        let kind = kind(scene);
        let known = || self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = known().iter().find(|(own, _)| *own == kind) {
            return Ok(Arc::clone(found));
        }
        let made = Arc::new(meshes_of(scene, pair, self.meshes(), &*self.cache)?);
        let mut known = known();
        if known.len() == MOST_MODELS {
            known.remove(0);
        }
        known.push((kind, Arc::clone(&made)));
        Ok(made)
    }

    /// Makes meshes and reduced gears of a scene available to others of its kind.
    ///
    /// # Errors
    /// [`AnalysisError`], also if the model of the scene reduces no gears.
    pub fn reduce(&self, scene: &Scene) -> Result<(), AnalysisError> {
        if scene.analysis.model != Model::Reduced {
            return Err(crate::error::nothing_to_reduce(scene));
        }
        let scene = self.resolved_scene(scene);
        let pair = scene.gear_pair()?;
        let options = options(&scene, &pair);
        self.base(&scene, &pair, options, &|| true).map_err(|failure| failure.into_error(&scene)).map(|_| ())
    }

    /// The model that a scene shares with others of its kind.
    pub(crate) fn base(
        &self,
        scene: &Scene,
        pair: &GearPair,
        options: StaticOptions,
        wanted: Wanted<'_>,
    ) -> Result<Arc<Base>, Failure> {
        let (own, window) = (kind(scene), options.window);
        let place = {
            let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
            match known.iter().find(|k| k.window == window && k.kind == own) {
                Some(found) => Arc::clone(&found.base),
                None => {
                    if known.len() == MOST_MODELS {
                        known.remove(0);
                    }
                    let base = Arc::default();
                    known.push(Known { kind: own.clone(), window, base: Arc::clone(&base) });
                    base
                }
            }
        };
        // Whoever comes while it is being made waits for it.
        let mut made = place.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(base) = &*made {
            return Ok(Arc::clone(base));
        }
        let meshes = self.scene_meshes(scene, pair)?;
        let ElasticGears { gears, keys, .. } =
            elastic_gears(scene, pair, &options, &meshes, (&*self.cache, &NoObserver, wanted), true)?;
        let model = StaticModel::new(pair.clone(), gears, options)?;
        if self.cache.is_on() {
            keys.save(&*self.cache, model.gears());
        }
        let base = Arc::new(Base { meshes, model, of_bodies: OnceLock::new() });
        *made = Some(Arc::clone(&base));
        Ok(base)
    }
}
