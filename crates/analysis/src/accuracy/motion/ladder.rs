//! The ladder of a motion: models, meshes and slices of the static pair, steps.

use std::rc::Rc;

use scene::{AccuracyScene, Quantity, Scene, Tolerance};

use super::{
    MotionAnswer, MotionCalibration, MotionModel, MotionSample, MotionTold, PairAtRest, TriedModel,
    estimate::{Seen, not_covered},
    mesh_bound,
};
use crate::{
    AnalysisError, GearCache, NoObserver, NoSink, Observer, StaticResult,
    accuracy::{
        Accuracy, Bound, CalibratedMesh, Calibration, Cause, GearMemo, Rung, StaticAnalysis, climb::Ladder,
        rung::has_own_mesh,
    },
    error::in_scene,
    lumped::static_scene,
    refused::Refusal,
};

/// Steps in a period of the resonance beyond which no more are taken.
const MOST_STEPS: u32 = 128;
/// Share of what is asked that the mesh may take before anything moves.
const MESH_SHARE: f64 = 0.5;

/// How a motion is to be run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Choice {
    model: MotionModel,
    steps: u32,
}

/// The pair at rest on the meshes that the motion is run on.
pub(super) struct Base {
    scene: Scene,
    solved: StaticResult,
    rest: PairAtRest,
    /// Bounds of the peak to peak of the transmission error, um, and of the mean tangent stiffness over itself.
    bounds: [f64; 2],
}

/// A scene on its meshes and slices, and how it is moved.
pub(super) struct MotionRung {
    scene: Scene,
    choice: Choice,
}

/// A motion of a model, beside the pair at rest.
pub(super) struct Moved {
    base: Rc<Base>,
    /// The scene of the model.
    pub scene: Scene,
    pub answer: MotionAnswer,
}

/// A scene in motion on the rungs of the ladder; rows are told as they come, from the beginning at every run.
pub(super) struct MotionLadder<'a, 't> {
    scene: &'a Scene,
    kept: GearMemo<'a>,
    told: &'a mut MotionTold<'t>,
    /// The pair at rest that was solved last.
    base: Option<Rc<Base>>,
}

impl<'a, 't> MotionLadder<'a, 't> {
    /// Ladder of a scene in motion with `[accuracy]`.
    pub fn new(scene: &'a Scene, cache: &'a dyn GearCache, told: &'a mut MotionTold<'t>) -> Self {
        Self { scene, kept: GearMemo::new(cache), told, base: None }
    }

    /// The scene with the meshes and slices that are tried first.
    fn first_scene(&self) -> Scene {
        let mut scene = crate::inputs::resolved_scene(self.scene, false);
        scene.analysis.model = scene::Model::Reduced;
        if self.scene.is_auto() && !has_own_mesh(self.scene) { Rung::ALL[0].scene(&scene) } else { scene }
    }

    /// The pair at rest, with bounds; the last one stays.
    fn at_rest(&mut self, scene: &Scene, observer: &mut dyn Observer) -> Result<Rc<Base>, AnalysisError> {
        if let Some(base) = self.base.as_ref().filter(|base| base.scene == *scene) {
            return Ok(Rc::clone(base));
        }
        let mut still = static_scene(scene);
        let whole = Tolerance::Relative(1.0);
        still.accuracy =
            AccuracyScene::new([(Quantity::PeakToPeakSte, whole), (Quantity::MeshStiffnessTangent, whole)]);
        let solved = StaticAnalysis::new(&still).with_cache(&self.kept).solve_into(observer, &mut NoSink)?;
        let rest = PairAtRest::new(scene, &solved)?;
        let of = |q: Quantity| solved.facts.accuracy.iter().flat_map(|a| &a.bounds).find(|b| b.quantity == q);
        let no_bound = |quantity: Quantity| in_scene(scene)(Refusal::no_bound(quantity));
        let peak = of(Quantity::PeakToPeakSte).ok_or_else(|| no_bound(Quantity::PeakToPeakSte))?;
        let stiffness = of(Quantity::MeshStiffnessTangent).ok_or_else(|| no_bound(Quantity::MeshStiffnessTangent))?;
        let bounds = [peak.largest(), stiffness.largest() / stiffness.value];
        let base = Rc::new(Base { scene: scene.clone(), solved, rest, bounds });
        Ok(Rc::clone(self.base.insert(base)))
    }

    /// Finer meshes or slices where those of the pair at rest are foreseen to take more than their share.
    fn finer_before_it_moves(&self, base: &Base) -> Option<Scene> {
        let over = |(q, tolerance): &(Quantity, Tolerance)| {
            let most = tolerance.of(base.rest.foreseen_um(*q));
            mesh_bound(*q, &base.rest, base.bounds[0], base.bounds[1]) > MESH_SHARE * most
        };
        if self.scene.is_auto() && self.scene.accuracy.tolerances().iter().any(over) {
            self.finer_mesh(base)
        } else {
            None
        }
    }

