//! Positions of the loaded pair through its mesh cycles, on its own gears or on shared ones.

use crate::remark;
use answer::Remark;
use std::{ops::ControlFlow, sync::Arc};

use ale::{Station, solve_widening};
use geometry::GearPair;
use ltca::{StaticError, StaticHistory, StaticModel, StaticOptions, ToothChangeRecord};
use reduction::ElasticGear;
use scene::{Model, Scene};

use crate::{
    AnalysisError, GearCache, Observer, PhaseWork, StaticSink,
    elastic_gears::{ElasticGears, RecordKeys, elastic_gears},
    estimated_time::announced_seconds,
    failure::Failure,
    meshes::SceneMesh,
    run_phase,
    shared_models::{Base, SharedModels},
    solved_load::under_loads,
    unless_cancelled,
    window::{foreseen_window, wider_window},
};

/// A scene as it stands with its pair and its meshes.
#[derive(Clone, Copy)]
pub(crate) struct CycleInputs<'a> {
    pub scene: &'a Scene,
    pub cache: &'a dyn GearCache,
    /// Models that scenes share, in place of the cache.
    pub shared: Option<&'a SharedModels<'a>>,
    pub pair: &'a GearPair,
    pub meshes: &'a [SceneMesh; 2],
}

/// Positions of a scene, and the model that they were found with.
pub(crate) struct SolvedStaticCycle {
    pub model: StaticModel,
    pub history: StaticHistory,
    /// What a user should hear of windows that were too narrow.
    pub widened: Vec<Remark>,
}

impl CycleInputs<'_> {
    /// Solves all positions, with wider windows until one is sufficient.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(
        self,
        options: &StaticOptions,
        observer: &mut dyn Observer,
        sink: &mut dyn StaticSink,
    ) -> Result<SolvedStaticCycle, AnalysisError> {
        let Self { scene, pair, meshes, .. } = self;
        let with = |window| StaticOptions { window, ..options.clone() };
        let (foreseen, said) = foreseen_window(scene, pair, meshes, options).unzip();
        let mut widened = Vec::from_iter(said);
        let solved = solve_widening(
            options.window.or(foreseen),
            |window| attempt(self, observer, sink, &with(window)),
            |window, failure| {
                let Failure::Static(e) = failure else { return None };
                let teeth = wider_window(scene, pair, meshes, &with(window), e)?;
                widened.push(remark::window_widened(e.to_string(), teeth));
                Some(teeth)
            },
        );
        let (model, history) = solved.map_err(|failure| failure.into_error(scene))?;
        Ok(SolvedStaticCycle { model, history, widened })
    }
}

/// Reduced gears of this scene, or a model of them that others have used.
enum GearsOf {
    Own(Box<[ElasticGear; 2]>, RecordKeys),
    Shared(Arc<Base>),
}

/// Reduction and run with one width of the window.
fn attempt(
    inputs: CycleInputs<'_>,
    observer: &mut dyn Observer,
    sink: &mut dyn StaticSink,
    options: &StaticOptions,
) -> Result<(StaticModel, StaticHistory), Failure> {
    let CycleInputs { scene, cache, shared, pair, meshes } = inputs;
    let name = if scene.analysis.model == Model::Full { "assemble" } else { "reduce" };
    let work = PhaseWork::Seconds(announced_seconds(observer, (scene.analysis.is_general(), meshes), 1.0));
    let (base, mut remarks) = run_phase(observer, name, work, |progress| match shared {
        Some(models) => {
            models.base(scene, pair, options.clone(), &|| true).map(|base| (GearsOf::Shared(base), Vec::new()))
        }
        None => {
            let ElasticGears { gears, keys, remarks } =
                elastic_gears(scene, pair, options, meshes, (cache, progress, &|| true), true)?;
            Ok((GearsOf::Own(Box::new(gears), keys), remarks))
        }
    })?;
    let (mut model, keys) = run_phase(observer, "contact", PhaseWork::Unknown, |_| match base {
        GearsOf::Shared(base) => Ok((base.model.modified(pair.clone(), options.clone())?, None)),
        GearsOf::Own(gears, keys) => Ok((StaticModel::new(pair.clone(), *gears, options.clone())?, Some(keys))),
    })
    .map_err(|e: StaticError| Failure::Static(e))?;
    if options.root_stress {
        run_phase(observer, "root stress", PhaseWork::Unknown, |_| model.prepare_root_stress())?;
    }
    let per_cycle = scene.analysis.positions_per_cycle as usize;
    let cycles = scene.analysis.cycles as usize;
    sink.begin(scene);
    let mut history = run_phase(observer, "solve", PhaseWork::Steps((per_cycle * cycles) as u64), |progress| {
        let mut refused = None;
        let history = model.run_while(per_cycle, cycles, |index, position, model| {
            progress.tick();
            progress.say(format!("STE {:.3} um", 1e3 * position.transmission_error));
            let taken = sink.position(index, position, model).map_err(AnalysisError::Sink);
            match taken.and_then(|()| unless_cancelled(progress)) {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    refused = Some(error);
                    ControlFlow::Break(())
                }
            }
        });
        match refused {
            Some(error) => Err(error.into()),
            None => history.map_err(Failure::Static),
        }
    })?;
    history.under_loads = under_loads(scene, &model, (&|| true, observer))?;
    sink.finish().map_err(AnalysisError::Sink)?;
    let closing = run_phase(observer, "change", PhaseWork::Unknown, |_| closing_changes(scene, &mut model))?;
    history.tooth_changes.extend(closing);
    if let (Some(keys), true) = (keys, cache.is_on()) {
        // After the run, when every window and half tooth that it took is known.
        remarks.extend(run_phase(observer, "store", PhaseWork::Unknown, |_| keys.save(cache, model.gears())));
    }
    history.remarks.extend(remarks);
    Ok((model, history))
}

/// The tooth changes that close the last mesh cycle of a scene: a window of an odd number of teeth changes where a cycle
/// ends. None of whole gears, which have no window that could slide.
///
/// # Errors
/// [`StaticError`] where a window next to it does not hold the load: the cycle is refused, as by itself so in a plan.
pub(crate) fn closing_changes(scene: &Scene, model: &mut StaticModel) -> Result<Vec<ToothChangeRecord>, StaticError> {
    if model.contact_set().windows().is_none() {
        return Ok(Vec::new());
    }
    model.tooth_changes_at(Station { cycle: i64::from(scene.analysis.cycles), phase: 0.0 })
}
