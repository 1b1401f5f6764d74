//! Solves successive static scenes with shared data.

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
    AnalysisError, NoObserver, SinkResult, StaticResult, StaticSink,
    accuracy::StaticAnalysis,
    alike::shares,
    failure::Failure,
    gears,
    interest::Interest,
    light_load,
    options::options,
    plausible::refuse,
    resolution::resolution_remarks,
    shared_models::{Base, SharedModels},
    solution_remarks::{deflection_remarks, jammed_pair},
    solved_load::under_loads,
    static_certificate,
    static_cycle::closing_changes,
    varied_scene::VariedScene,
    window::{foreseen_window, wider_window},
};

/// Whether remarks about the pair, meshes and bodies of a static scene are collected, which takes a twentieth of the
/// time of a quick case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RemarksAtRest {
    /// The history has all remarks of a separate run.
    Collected,
    /// The history has only the remarks of its own positions.
    Skipped,
}

/// Derivatives that are asked for beside the positions: by which parameters, of the unloaded pair too or not.
#[derive(Clone, Copy, Default)]
pub(crate) struct Rates<'a> {
    pub of: &'a [VariedScene],
    pub of_unloaded: bool,
}

/// Request for a static scene.
#[derive(Clone, Copy, Debug)]
pub struct RestRequest<'a> {
    /// Whether remarks about pair, meshes and bodies are collected.
    pub remarks: RemarksAtRest,
    /// Whether positions have the lengths of their contact lines under load; otherwise they are NaN. A scene that
    /// shares nothing always has them.
    pub line_lengths: bool,
    /// Whether the result is still wanted; if not, the solution ends with [`AnalysisError::Cancelled`]. A scene that
    /// shares nothing reduces its gears to the end.
    pub interest: Interest<'a>,
}

impl RestRequest<'static> {
    /// Request for a complete result with these remarks.
    pub const fn to_the_end(remarks: RemarksAtRest) -> Self {
        Self { remarks, line_lengths: true, interest: Interest::LASTING }
    }

    /// The request without the lengths of contact lines under load.
    #[must_use]
    pub const fn without_line_lengths(self) -> Self {
        Self { line_lengths: false, ..self }
    }
}

/// Positions and their derivatives.
#[derive(Debug, Clone)]
pub(crate) struct SolvedWithRates {
    /// The scene as it was solved.
    pub scene: Scene,
    /// Positions of the solution.
    pub history: StaticHistory,
    /// Derivatives of each position, by each parameter.
    pub rates: Vec<Vec<Sensitivity>>,
}

impl SharedModels<'_> {
    /// Positions of a scene at rest that hold, with the derivatives that are asked for, and the scene as it was solved.
    ///
    /// # Errors
    /// [`AnalysisError`]; that of the certificate among them, derivatives that are not there, and
    /// [`AnalysisError::Cancelled`] where interest was lost.
    pub(crate) fn solve(
        &self,
        scene: &Scene,
        rates: Rates<'_>,
        request: RestRequest<'_>,
    ) -> Result<SolvedWithRates, AnalysisError> {
        let interest = request.interest;
        // Once lost it does not come back: what was left out stays so.
        let lost = AtomicBool::new(false);
        let still = || {
            lost.fetch_or(!(interest.positions)(), Ordering::Relaxed);
            !lost.load(Ordering::Relaxed)
        };
        let unless_lost = || if still() { Ok(()) } else { Err(AnalysisError::Cancelled) };
        unless_lost()?;
        if rates.of.is_empty() && !shares(scene) {
            let (scene, history) = self.alone(scene, &still).map_err(|error| match error {
                AnalysisError::Sink(_) if lost.load(Ordering::Relaxed) => AnalysisError::Cancelled,
                error => error,
            })?;
            hold(&scene, &history)?;
            unless_lost()?;
            return Ok(SolvedWithRates { scene, history, rates: Vec::new() });
        }
        let wanted = RestRequest { interest: Interest { positions: &still, ..interest }, ..request };
        let (mut solved, base) = self.positions(scene, rates, wanted)?;
        if lost.load(Ordering::Relaxed) {
            return Err(AnalysisError::Cancelled);
        }
        hold(&solved.scene, &solved.history)?;
        if request.remarks == RemarksAtRest::Collected {
            warn(&base, &solved.scene, &mut solved.history)?;
        }
        Ok(solved)
    }

    /// A scene that nothing is shared of.
    fn alone(&self, scene: &Scene, wanted: Wanted<'_>) -> Result<(Scene, StaticHistory), AnalysisError> {
        let analysis = StaticAnalysis::new(scene).with_cache(self.cache()).with_shared(self).without_facts();
        let StaticResult { scene, history, .. } = analysis.solve_into(&mut NoObserver, &mut WhileWanted(wanted))?;
        Ok((scene, history))
    }

    /// Positions until all are solved, or until they are `wanted` no longer.
    fn positions(
        &self,
        scene: &Scene,
        asked: Rates<'_>,
        RestRequest { interest, line_lengths, .. }: RestRequest<'_>,
    ) -> Result<(SolvedWithRates, Arc<Base>), AnalysisError> {
        let scene = self.resolved_scene(scene);
        let pair = scene.gear_pair()?;
        refuse(&scene, &pair)?;
        light_load::check(&scene, &pair)?;
        let options = StaticOptions { line_lengths, ..options(&scene, &pair) };
        let with = |window| StaticOptions { window, ..options.clone() };
        let last: RefCell<Option<Arc<Base>>> = RefCell::new(None);
        let meshes = self.scene_meshes(&scene, &pair)?;
        let foreseen = foreseen_window(&scene, &pair, &meshes, &options).map(|(teeth, _)| teeth);
        let solved = solve_widening(
            options.window.or(foreseen),
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
                let mut history = model.run_while(per_cycle as usize, cycles as usize, |_, _, model| {
                    if asked.of.is_empty() {
                        return if (interest.positions)() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
                    }
                    rates.push(sensitivities.of(model));
                    if rates.last().is_some_and(Result::is_err) {
                        return ControlFlow::Break(());
                    }
                    ControlFlow::Continue(())
                })?;
                if (interest.positions)() {
                    history.under_loads = under_loads(&scene, &model, (interest.positions, &mut NoObserver))?;
                    history.tooth_changes.extend(closing_changes(&scene, &mut model)?);
                }
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
    history.remarks.extend(gears::remarks(&pair));
    history.remarks.extend(base.meshes.iter().flat_map(|m| m.remarks.clone()));
    let options = options(scene, &pair);
    history.remarks.extend(resolution_remarks(scene, &pair, &options));
    history.remarks.extend(jammed_pair(&history.positions, &pair, &options));
    history.remarks.extend(base.body_remarks().iter().cloned());
    let (module, distance) = (scene.pair.normal_module_mm, pair.centre_distance().abs());
    history.remarks.extend(deflection_remarks(&history.positions, module, distance));
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