    /// The pair on a finer mesh, or cut into more slices, whatever its bounds are mostly made of.
    fn finer_mesh(&self, base: &Base) -> Option<Scene> {
        let accuracy = base.solved.facts.accuracy.as_ref()?;
        let peak = accuracy.bounds.iter().find(|b| b.quantity == Quantity::PeakToPeakSte)?;
        let of = |cause: Cause| peak.terms.iter().filter(|t| t.cause == cause).map(|t| t.amount).sum::<f64>();
        let known = (peak.value - peak.corrected).abs();
        let rung = Rung::of(&base.scene).filter(|_| !has_own_mesh(self.scene));
        let finer = rung
            .and_then(Rung::finer)
            .filter(|r| Calibration::committed().knows(CalibratedMesh::Rung(r.elements_profile)));
        let (mesh, slices, positions) = (of(Cause::Mesh) + known, of(Cause::Slices), of(Cause::Positions));
        let mut scene = base.scene.clone();
        if let Some(finer) = finer.filter(|_| mesh >= slices.max(positions)) {
            return Some(finer.scene(&scene));
        }
        if positions > slices && scene.analysis.positions_per_cycle < 128 {
            scene.analysis.positions_per_cycle *= 2;
            return Some(scene);
        }
        if let Some(n) = scene.contact.slices.filter(|n| slices >= 0.2 * mesh && 2 * n <= 768) {
            scene.contact.slices = Some(2 * n);
            return Some(scene);
        }
        finer.map(|finer| finer.scene(&scene))
    }

    /// The cheapest model whose usual bound is within what is asked: of the usual ones, and of that of the mesh, either may
    /// turn out to be less.
    fn first_choice(&self, base: &Base) -> Choice {
        let steps = self.scene.motion.as_ref().map_or(16, |m| m.steps_per_resonance);
        let keeps = |model: &MotionModel| {
            self.scene.accuracy.tolerances().iter().all(|(q, tolerance)| {
                let value = base.rest.foreseen_um(*q);
                let usual = MotionCalibration::committed().of(*q).and_then(|laws| laws.usual(*model, &base.rest));
                usual.is_some_and(|usual| usual * value <= tolerance.of(value))
            })
        };
        let ladder = || MotionModel::ALL.into_iter().filter(|m| m.knows(self.scene));
        let model = MotionModel::of(self.scene).or_else(|| ladder().find(keeps)).unwrap_or(MotionModel::ReducedModes);
        let steps = if self.scene.is_auto() { model.first_steps(steps) } else { steps };
        Choice { model, steps }
    }

    /// Steps in a period of the mesh resonance: those that are asked, or as many as there are rows.
    fn steps_of(&self, base: &Base, choice: Choice) -> f64 {
        let rows = self.scene.motion.as_ref().map_or(0.0, |m| f64::from(m.steps_per_mesh_cycle));
        // The highest mode has a shorter period than the resonance: with as many steps in it there are more.
        let highest = if choice.model == MotionModel::ReducedModes {
            let elastic = base.rest.elastic_hz[0].min(base.rest.elastic_hz[1]);
            (elastic / base.rest.resonance.hz).max(1.0)
        } else {
            1.0
        };
        (rows * base.rest.speed_ratio()).max(f64::from(choice.steps) * highest).max(1.0)
    }

    /// Sample of the motion with half the steps; `None` where rows are the steps.
    fn halved(&self, base: &Base, choice: Choice) -> Result<Option<MotionSample>, AnalysisError> {
        let rows = self.scene.motion.as_ref().map_or(0.0, |m| f64::from(m.steps_per_mesh_cycle));
        let by_rows = rows * base.rest.speed_ratio() >= f64::from(choice.steps);
        if choice.steps < 2 || (by_rows && choice.model != MotionModel::ReducedModes) {
            return Ok(None);
        }
        let scene = choice.model.scene(&base.scene, &base.rest, choice.steps / 2);
        Ok(Some(MotionAnswer::quietly(&scene, &self.kept, &mut NoObserver)?.sample()))
    }

