//! The loaded pair of a static scene through its mesh cycles.

use std::sync::Arc;

use answer::keyed;
use geometry::GearPair;
use ltca::{StaticHistory, StaticModel};
use mesh::Mesh;
use reduction::GearReducer;
use scene::{Model, Scene};
use serde::Serialize;

use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, NoSink, Observer, PhaseWork, StaticSink,
    facts::RunInfo,
    gear_dofs::{dof_after, free_dofs, reduced},
    gears,
    inputs::{meshes_of, resolved_scene},
    iso_model, iso_root, light_load,
    loaded_pair::LoadedPair,
    meshes::SceneMesh,
    options::options,
    pair_rating,
    plausible::{self, refuse},
    resolution::resolution,
    run_phase,
    shared_models::SharedModels,
    solution_remarks::{body_remarks, bore_remarks, deflection_remarks, jammed_pair},
    static_cycle::{CycleInputs, SolvedStaticCycle},
};

/// Result of a static scene.
#[derive(Debug)]
pub struct StaticResult {
    /// The scene; for `model = "auto"` with the chosen model, mesh, slices and positions.
    pub scene: Scene,
    /// The nominal gear pair.
    pub pair: GearPair,
    /// Results position by position, with remarks.
    pub history: StaticHistory,
    /// Facts about the model and its meshes.
    pub facts: RunInfo,
    /// The model with its reduced gears, for further solutions; `None` for a model without meshes.
    pub model: Option<StaticModel>,
}

/// One run of a scene at rest, without bounds: what `StaticAnalysis` is made of.
#[derive(Clone, Copy)]
pub(crate) struct CycleAnalysis<'a> {
    scene: &'a Scene,
    meshes: Option<[&'a Mesh; 2]>,
    cache: &'a dyn GearCache,
    shared: Option<&'a SharedModels<'a>>,
    slices_stand: bool,
    tells_facts: bool,
}

impl std::fmt::Debug for CycleAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("CycleAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

impl<'a> CycleAnalysis<'a> {
    /// Analysis of a scene, with its meshes read or generated as it says.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, meshes: None, cache: &NoCache, shared: None, slices_stand: false, tells_facts: true }
    }

    /// Uses meshes of pinion and wheel from the caller instead of those of the scene.
    #[must_use]
    pub fn with_meshes(self, meshes: Option<[&'a Mesh; 2]>) -> Self {
        Self { meshes, ..self }
    }

    /// Uses reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Shares meshes, reduced gears and contact tables with earlier and later scenes of its kind. No bit of the result
    /// changes. Models without reduced gears share nothing.
    #[must_use]
    pub fn with_shared(self, models: &'a SharedModels<'a>) -> Self {
        Self { shared: Some(models), ..self }
    }

    /// With the number of slices that the scene has, though no file states it, and without bounds: a point of a chart, a
    /// rung of the ladder.
    #[must_use]
    pub(crate) fn with_slices_of_scene(self) -> Self {
        Self { slices_stand: true, ..self }
    }

    /// Only positions and remarks. For a model in closed form, facts that only the files need are not computed, because
    /// they take longer than its positions.
    #[must_use]
    pub fn without_facts(self) -> Self {
        Self { tells_facts: false, ..self }
    }

    /// Number of slices over the face width; `None` for a model without slices.
    pub fn slices(&self) -> Option<u32> {
        self.settled().contact.slices
    }

    /// Whether the caller holds meshes in place of those of the scene.
    fn has_meshes(&self) -> bool {
        self.meshes.is_some() || self.shared.is_some_and(|models| models.meshes().is_some())
    }

    /// The scene as it is solved.
    fn settled(&self) -> Scene {
        if self.slices_stand { self.scene.clone() } else { resolved_scene(self.scene, self.has_meshes()) }
    }

    /// Solves it without progress reports.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(&self) -> Result<StaticResult, AnalysisError> {
        self.solve_into(&mut NoObserver, &mut NoSink)
    }

    /// Solves it; positions are passed to `sink` as they are solved.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        &self,
        observer: &mut dyn Observer,
        sink: &mut dyn StaticSink,
    ) -> Result<StaticResult, AnalysisError> {
        let (scene, cache) = (&self.settled(), self.cache);
        let pair = run_phase(observer, "geometry", PhaseWork::Unknown, |_| scene.gear_pair())?;
        refuse(scene, &pair)?;
        pair_rating::check(scene, &pair)?;
        if scene.analysis.model != Model::Iso {
            light_load::check(scene, &pair)?;
        }
        let unlikely = plausible::remarks(scene, &pair);
        if !self.slices_stand {
            unlikely.iter().for_each(|said| observer.note(said.to_string()));
        }
        if scene.analysis.model == Model::Iso {
            let solved = run_phase(observer, "solve", PhaseWork::Unknown, |_| iso_model::solve(scene, &pair));
            let (mut history, facts) = solved?;
            history.remarks.extend(gears::remarks(&pair));
            history.remarks.extend(unlikely);
            history.remarks.extend(pair_rating::remarks(scene, &history));
            let facts = if self.tells_facts { facts.of_run(scene, &pair) } else { RunInfo::default() };
            return Ok(StaticResult { scene: self.scene.clone(), pair, history, facts, model: None });
        }
        let shared = self.shared.filter(|_| scene.analysis.model == Model::Reduced);
        let own = self.meshes.or(self.shared.and_then(|models| models.meshes()));
        let meshes = run_phase(observer, "mesh", PhaseWork::Unknown, |_| match shared {
            Some(models) => models.scene_meshes(scene, &pair),
            None => meshes_of(scene, &pair, own, cache).map(Arc::new),
        })?;
        let mut remarks = gears::remarks(&pair);
        remarks.extend(unlikely);
        remarks.extend(meshes.iter().flat_map(|m| m.remarks.clone()));
        let options = options(scene, &pair);
        let (resolution, said) = resolution(scene, &pair, &options);
        remarks.extend(said);
        let inputs = CycleInputs { scene, cache, shared, pair: &pair, meshes: &meshes };
        let SolvedStaticCycle { model, mut history, widened } = inputs.solve(&options, observer, sink)?;
        remarks.extend(widened);
        let mut facts = facts_of(scene, &model, &meshes);
        facts.resolution = Some(resolution);
        if scene.output.root_stress {
            remarks.extend(iso_root::remark(&LoadedPair::of(scene, &pair)));
        }
        remarks.extend(body_remarks(&model));
        remarks.extend(bore_remarks(&model, &meshes, &history.positions));
        remarks.extend(deflection_remarks(&history.positions, scene.pair.normal_module_mm, pair.centre_distance()));
        remarks.extend(jammed_pair(&history.positions, &pair, &options));
        remarks.extend(pair_rating::remarks(scene, &history));
        history.remarks.extend(remarks);
        Ok(StaticResult { scene: self.scene.clone(), pair, history, facts, model: Some(model) })
    }
}

