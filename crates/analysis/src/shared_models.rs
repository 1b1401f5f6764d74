//! Scenes at rest, one after the other, that share what they have in common: meshes, reduced gears, tables of the
//! contact.

use std::{
    cell::RefCell,
    ops::ControlFlow,
    sync::{
        Arc, Mutex, OnceLock, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

use ale::solve_widening;
use fem::Wanted;
use geometry::GearPair;
use ltca::{
    Sensitivities, Sensitivity, StaticError, StaticHistory, StaticModel, StaticOptions, StaticPosition, Variation,
};
use mesh::Mesh;
use scene::{ContactScene, Model, Scene};

use crate::{
    AnalysisError, Derivatives, GearCache, NoObserver,
    accuracy::{AccurateAnalysis, AccurateResult},
    alike::{kind, of_gears, shares},
    elastic_gears::{ElasticGears, elastic_gears},
    failure::Failure,
    gears,
    inputs::{meshes_of, settled_scene},
    interest::Interest,
    light_load,
    meshes::SceneMesh,
    options::options,
    plausible::refuse,
    resolution::resolution_warnings,
    static_certificate,
    statics::{SinkResult, StaticSink, wider_window},
    warnings::{body_warnings, deflection_warnings, jammed_pair},
};

/// Models that are kept at the most; which of them goes first is the one that was made first.
const MOST_MODELS: usize = 8;

/// Models of pairs that differ in what neither their matrices nor their contact tables know: micro-geometry, pitch
/// errors, misalignment, friction, torque, positions.
///
/// Shared among threads. What is shared changes no bit of a result ([`StaticModel::modified`]).
pub struct SharedModels<'a> {
    cache: Arc<dyn GearCache + Send + 'a>,
    /// Those that the caller holds, in place of those of the scenes.
    meshes: Option<[Mesh; 2]>,
    known: Mutex<Vec<Known>>,
    read: Mutex<Vec<(Scene, Arc<[SceneMesh; 2]>)>>,
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
    of_bodies: OnceLock<Vec<String>>,
}

/// A scene with a little less and a little more of a parameter that meshes and matrices do not know.
#[derive(Debug, Clone)]
pub struct VariedScene {
    /// With less, and with more.
    pub sides: [Scene; 2],
    /// By how much, in the parameter's unit.
    pub steps: [f64; 2],
}

/// Whether it is found out what a user should hear of pair, meshes and bodies at rest, which takes a twentieth of the time
/// of a quick case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WarningsAtRest {
    /// The history has all warnings that a run by itself has.
    Told,
    /// The history has the warnings of its own positions alone.
    Left,
}

