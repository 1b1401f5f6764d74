//! A motion with bounds, by the cheapest model that keeps what is asked.

use scene::{AccuracyScene, Method, Quantity, Run, Scene, Tolerance};

use super::{
    MotionAnswer, MotionCalibration, MotionModel, MotionSample, MotionTold, PairAtRest, TriedModel,
    estimate::{Seen, not_covered},
    mesh_bound,
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, NoSink, Observer, StaticResult,
    accuracy::{Accuracy, Bound, CalibratedMesh, Calibration, Cause, KeptGears, Rung, StaticAnalysis},
    error::in_scene,
    facts::Facts,
    lumped::{NoLumpedSink, static_scene},
    motion::NoMotionSink,
    refused::Refusal,
};

/// The answer to a scene in motion, with bounds.
#[derive(Debug)]
pub struct AccurateMotionResult {
    /// The scene as it was solved: of `model = "auto"` with the model, mesh, slices and steps that were taken.
    pub scene: Scene,
    /// Its rows and facts, [`Facts::accuracy`] among them.
    pub answer: MotionAnswer,
}

/// A scene in motion that is to be solved with bounds.
///
/// Of `model = "auto"` the cheapest of `lumped12`, `reduced` and `reduced+modes` is taken that keeps what `[accuracy]`
/// asks; of "reduced" and "reduced+modes" the bounds of the run are estimated.
#[derive(Clone, Copy)]
pub struct AccurateMotion<'a> {
    scene: &'a Scene,
    cache: &'a dyn GearCache,
}

/// What is tried next, and why: another mesh where there is one, the model and its steps.
type Next = (Option<Scene>, Choice, String);

impl std::fmt::Debug for AccurateMotion<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("AccurateMotion").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

/// Steps in a period of the resonance beyond which no more are taken.
const MOST_STEPS: u32 = 128;
/// Share of what is asked that the mesh may take before anything moves.
const MESH_SHARE: f64 = 0.5;
/// Runs at the most.
const TRIES: usize = 12;

/// How a motion is to be run.
#[derive(Debug, Clone, Copy)]
struct Choice {
    model: MotionModel,
    steps: u32,
}

/// The pair at rest on the meshes that the motion is run on.
struct Base {
    scene: Scene,
    solved: StaticResult,
    rest: PairAtRest,
    /// Bounds of the peak to peak of the transmission error, um, and of the mean tangent stiffness over itself.
    bounds: [f64; 2],
}