described::described! {
    /// Facts that only a model with meshes has.
    #[derive(Debug, Serialize)]
    pub(crate) struct ReducedFacts {
        /// whether both gears have the same matrices in every window
        cyclic_gears: bool,
        /// gears that came from the [cache](cache.md)
        gears_from_cache: usize,
    }
}

/// What the summary says of a solved model.
fn facts_of(scene: &Scene, model: &StaticModel, meshes: &[SceneMesh; 2]) -> RunInfo {
    let dof_before = [0, 1].map(|i| free_dofs(&model.gears()[i]));
    let mut facts = RunInfo {
        meshes: meshes.iter().map(|m| m.facts.clone()).collect(),
        dof_before,
        dof_after: dof_after(model, dof_before),
        window_teeth: Some(model.window().count() as u32),
        contact_points: Some(model.contact_set().candidate_count()),
        ..RunInfo::of_pair(scene, model.pair())
    };
    let cyclic = model.gears().iter().all(|g| reduced(g).is_some_and(GearReducer::is_cyclic));
    let stored = model.gears().iter().filter(|g| reduced(g).is_some_and(GearReducer::is_from_record)).count();
    facts.model = keyed(&ReducedFacts { cyclic_gears: cyclic, gears_from_cache: stored });
    facts.reduction = model.gears().iter().filter_map(|g| Some(reduced(g)?.way().name())).collect();
    facts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a caller within this crate has settled is not chosen anew: the reference of a chart has twice the slices.
    #[test]
    fn slices_that_stand_are_not_chosen_anew() {
        let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0);
        let mut scene = base.torque_nm(300.0).build().unwrap();
        let chosen = CycleAnalysis::new(&scene).settled().contact.slices.unwrap();
        scene.contact.slices = Some(2 * chosen);
        assert_eq!(CycleAnalysis::new(&scene).with_slices_of_scene().settled().contact.slices, Some(2 * chosen));
    }

    /// A scene built in code gets the slices that its width asks for, as one from a file does; a stated number stays.
    #[test]
    fn slices_follow_the_width_of_a_scene_built_in_code() {
        let wide = || {
            let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0);
            base.face_width_mm(120.0).torque_nm(300.0).set("pinion.modification.drive.lead_crowning_um", 30.0)
        };
        let slices = |scene: Scene| resolved_scene(&scene, false).contact.slices;
        let chosen = slices(wide().build().unwrap());
        assert!(chosen.is_some_and(|n| n > 32), "b/m_n = 40 with 30 um of crowning: {chosen:?} slices");
        assert_eq!(slices(wide().set("contact.slices", 32).build().unwrap()), Some(32), "stated");
        let mut by_hand = wide().build().unwrap();
        by_hand.contact.slices = Some(12);
        assert_eq!(slices(by_hand), Some(12), "set in code");
    }
}