/// What is asked for beside the positions: derivatives by some parameters, of the unloaded pair too or not.
#[derive(Clone, Copy, Default)]
struct Rates<'a> {
    of: &'a [VariedScene],
    of_unloaded: bool,
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
    pub(crate) fn variation(&self, scene: &Scene, solved: &StaticOptions) -> Result<Variation, Failure> {
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

impl Base {
    /// Adds what a user should hear of pair, meshes and bodies, as a run by itself says it.
    fn warn(&self, scene: &Scene, history: &mut StaticHistory) -> Result<(), AnalysisError> {
        let pair = scene.gear_pair()?;
        history.warnings.extend(gears::warnings(&pair));
        history.warnings.extend(self.meshes.iter().flat_map(|m| m.warnings.clone()));
        let options = options(scene, &pair);
        history.warnings.extend(resolution_warnings(scene, &pair, &options));
        history.warnings.extend(jammed_pair(&history.positions, &pair, &options));
        history.warnings.extend(self.of_bodies.get_or_init(|| body_warnings(&self.model)).iter().cloned());
        let (module, distance) = (scene.pair.normal_module_mm, pair.centre_distance());
        history.warnings.extend(deflection_warnings(&history.positions, module, distance));
        Ok(())
    }
}

impl<'a> SharedModels<'a> {
    /// None yet; reduced gears come from a cache and go there.
    pub fn new(cache: &'a dyn GearCache) -> Self {
        Self::holding(Arc::new(cache))
    }

    /// The same with a cache that others may hold as well.
    pub fn holding(cache: Arc<dyn GearCache + Send + 'a>) -> Self {
        Self { cache, meshes: None, known: Mutex::default(), read: Mutex::default() }
    }

    /// With meshes of pinion and wheel in place of those of all scenes. They are checked as files are.
    #[must_use]
    pub fn with_meshes(self, meshes: [Mesh; 2]) -> Self {
        Self { meshes: Some(meshes), ..self }
    }

    /// Where reduced gears come from and go to.
    pub(crate) fn cache(&self) -> &dyn GearCache {
        &*self.cache
    }

    /// Meshes of pinion and wheel that the caller has given.
    pub(crate) fn meshes(&self) -> Option<[&Mesh; 2]> {
        self.meshes.as_ref().map(|[pinion, wheel]| [pinion, wheel])
    }

    /// Meshes of a scene, read or made once.
    pub(crate) fn scene_meshes(&self, scene: &Scene, pair: &GearPair) -> Result<Arc<[SceneMesh; 2]>, AnalysisError> {
        let kind = kind(scene);
        let known = || self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = known().iter().find(|(own, _)| *own == kind) {
            return Ok(Arc::clone(found));
        }
        let made = Arc::new(meshes_of(scene, pair, self.meshes())?);
        let mut known = known();
        if known.len() == MOST_MODELS {
            known.remove(0);
        }
        known.push((kind, Arc::clone(&made)));
        Ok(made)
    }

    /// Meshes and reduced gears of a scene, for others of its kind.
    ///
    /// # Errors
    /// [`AnalysisError`], also where the model of the scene reduces no gears.
    pub fn reduce(&self, scene: &Scene) -> Result<(), AnalysisError> {
        if scene.analysis.model != Model::Reduced {
            return Err(AnalysisError::nothing_to_reduce(scene));
        }
        let scene = settled_scene(scene, self.meshes.is_some());
        let pair = scene.gear_pair()?;
        let options = options(&scene, &pair);
        self.base(&scene, &pair, options, &|| true).map_err(|failure| failure.into_error(&scene)).map(|_| ())
    }

    /// Positions of a scene at rest that hold, and the scene as it was solved.
    ///
    /// # Errors
    /// [`AnalysisError`]; that of the certificate among them.
    pub fn solve(&self, scene: &Scene) -> Result<(Scene, StaticHistory), AnalysisError> {
        if shares(scene) {
            let SolvedWithRates { scene, history, .. } = self.solve_with_rates(scene, &[])?;
            return Ok((scene, history));
        }
        let (scene, history) = self.alone(scene, &|| true)?;
        static_certificate(&scene, &history.positions).verdict(&scene)?;
        Ok((scene, history))
    }

    /// As [`SharedModels::solve`], and with the positions what a user should hear of pair, meshes and bodies, as a run by itself says it.
    ///
    /// # Errors
    /// As of [`SharedModels::solve`].
    pub fn solve_told(&self, scene: &Scene) -> Result<(Scene, StaticHistory), AnalysisError> {
        match self.solve_while(scene, Interest::LASTING)? {
            Some(told) => Ok(told),
            None => self.solve(scene),
        }
    }

    /// As [`SharedModels::solve`], with the derivatives that the scene asks for in `output.derivatives`; `None` where it asks
    /// for none.
    ///
    /// # Errors
    /// As of [`SharedModels::solve`], and where there are no derivatives.
    pub fn solve_with_derivatives(
        &self,
        scene: &Scene,
        warnings: WarningsAtRest,
    ) -> Result<(Scene, StaticHistory, Option<Derivatives>), AnalysisError> {
        let keys = scene.output.derivatives.clone();
        if keys.is_empty() {
            let (scene, history) = match warnings {
                WarningsAtRest::Told => self.solve_told(scene)?,
                WarningsAtRest::Left => self.solve(scene)?,
            };
            return Ok((scene, history, None));
        }
        let varied = VariedScene::by_keys(scene, &keys)?;
        let asked = Rates { of: &varied, of_unloaded: true };
        let (SolvedWithRates { scene, mut history, rates }, base) = self.positions(scene, asked, Interest::LASTING)?;
        static_certificate(&scene, &history.positions).verdict(&scene)?;
        if warnings == WarningsAtRest::Told {
            base.warn(&scene, &mut history)?;
        }
        Ok((scene, history, Some(Derivatives { keys, rates })))
    }

    /// As [`SharedModels::solve`], with all that a user should hear in the history's warnings, for who may lose
    /// interest; `None` where that happened. A scene that shares nothing reduces its gears to the end.
    ///
    /// # Errors
    /// As [`SharedModels::solve`].
    pub fn solve_while(
        &self,
        scene: &Scene,
        interest: Interest<'_>,
    ) -> Result<Option<(Scene, StaticHistory)>, AnalysisError> {
        if !(interest.positions)() {
            return Ok(None);
        }
        // Once lost it does not come back: what was left out stays so.
        let lost = AtomicBool::new(false);
        let still = || {
            lost.fetch_or(!(interest.positions)(), Ordering::Relaxed);
            !lost.load(Ordering::Relaxed)
        };
        let given_up = |error: &AnalysisError| match error {
            AnalysisError::Cancelled => true,
            AnalysisError::Sink(_) => lost.load(Ordering::Relaxed),
            _ => false,
        };
        if !shares(scene) {
            return match self.alone(scene, &still) {
                Err(error) if given_up(&error) => Ok(None),
                Err(error) => Err(error),
                Ok((scene, history)) => {
                    static_certificate(&scene, &history.positions).verdict(&scene)?;
                    Ok(still().then_some((scene, history)))
                }
            };
        }
        let solved = self.positions(scene, Rates::default(), Interest { positions: &still, ..interest });
        let (SolvedWithRates { scene, mut history, .. }, base) = match solved {
            Err(error) if given_up(&error) => return Ok(None),
            solved => solved?,
        };
        if lost.load(Ordering::Relaxed) {
            return Ok(None);
        }
        static_certificate(&scene, &history.positions).verdict(&scene)?;
        base.warn(&scene, &mut history)?;
        Ok(Some((scene, history)))
    }

    /// A scene that nothing is shared of.
    fn alone(&self, scene: &Scene, wanted: Wanted<'_>) -> Result<(Scene, StaticHistory), AnalysisError> {
        let analysis = AccurateAnalysis::new(scene).with_cache(&*self.cache).with_shared(self);
        let AccurateResult { scene, result } = analysis.solve_into(&mut NoObserver, &mut WhileWanted(wanted))?;
        Ok((scene, result.history))
    }

    /// Positions of a scene at rest with the derivatives of the loaded pair by some parameters, and the scene as it was solved.
    ///
    /// # Errors
    /// [`AnalysisError`]; that of the certificate among them, and derivatives that are not there.
    pub fn solve_with_rates(&self, scene: &Scene, varied: &[VariedScene]) -> Result<SolvedWithRates, AnalysisError> {
        let asked = Rates { of: varied, of_unloaded: false };
        let (solved, _) = self.positions(scene, asked, Interest::LASTING)?;
        static_certificate(&solved.scene, &solved.history.positions).verdict(&solved.scene)?;
        Ok(solved)
    }

    /// Positions until all are solved, or until they are `wanted` no longer.
    fn positions(
        &self,
        scene: &Scene,
        asked: Rates<'_>,
        interest: Interest<'_>,
    ) -> Result<(SolvedWithRates, Arc<Base>), AnalysisError> {
        let scene = settled_scene(scene, self.meshes.is_some());
        let pair = scene.gear_pair()?;
        refuse(&scene, &pair)?;
        light_load::check(&scene, &pair)?;
        let options = options(&scene, &pair);
        let with = |window| StaticOptions { window, ..options.clone() };
        let last: RefCell<Option<Arc<Base>>> = RefCell::new(None);
        let solved = solve_widening(
            options.window,
            |window| {
                let base = self.base(&scene, &pair, with(window), interest.gears)?;
                let mut model = base.model.modified(pair.clone(), with(window))?;
                last.replace(Some(Arc::clone(&base)));
                let (per_cycle, cycles) = (scene.analysis.positions_per_cycle, scene.analysis.cycles);
                let variations =
                    asked.of.iter().map(|v| v.variation(&scene, &with(window))).collect::<Result<_, _>>()?;
                let all = Sensitivities::new(variations);
                let mut sensitivities = if asked.of_unloaded { all } else { all.of_loaded_pair() };
                let mut rates = Vec::new();
                let history = model.run_while(per_cycle as usize, cycles as usize, |_, _, model| {
                    if asked.of.is_empty() {
                        return if (interest.positions)() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
                    }
                    rates.push(sensitivities.of(model));
                    if rates.last().is_some_and(Result::is_err) {
                        return ControlFlow::Break(());
                    }
                    ControlFlow::Continue(())
                })?;
                Ok((history, rates.into_iter().collect::<Result<Vec<_>, StaticError>>()?, base))
            },
            |window, failure| {
                let (Failure::Static(e), Some(base)) = (failure, &*last.borrow()) else { return None };
                wider_window(&scene, &pair, &base.meshes, &with(window), e)
            },
        );
        let (history, rates, base) = solved.map_err(|failure: Failure| failure.into_error(&scene))?;
        Ok((SolvedWithRates { scene, history, rates }, base))
    }

    /// A model that is there of the same gears, on other slices: more of them are chosen for more crowning.
    fn of_same_gears(&self, kind: &Scene, window: Option<usize>) -> Option<Arc<Base>> {
        let (known, gears) = (self.known.lock().unwrap_or_else(PoisonError::into_inner), of_gears(kind));
        let mut alike = known.iter().filter(|k| k.window == window && of_gears(&k.kind) == gears);
        alike.find_map(|k| k.base.try_lock().ok()?.clone())
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
        let (meshes, model) = match self.of_same_gears(&own, window) {
            Some(other) => (other.meshes.clone(), other.model.modified(pair.clone(), options)?),
            None => {
                let meshes = self.scene_meshes(scene, pair)?;
                let ElasticGears { gears, keys, .. } =
                    elastic_gears(scene, pair, &options, &meshes, (&*self.cache, &NoObserver, wanted))?;
                let model = StaticModel::new(pair.clone(), gears, options)?;
                if self.cache.is_on() {
                    keys.save(&*self.cache, model.gears());
                }
                (meshes, model)
            }
        };
        let base = Arc::new(Base { meshes, model, of_bodies: OnceLock::new() });
        *made = Some(Arc::clone(&base));
        Ok(base)
    }
}

/// Ends an analysis after the first position that is not wanted.
struct WhileWanted<'a>(Wanted<'a>);

impl StaticSink for WhileWanted<'_> {
    fn begin(&mut self, _: &Scene) {}

    fn position(&mut self, _: usize, _: &StaticPosition, _: &StaticModel) -> SinkResult {
        if (self.0)() { Ok(()) } else { Err(Box::new(AnalysisError::Cancelled)) }
    }

    fn finish(&mut self) -> SinkResult {
        Ok(())
    }
}
