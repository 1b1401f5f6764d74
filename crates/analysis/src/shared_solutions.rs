//! Scenes at rest, one after the other, on what they have in common.

use std::{
    cell::RefCell,
    ops::ControlFlow,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use ale::solve_widening;
use fem::Wanted;
use ltca::{Sensitivities, Sensitivity, StaticError, StaticHistory, StaticModel, StaticOptions, StaticPosition};
use scene::Scene;

use crate::{
    AnalysisError, Derivatives, NoObserver, SinkResult, StaticSink,
    accuracy::{AccurateAnalysis, AccurateResult},
    alike::shares,
    failure::Failure,
    gears,
    inputs::settled_scene,
    interest::Interest,
    light_load,
    options::options,
    plausible::refuse,
    resolution::resolution_warnings,
    shared_models::{Base, SharedModels},
    static_certificate,
    varied_scene::VariedScene,
    warnings::{deflection_warnings, jammed_pair},
    window::wider_window,
};

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
pub(crate) struct SolvedWithRates {
    /// The scene as it was solved.
    pub scene: Scene,
    /// Its positions.
    pub history: StaticHistory,
    /// Of each position, by each parameter.
    pub rates: Vec<Vec<Sensitivity>>,
}

impl SharedModels<'_> {
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
        hold(&scene, &history)?;
        Ok((scene, history))
    }

    /// As [`SharedModels::solve`], with the derivatives that the scene asks for in `output.derivatives`; `None` where it asks
    /// for none.
    ///
    /// # Errors
    /// As of [`SharedModels::solve`], and where there are no derivatives.
    pub(crate) fn solve_with_derivatives(
        &self,
        scene: &Scene,
        warnings: WarningsAtRest,
    ) -> Result<(Scene, StaticHistory, Option<Derivatives>), AnalysisError> {
        let keys = scene.output.derivatives.clone();
        if keys.is_empty() {
            let told = match warnings {
                WarningsAtRest::Told => self.solve_while(scene, Interest::LASTING)?,
                WarningsAtRest::Left => None,
            };
            let (scene, history) = told.map_or_else(|| self.solve(scene), Ok)?;
            return Ok((scene, history, None));
        }
        let varied = VariedScene::by_keys(scene, &keys)?;
        let asked = Rates { of: &varied, of_unloaded: true };
        let (SolvedWithRates { scene, mut history, rates }, base) = self.positions(scene, asked, Interest::LASTING)?;
        hold(&scene, &history)?;
        if warnings == WarningsAtRest::Told {
            warn(&base, &scene, &mut history)?;
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
                    hold(&scene, &history)?;
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
        hold(&scene, &history)?;
        warn(&base, &scene, &mut history)?;
        Ok(Some((scene, history)))
    }

    /// A scene that nothing is shared of.
    fn alone(&self, scene: &Scene, wanted: Wanted<'_>) -> Result<(Scene, StaticHistory), AnalysisError> {
        let analysis = AccurateAnalysis::new(scene).with_cache(self.cache()).with_shared(self);
        let AccurateResult { scene, result } = analysis.solve_into(&mut NoObserver, &mut WhileWanted(wanted))?;
        Ok((scene, result.history))
    }

    /// Positions of a scene at rest with the derivatives of the loaded pair by some parameters, and the scene as it was solved.
    ///
    /// # Errors
    /// [`AnalysisError`]; that of the certificate among them, and derivatives that are not there.
    pub(crate) fn solve_with_rates(
        &self,
        scene: &Scene,
        varied: &[VariedScene],
    ) -> Result<SolvedWithRates, AnalysisError> {
        let asked = Rates { of: varied, of_unloaded: false };
        let (solved, _) = self.positions(scene, asked, Interest::LASTING)?;
        hold(&solved.scene, &solved.history)?;
        Ok(solved)
    }

    /// Positions until all are solved, or until they are `wanted` no longer.
    fn positions(
        &self,
        scene: &Scene,
        asked: Rates<'_>,
        interest: Interest<'_>,
    ) -> Result<(SolvedWithRates, Arc<Base>), AnalysisError> {
        let scene = settled_scene(scene, self.meshes().is_some());
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
}

/// Whether positions hold.
///
/// # Errors
/// [`AnalysisError::Certificate`].
fn hold(scene: &Scene, history: &StaticHistory) -> Result<(), AnalysisError> {
    crate::certificate::verdict(&static_certificate(scene, &history.positions), scene)
}

/// Adds what a user should hear of pair, meshes and bodies, as a run by itself says it.
fn warn(base: &Base, scene: &Scene, history: &mut StaticHistory) -> Result<(), AnalysisError> {
    let pair = scene.gear_pair()?;
    history.warnings.extend(gears::warnings(&pair));
    history.warnings.extend(base.meshes.iter().flat_map(|m| m.warnings.clone()));
    let options = options(scene, &pair);
    history.warnings.extend(resolution_warnings(scene, &pair, &options));
    history.warnings.extend(jammed_pair(&history.positions, &pair, &options));
    history.warnings.extend(base.body_warnings().iter().cloned());
    let (module, distance) = (scene.pair.normal_module_mm, pair.centre_distance());
    history.warnings.extend(deflection_warnings(&history.positions, module, distance));
    Ok(())
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
