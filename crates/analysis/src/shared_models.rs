//! Scenes at rest, one after the other, that share what they have in common: meshes, reduced gears, tables of the
//! contact.

use std::{
    cell::RefCell,
    sync::{Arc, Mutex, PoisonError},
};

use ale::solve_widening;
use geometry::GearPair;
use ltca::{StaticHistory, StaticModel, StaticOptions};
use scene::{Method, Model, ModificationScene, Scene};

use crate::{
    AnalysisError, GearCache, NoObserver, NoSink,
    accuracy::{AccurateAnalysis, AccurateResult},
    elastic_gears::{ElasticGears, elastic_gears},
    failure::Failure,
    inputs::{meshes_of, settled_scene},
    meshes::SceneMesh,
    options::options,
    static_certificate,
    statics::wider_window,
};

/// Models that are kept at the most; which of them goes first is the one that was made first.
const MOST_MODELS: usize = 8;

/// Models of pairs that differ in what neither their matrices nor their contact tables know: micro-geometry, pitch
/// errors, misalignment, friction, torque, positions.
///
/// Shared among threads. What is shared changes no bit of a result ([`StaticModel::modified`]).
pub struct SharedModels<'a> {
    cache: &'a dyn GearCache,
    known: Mutex<Vec<Known>>,
}

/// What belongs to one kind of scene, made when the first of them comes.
struct Known {
    kind: Scene,
    window: Option<usize>,
    base: Arc<Mutex<Option<Arc<Base>>>>,
}

struct Base {
    meshes: [SceneMesh; 2],
    model: StaticModel,
}

impl std::fmt::Debug for SharedModels<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SharedModels").finish_non_exhaustive()
    }
}

impl<'a> SharedModels<'a> {
    /// None yet; reduced gears come from a cache and go there.
    pub fn new(cache: &'a dyn GearCache) -> Self {
        Self { cache, known: Mutex::default() }
    }

    /// Positions of a scene at rest that hold, and the scene as it was solved.
    ///
    /// # Errors
    /// [`AnalysisError`]; that of the certificate among them.
    pub fn solve(&self, scene: &Scene) -> Result<(Scene, StaticHistory), AnalysisError> {
        let shares = scene.analysis.model == Model::Reduced && scene.accuracy.is_none();
        let (scene, history) = if shares { self.shared(scene)? } else { self.alone(scene)? };
        static_certificate(&history.positions).verdict(&scene)?;
        Ok((scene, history))
    }

    /// A scene that nothing is shared of.
    fn alone(&self, scene: &Scene) -> Result<(Scene, StaticHistory), AnalysisError> {
        let analysis = AccurateAnalysis::new(scene).with_cache(self.cache);
        let AccurateResult { scene, result } = analysis.solve_into(&mut NoObserver, &mut NoSink)?;
        Ok((scene, result.history))
    }

    fn shared(&self, scene: &Scene) -> Result<(Scene, StaticHistory), AnalysisError> {
        let scene = settled_scene(scene, false);
        let pair = scene.gear_pair()?;
        let options = options(&scene, &pair);
        let with = |window| StaticOptions { window, ..options.clone() };
        let last: RefCell<Option<Arc<Base>>> = RefCell::new(None);
        let solved = solve_widening(
            options.window,
            |window| {
                let base = self.base(&scene, &pair, with(window))?;
                let mut model = base.model.modified(pair.clone(), with(window))?;
                last.replace(Some(base));
                let (per_cycle, cycles) = (scene.analysis.positions_per_cycle, scene.analysis.cycles);
                Ok(model.run(per_cycle as usize, cycles as usize, |_, _, _| ())?)
            },
            |window, failure| {
                let (Failure::Static(e), Some(base)) = (failure, &*last.borrow()) else { return None };
                wider_window(&scene, &pair, &base.meshes, &with(window), e)
            },
        );
        let history = solved.map_err(|failure: Failure| failure.into_error(&scene))?;
        Ok((scene, history))
    }

    /// The model that a scene shares with others of its kind.
    fn base(&self, scene: &Scene, pair: &GearPair, options: StaticOptions) -> Result<Arc<Base>, Failure> {
        let (kind, window) = (kind(scene), options.window);
        let place = {
            let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
            match known.iter().find(|k| k.window == window && k.kind == kind) {
                Some(found) => Arc::clone(&found.base),
                None => {
                    if known.len() == MOST_MODELS {
                        known.remove(0);
                    }
                    let base = Arc::default();
                    known.push(Known { kind, window, base: Arc::clone(&base) });
                    base
                }
            }
        };
        // Whoever comes while it is being made waits for it.
        let mut made = place.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(base) = &*made {
            return Ok(Arc::clone(base));
        }
        let meshes = meshes_of(scene, pair, None)?;
        let ElasticGears { gears, keys, .. } = elastic_gears(scene, pair, &options, &meshes, self.cache)?;
        let model = StaticModel::new(pair.clone(), gears, options)?;
        if self.cache.is_on() {
            keys.save(self.cache, model.gears());
        }
        let base = Arc::new(Base { meshes, model });
        *made = Some(Arc::clone(&base));
        Ok(base)
    }
}

/// What scenes of one kind have in common: all that meshes, matrices and tables of the contact depend on.
fn kind(scene: &Scene) -> Scene {
    let mut kind = scene.clone();
    kind.name.clear();
    kind.set.clear();
    kind.file.clear();
    for gear in [&mut kind.pinion, &mut kind.wheel] {
        gear.modification = ModificationScene::default();
        gear.pitch_errors_um.clear();
        gear.pitch_errors_file = None;
        // Paths as the scene means them.
        gear.mesh = gear.mesh.take().map(|path| scene.resolve(&path));
    }
    kind.pair.misalignment = Default::default();
    (kind.operation.torque_nm, kind.operation.speed_rpm) = (0.0, 0.0);
    (kind.analysis.positions_per_cycle, kind.analysis.cycles) = (1, 1);
    kind.contact.friction = 0.0;
    if kind.contact.method == Method::Slice {
        // Stresses are recovered from the gears, and asked for by the case.
        kind.output.contact_lines = false;
    }
    kind
}