    /// What is taken after a run whose bounds are not kept, and why it is left: a finer mesh, a dearer model, or more
    /// steps; `None` where all is kept, or nothing finer is left.
    fn next(
        &self,
        base: &Base,
        choice: Choice,
        own: MotionSample,
        accuracy: &Accuracy,
    ) -> Option<(MotionRung, String)> {
        let dearer = choice.model.finer().map(|model| Choice { model, steps: model.first_steps(choice.steps) });
        let with = |choice: Choice| MotionRung { scene: base.scene.clone(), choice };
        if choice.model == MotionModel::Lumped12 && own.least_force <= 0.0 {
            return Some((with(dearer?), "its flanks lose contact, which a linear mesh does not know".into()));
        }
        let worst = accuracy.worst()?;
        let model = worst.by(Cause::Model) + worst.by(Cause::QuasiStaticElasticity);
        let (mesh, step) = (worst.by(Cause::Mesh), worst.by(Cause::Step));
        let by_model = || dearer.map(with);
        let by_mesh = || self.finer_mesh(base).map(|scene| MotionRung { scene, choice });
        let steps = 2 * choice.steps;
        let by_step = || (steps <= MOST_STEPS).then(|| with(Choice { steps, ..choice }));
        let mut ways: [(f64, &dyn Fn() -> Option<MotionRung>); 3] =
            [(model, &by_model), (mesh, &by_mesh), (step, &by_step)];
        ways.sort_by(|a, b| b.0.total_cmp(&a.0));
        Some((ways.iter().find_map(|(_, way)| way())?, worst.shortfall()))
    }

    fn accuracy(&self, base: &Base, seen: &Seen<'_>, bounds: Vec<Bound>) -> Result<Accuracy, AnalysisError> {
        let calibration = MotionCalibration::committed();
        let asked = self.scene.accuracy.tolerances().iter().map(|(quantity, _)| *quantity);
        if let Some(missing) = asked.into_iter().find(|q| bounds.iter().all(|b| b.quantity != *q)) {
            return Err(in_scene(self.scene)(Refusal::no_bound(missing)));
        }
        let still = base.solved.facts.accuracy.as_ref();
        let mut all = not_covered(seen, self.scene);
        all.extend(still.iter().flat_map(|a| a.not_covered.iter().cloned()));
        let meshes = still.map_or("", |a| a.held_against.as_str());
        Ok(Accuracy {
            coverage: calibration.coverage,
            calibrated_on_pairs: calibration.pairs,
            held_against: format!("half the steps; the pair at rest against {meshes}"),
            bounds,
            not_covered: all,
            ..Accuracy::default()
        })
    }
}

impl Ladder for MotionLadder<'_, '_> {
    type Rung = MotionRung;
    type Solved = Moved;
    type Tried = TriedModel;
    const TRIES: usize = 12;

    fn chooses(&self) -> bool {
        self.scene.is_auto()
    }

    fn first(&mut self, observer: &mut dyn Observer) -> Result<MotionRung, AnalysisError> {
        let mut base = self.at_rest(&self.first_scene(), observer)?;
        while let Some(finer) = self.finer_before_it_moves(&base) {
            base = self.at_rest(&finer, observer)?;
        }
        Ok(MotionRung { scene: base.scene.clone(), choice: self.first_choice(&base) })
    }

    fn solve(&mut self, rung: &MotionRung, observer: &mut dyn Observer) -> Result<Moved, AnalysisError> {
        let base = self.at_rest(&rung.scene, observer)?;
        let MotionRung { choice, .. } = rung;
        let scene = choice.model.scene(&base.scene, &base.rest, choice.steps);
        let answer = MotionAnswer::of(&scene, &self.kept, observer, self.told)?;
        Ok(Moved { base, scene, answer })
    }

    fn bound(&mut self, rung: &MotionRung, moved: &Moved, _: &mut dyn Observer) -> Result<Accuracy, AnalysisError> {
        let (base, choice) = (&moved.base, rung.choice);
        let seen = Seen {
            model: choice.model,
            rest: &base.rest,
            at_rest: base.bounds,
            own: moved.answer.sample(),
            steps: self.steps_of(base, choice),
            halved: self.halved(base, choice)?,
            elastic_share: moved.answer.elastic_share().unwrap_or_else(|| base.rest.elastic_share()),
        };
        self.accuracy(base, &seen, seen.bounds(self.scene))
    }

    fn refine(&mut self, rung: &MotionRung, moved: &Moved, accuracy: &Accuracy) -> Option<(MotionRung, String)> {
        self.next(&moved.base, rung.choice, moved.answer.sample(), accuracy)
    }

    fn note(&self, rung: &MotionRung, why: &str) -> String {
        format!("{} is left: {why}", rung.choice.model.name())
    }

    fn tried(&self, rung: &MotionRung, left_because: Option<String>) -> TriedModel {
        TriedModel {
            model: rung.choice.model,
            elements_profile: Rung::of(&rung.scene).map(|r| r.elements_profile),
            slices: rung.scene.contact.slices,
            steps_per_resonance: rung.choice.steps,
            left_because,
        }
    }
}
