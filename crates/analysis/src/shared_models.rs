//! Scenes at rest, one after the other, that share what they have in common: meshes, reduced gears, tables of the
//! contact.

use std::{
    cell::RefCell,
    ops::ControlFlow,
    sync::{Arc, Mutex, PoisonError},
};

use ale::solve_widening;
use geometry::GearPair;
use ltca::{Sensitivities, Sensitivity, StaticError, StaticHistory, StaticModel, StaticOptions, Variation};
use scene::{ContactScene, Method, Model, ModificationScene, Scene};

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

/// A scene with a little less and a little more of a parameter that meshes and matrices do not know.
#[derive(Debug, Clone)]
pub struct VariedScene {
    /// With less, and with more.
    pub sides: [Scene; 2],
    /// By how much, in the parameter's unit.
    pub steps: [f64; 2],
}

/// Positions and their derivatives.
#[derive(Debug, Clone)]
pub struct SolvedWithRates {
    /// The scene as it was solved.
    pub scene: Scene,
    /// Its positions.
    pub history: StaticHistory,
    /// Of each position, by each parameter.
    pub rates: Vec<Vec<Sensitivity>>,
}

impl VariedScene {
    /// The pairs beside the one of `scene`, which is solved with `options`.
    fn variation(&self, scene: &Scene, solved: &StaticOptions) -> Result<Variation, Failure> {
        let side = |own: &Scene| -> Result<(GearPair, StaticOptions), Failure> {
            let own = Scene { contact: ContactScene { slices: scene.contact.slices, ..own.contact }, ..own.clone() };
            let pair = own.gear_pair().map_err(AnalysisError::from)?;
            let options = StaticOptions { window: solved.window, ..options(&own, &pair) };
            Ok((pair, options))
        };
        let [down, up] = &self.sides;
        Ok(Variation::new([side(down)?, side(up)?], self.steps))
    }
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

    /// Positions of a scene at rest with the derivatives of the loaded pair by some parameters, and the scene as it was solved.
    ///
    /// # Errors
    /// [`AnalysisError`]; that of the certificate among them, and derivatives that are not there.
    pub fn solve_with_rates(&self, scene: &Scene, varied: &[VariedScene]) -> Result<SolvedWithRates, AnalysisError> {
        let (scene, history, rates) = self.positions(scene, varied)?;
        static_certificate(&history.positions).verdict(&scene)?;
        Ok(SolvedWithRates { scene, history, rates })
    }

    fn shared(&self, scene: &Scene) -> Result<(Scene, StaticHistory), AnalysisError> {
        let (scene, history, _) = self.positions(scene, &[])?;
        Ok((scene, history))
    }

    fn positions(
        &self,
        scene: &Scene,
        varied: &[VariedScene],
    ) -> Result<(Scene, StaticHistory, Vec<Vec<Sensitivity>>), AnalysisError> {
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
                let variations = varied.iter().map(|v| v.variation(&scene, &with(window))).collect::<Result<_, _>>()?;
                let mut sensitivities = Sensitivities::new(variations).of_loaded_pair();
                let mut rates = Vec::new();
                let history = model.run_while(per_cycle as usize, cycles as usize, |_, _, model| {
                    if varied.is_empty() {
                        return ControlFlow::Continue(());
                    }
                    rates.push(sensitivities.of(model));
                    if rates.last().is_some_and(Result::is_err) {
                        return ControlFlow::Break(());
                    }
                    ControlFlow::Continue(())
                })?;
                Ok((history, rates.into_iter().collect::<Result<Vec<_>, StaticError>>()?))
            },
            |window, failure| {
                let (Failure::Static(e), Some(base)) = (failure, &*last.borrow()) else { return None };
                wider_window(&scene, &pair, &base.meshes, &with(window), e)
            },
        );
        let (history, rates) = solved.map_err(|failure: Failure| failure.into_error(&scene))?;
        Ok((scene, history, rates))
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