impl<'a> AccurateMotion<'a> {
    /// Of a scene in motion with `[accuracy]`.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, cache: &NoCache }
    }

    /// With reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Solves it, telling nobody.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(&self) -> Result<AccurateMotionResult, AnalysisError> {
        let mut told = MotionTold { motion: &mut NoMotionSink, lumped: &mut NoLumpedSink };
        self.solve_into(&mut NoObserver, &mut told)
    }

    /// Solves it; rows are told as they come, from the beginning at every run.
    ///
    /// What cannot be kept by the finest is an answer all the same: [`Accuracy::is_met`] says so.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        &self,
        observer: &mut dyn Observer,
        told: &mut MotionTold<'_>,
    ) -> Result<AccurateMotionResult, AnalysisError> {
        self.possible()?;
        let kept = KeptGears::new(self.cache);
        let mut base = self.base(self.first_scene(), &kept, observer)?;
        while let Some(finer) = self.finer_before_it_moves(&base) {
            base = self.base(finer, &kept, observer)?;
        }
        let mut choice = self.first_choice(&base);
        let mut tried: Vec<TriedModel> = Vec::new();
        loop {
            let mut scene = choice.model.scene(&base.scene, &base.rest, choice.steps);
            let mut answer = MotionAnswer::of(&scene, &kept, observer, told)?;
            let own = answer.sample();
            let halved = self.halved(&base, choice, &kept)?;
            let seen = Seen {
                model: choice.model,
                rest: &base.rest,
                at_rest: base.bounds,
                own,
                steps: self.steps_of(&base, choice),
                halved,
                elastic_share: answer.elastic_share().unwrap_or_else(|| base.rest.elastic_share()),
            };
            let bounds = seen.bounds(self.scene);
            let goes_on = self.scene.is_auto() && tried.len() + 1 < TRIES;
            let next = if goes_on { self.next(&base, choice, own, &bounds) } else { None };
            if self.scene.is_auto() {
                tried.push(TriedModel {
                    model: choice.model,
                    elements_profile: Rung::of(&base.scene).map(|r| r.elements_profile),
                    slices: base.scene.contact.slices,
                    steps_per_resonance: choice.steps,
                    left_because: next.as_ref().map(|(_, _, why)| why.clone()),
                });
            }
            let Some((finer, further, why)) = next else {
                let accuracy = self.accuracy(&base, &seen, bounds, tried)?;
                answer.facts_mut().accuracy = Some(accuracy);
                scene.accuracy = self.scene.accuracy.clone();
                return Ok(AccurateMotionResult { scene, answer });
            };
            observer.note(format!("{} is left: {why}", choice.model.name()));
            if let Some(finer) = finer {
                base = self.base(finer, &kept, observer)?;
            }
            choice = further;
        }
    }

    /// What scenes that come from no file may ask, and there are no bounds of.
    fn possible(&self) -> Result<(), AnalysisError> {
        let steady = self.scene.motion.as_ref().is_some_and(|m| m.run == Run::Steady && m.error_tolerance.is_none());
        let known = self.scene.is_auto() || MotionModel::of(self.scene).is_some();
        if steady && known && self.scene.contact.method == Method::Slice {
            return Ok(());
        }
        Err(crate::error::unasked(self.scene, "steady motion of reduced gears with bounds"))
    }

    /// The scene with the meshes and slices that are tried first.
    fn first_scene(&self) -> Scene {
        let mut scene = crate::inputs::settled_scene(self.scene, false);
        scene.analysis.model = scene::Model::Reduced;
        if self.scene.is_auto() && !has_own_mesh(self.scene) { Rung::ALL[0].scene(&scene) } else { scene }
    }

    /// The pair at rest, with bounds.
    fn base(&self, scene: Scene, kept: &KeptGears<'_>, observer: &mut dyn Observer) -> Result<Base, AnalysisError> {
        let mut still = static_scene(&scene);
        let whole = Tolerance::Relative(1.0);
        still.accuracy =
            AccuracyScene::new([(Quantity::PeakToPeakSte, whole), (Quantity::MeshStiffnessTangent, whole)]);
        let solved = StaticAnalysis::new(&still).with_cache(kept).solve_into(observer, &mut NoSink)?;
        let rest = PairAtRest::new(&scene, &solved)?;
        let of = |q: Quantity| solved.facts.accuracy.iter().flat_map(|a| &a.bounds).find(|b| b.quantity == q);
        let no_bound = |quantity: Quantity| in_scene(&scene)(Refusal::no_bound(quantity));
        let peak = of(Quantity::PeakToPeakSte).ok_or_else(|| no_bound(Quantity::PeakToPeakSte))?;
        let stiffness = of(Quantity::MeshStiffnessTangent).ok_or_else(|| no_bound(Quantity::MeshStiffnessTangent))?;
        let bounds = [peak.largest(), stiffness.largest() / stiffness.value];
        Ok(Base { scene, solved, rest, bounds })
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

    /// The same with half the steps; `None` where rows are the steps.
    fn halved(&self, base: &Base, choice: Choice, kept: &KeptGears<'_>) -> Result<Option<MotionSample>, AnalysisError> {
        let rows = self.scene.motion.as_ref().map_or(0.0, |m| f64::from(m.steps_per_mesh_cycle));
        let by_rows = rows * base.rest.speed_ratio() >= f64::from(choice.steps);
        if choice.steps < 2 || (by_rows && choice.model != MotionModel::ReducedModes) {
            return Ok(None);
        }
        let scene = choice.model.scene(&base.scene, &base.rest, choice.steps / 2);
        Ok(Some(MotionAnswer::quietly(&scene, kept, &mut NoObserver)?.sample()))
    }

    /// What is taken after a run whose bounds are not kept, and why it is left: a finer mesh, a dearer model, or more
    /// steps; `None` where all is kept, or nothing finer is left.
    fn next(&self, base: &Base, choice: Choice, own: MotionSample, bounds: &[Bound]) -> Option<Next> {
        let dearer = choice.model.finer().map(|model| Choice { model, steps: model.first_steps(choice.steps) });
        if choice.model == MotionModel::Lumped12 && own.least_force <= 0.0 {
            return Some((None, dearer?, "its flanks part, which a linear mesh does not know".into()));
        }
        let over = |b: &&Bound| b.largest() / b.asked.unwrap_or(f64::INFINITY);
        let worst = bounds.iter().filter(|b| b.met == Some(false)).max_by(|a, b| over(a).total_cmp(&over(b)))?;
        let of = |cause: Cause| {
            let own = worst.terms.iter().filter(|t| t.cause == cause);
            own.map(|t| t.known.abs() + t.amount).sum::<f64>()
        };
        let model = of(Cause::Model) + of(Cause::QuasiStaticElasticity);
        let (mesh, step) = (of(Cause::Mesh), of(Cause::Step));
        let why = format!(
            "{} is known to {:.2e} {}, {:.2e} is asked",
            worst.quantity.key(),
            worst.largest(),
            worst.unit,
            worst.asked.unwrap_or(f64::NAN)
        );
        let by_model = || dearer.map(|choice| (None, choice, why.clone()));
        let by_mesh = || self.finer_mesh(base).map(|finer| (Some(finer), choice, why.clone()));
        let steps = 2 * choice.steps;
        let by_step = || (steps <= MOST_STEPS).then(|| (None, Choice { steps, ..choice }, why.clone()));
        let mut ways: [(f64, &dyn Fn() -> Option<Next>); 3] = [(model, &by_model), (mesh, &by_mesh), (step, &by_step)];
        ways.sort_by(|a, b| b.0.total_cmp(&a.0));
        ways.iter().find_map(|(_, way)| way())
    }

    fn accuracy(
        &self,
        base: &Base,
        seen: &Seen<'_>,
        bounds: Vec<Bound>,
        models: Vec<TriedModel>,
    ) -> Result<Accuracy, AnalysisError> {
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
            rungs: Vec::new(),
            models,
            not_covered: all,
        })
    }
}

impl MotionAnswer {
    /// Facts of the run.
    pub fn facts(&self) -> &Facts {
        match self {
            Self::Lumped(result) => &result.facts,
            Self::Reduced(result) => &result.facts,
        }
    }

    fn facts_mut(&mut self) -> &mut Facts {
        match self {
            Self::Lumped(result) => &mut result.facts,
            Self::Reduced(result) => &mut result.facts,
        }
    }

    /// Share of the peak to peak that elastic inertia may change, of a model that knows.
    fn elastic_share(&self) -> Option<f64> {
        match self {
            Self::Lumped(_) => None,
            Self::Reduced(result) => Some(result.headline.elasticity.change_over_peak_to_peak),
        }
    }
}

/// Whether the scene brings a mesh that no rung replaces.
fn has_own_mesh(scene: &Scene) -> bool {
    scene.gears().iter().any(|g| g.mesh.is_some())
}
