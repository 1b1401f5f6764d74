//! A scene at rest with bounds, by the cheapest rung of the ladder that keeps what is asked.

use geometry::GearPair;
use mesh::Mesh;
use scene::{Model, Quantity, Scene, Tolerance};

use super::{
    Accuracy, Bound, CalibratedMesh, Calibration, Cause, Features, Rung, Sample, TriedRung,
    companion::Companions,
    estimate::{estimate, free_estimate},
    features,
    features::features_before,
    goes_with_deflection,
    kept_gears::KeptGears,
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, NoSink, Observer, SharedModels, StaticResult, StaticSink,
    error::in_scene, refused::Refusal, statics::CycleAnalysis,
};

/// A scene at rest that is to be solved with bounds.
///
/// Of `model = "auto"` the cheapest rung of the ladder is taken that keeps what `[accuracy]` asks: the first guess comes
/// from the calibration, the proof from the estimate of the run; where that falls short, what it is mostly made of is
/// refined. Of any other model the bounds of the run are estimated; of a scene that asks for no accuracy, none are.
#[derive(Clone, Copy)]
pub struct StaticAnalysis<'a> {
    scene: &'a Scene,
    meshes: Option<[&'a Mesh; 2]>,
    cache: &'a dyn GearCache,
    shared: Option<&'a SharedModels<'a>>,
}

impl std::fmt::Debug for StaticAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("StaticAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

/// Positions of a cycle that the ladder begins with, at least, and ends with.
const POSITIONS: [u32; 2] = [8, 256];
/// Share of what is asked that a guess leaves to the mesh.
const MESH_SHARE: f64 = 0.95;
/// Slices beyond which no more are taken.
const MOST_SLICES: u32 = 768;
/// Rungs that are tried, at most: each is twice as fine in something as one before.
const TRIES: usize = 16;

impl<'a> StaticAnalysis<'a> {
    /// Of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, meshes: None, cache: &NoCache, shared: None }
    }

    /// With meshes of pinion and wheel that the caller holds, in place of those of the scene. They are checked as files
    /// are, and have no bounds.
    #[must_use]
    pub fn with_meshes(self, meshes: [&'a Mesh; 2]) -> Self {
        Self { meshes: Some(meshes), ..self }
    }

    /// Slices over the face width that it takes; `None` for a model without slices.
    pub fn slices(&self) -> Option<u32> {
        CycleAnalysis::new(self.scene).slices()
    }

    /// With reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// On what earlier scenes of its kind have left, as [`SharedModels`] says; rungs of a ladder, whose meshes
    /// differ, share nothing.
    #[must_use]
    pub fn with_shared(self, models: &'a SharedModels<'a>) -> Self {
        Self { shared: Some(models), ..self }
    }

    /// Solves it, telling nobody.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(&self) -> Result<StaticResult, AnalysisError> {
        self.solve_into(&mut NoObserver, &mut NoSink)
    }

    /// Solves it; positions go into `sink` as they come, from the beginning at every rung.
    ///
    /// What cannot be kept on the finest rung is an answer all the same: [`Accuracy::is_met`] says so.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve_into(
        &self,
        observer: &mut dyn Observer,
        sink: &mut dyn StaticSink,
    ) -> Result<StaticResult, AnalysisError> {
        let meshes = self.meshes.or(self.shared.and_then(|models| models.meshes()));
        if self.scene.accuracy.is_none() {
            let alone = CycleAnalysis::new(self.scene).with_cache(self.cache).with_meshes(meshes);
            let analysis = self.shared.map_or(alone, |models| alone.with_shared(models));
            let mut result = analysis.solve_into(observer, sink)?;
            // The laws of bounds are those of the built-in mesher.
            result.facts.accuracy = if meshes.is_none() { free_estimate(self.scene, &result)? } else { None };
            return Ok(result);
        }
        if meshes.is_some() {
            let hint = "leave [accuracy] out, or name the files of the meshes in the scene";
            return Err(in_scene(self.scene)(Refusal::input("there are no bounds of meshes in memory", hint)));
        }
        let kept = KeptGears::new(self.cache);
        let mut tried = Vec::new();
        let mut companions = Companions::default();
        let mut scene = self.first();
        let mut failed = false;
        loop {
            let solved = CycleAnalysis::new(&scene).with_slices_of_scene().with_cache(&kept).solve_into(observer, sink);
            let mut result = match solved {
                Ok(result) => result,
                Err(e) => {
                    // Teeth of few elements may have no equilibrium where finer ones have: one more rung tells.
                    let finer = Rung::of(&scene).filter(|_| !failed && self.may_refine()).and_then(Rung::finer);
                    let Some(finer) = finer.filter(|_| matches!(e.what(), AnalysisError::Solver(_))) else {
                        return Err(e);
                    };
                    observer.note(format!("left for a finer one: {e}"));
                    tried.push(tried_rung(&scene, Some(e.to_string())));
                    failed = true;
                    scene = finer.scene(&scene);
                    continue;
                }
            };
            let mut accuracy = estimate(&scene, &result, &kept, &mut companions, observer)?;
            let goes_on = self.scene.is_auto() && tried.len() + 1 < TRIES;
            let next = if goes_on { self.finer(&scene, &result, &accuracy) } else { None };
            let left_because = next.as_ref().map(|_| missed(&accuracy));
            if let Some(why) = &left_because {
                observer.note(format!("left for a finer one: {why}"));
            }
            if self.scene.is_auto() {
                tried.push(tried_rung(&scene, left_because));
            }
            let Some(finer) = next else {
                accuracy.rungs = tried;
                result.facts.accuracy = Some(accuracy);
                return Ok(result);
            };
            scene = finer;
        }
    }

    /// Whether the mesh is the program's to choose.
    fn may_refine(&self) -> bool {
        self.scene.is_auto() && !has_own_mesh(self.scene)
    }

    /// The scene that is solved first.
    fn first(&self) -> Scene {
        let mut scene = self.scene.clone();
        let slices = self.slices();
        scene.contact.slices = slices;
        if !self.scene.is_auto() {
            return scene;
        }
        scene.analysis.model = Model::Reduced;
        let Ok(pair) = self.scene.gear_pair() else { return scene };
        let guess = FirstGuess::new(self.scene, &pair);
        if self.scene.place_of(&["analysis.positions_per_cycle"]).is_none() {
            scene.analysis.positions_per_cycle = guess.positions;
        }
        if has_own_mesh(self.scene) { scene } else { guess.rung.scene(&scene) }
    }

    /// A scene that is finer in what the bounds that are not kept are mostly made of; `None` where all are kept, or
    /// nothing finer is left.
    fn finer(&self, scene: &Scene, result: &StaticResult, accuracy: &Accuracy) -> Option<Scene> {
        let worst = accuracy.missed().max_by(|a, b| over(a).total_cmp(&over(b)))?;
        let mut finer = scene.clone();
        let slices = scene.contact.slices.unwrap_or(MOST_SLICES);
        let rung = Rung::of(scene).filter(|_| self.may_refine());
        let share = |cause: Cause| term(worst, cause);
        let finer_mesh = rung.and_then(|r| enough(r, worst, result, scene));
        // A mesh that cannot be refined may be too coarse by itself: nothing else would help.
        if finer_mesh.is_none() && worst.asked.is_some_and(|asked| share(Cause::Mesh) >= asked) {
            return None;
        }
        let mut causes = [Cause::Mesh, Cause::Slices, Cause::Positions];
        causes.sort_by(|a, b| share(*b).total_cmp(&share(*a)));
        for cause in causes {
            match cause {
                Cause::Mesh => {
                    if let Some(next) = finer_mesh {
                        return Some(next.scene(&finer));
                    }
                }
                Cause::Slices if 2 * slices <= MOST_SLICES => {
                    finer.contact.slices = Some(2 * slices);
                    return Some(finer);
                }
                Cause::Positions if 2 * scene.analysis.positions_per_cycle <= POSITIONS[1] => {
                    finer.analysis.positions_per_cycle *= 2;
                    return Some(finer);
                }
                _ => {}
            }
        }
        None
    }
}

/// Whether the scene brings a mesh that no rung replaces.
fn has_own_mesh(scene: &Scene) -> bool {
    scene.gears().iter().any(|g| g.mesh.is_some())
}

/// How many times a bound is larger than what is asked.
fn over(bound: &Bound) -> f64 {
    bound.largest() / bound.asked.unwrap_or(f64::INFINITY)
}

/// What a cause makes of a bound: what is known of it, and what is not.
fn term(bound: &Bound, cause: Cause) -> f64 {
    bound.terms.iter().filter(|t| t.cause == cause).map(|t| t.known.abs() + t.amount).sum()
}

/// What the mesh of a rung makes of a bound by its law, over the scale of the quantity.
fn foreseen(rung: Rung, quantity: Quantity, features: &Features) -> Option<f64> {
    let law = &Calibration::committed().of(quantity)?.of_mesh(CalibratedMesh::Rung(rung.elements_profile))?.law;
    let [known, within] = law.of(features, 0.0, 1.0);
    Some(known.abs() + within)
}

/// Where the ladder begins.
struct FirstGuess {
    rung: Rung,
    positions: u32,
}

impl FirstGuess {
    /// The coarsest rung, then the fewest positions, whose foreseen bounds keep the shares that are asked.
    fn new(scene: &Scene, pair: &GearPair) -> Self {
        let features = features_before(scene, pair);
        let shares: Vec<(Quantity, f64)> = scene
            .accuracy
            .tolerances()
            .iter()
            .filter_map(|(q, tolerance)| match tolerance {
                Tolerance::Relative(share) if is_own_scale(*q) => Some((*q, *share)),
                _ => None,
            })
            .collect();
        let of_mesh = |rung: Rung, q: Quantity| foreseen(rung, q, &features).unwrap_or(0.0);
        let keeps = |rung: &Rung| shares.iter().all(|(q, share)| of_mesh(*rung, *q) <= MESH_SHARE * share);
        let rung = calibrated().find(keeps).or(calibrated().last()).unwrap_or(Rung::ALL[0]);
        let enough = |positions: &u32| {
            shares.iter().all(|(q, share)| {
                let law = Calibration::committed().of(*q).and_then(|laws| laws.of_positions(*positions));
                law.is_none_or(|law| law.usual <= share - of_mesh(rung, *q))
            })
        };
        let positions = [8, 16, 32, 64].into_iter().find(enough).unwrap_or(64);
        Self { rung, positions: positions.max(POSITIONS[0]) }
    }
}

/// Whether a share of a quantity is one of its scale, as far as that is known before anything is solved.
fn is_own_scale(quantity: Quantity) -> bool {
    quantity == Quantity::MeanSte || !goes_with_deflection(quantity)
}

/// Rungs that the calibration knows.
fn calibrated() -> impl Iterator<Item = Rung> {
    Rung::ALL.into_iter().filter(|rung| Calibration::committed().knows(CalibratedMesh::Rung(rung.elements_profile)))
}

/// The coarsest finer rung that is foreseen to keep a bound, else the next one.
fn enough(rung: Rung, bound: &Bound, result: &StaticResult, scene: &Scene) -> Option<Rung> {
    let sample = Sample::of(scene, &result.history, 1).ok()?;
    let (scale, features) = (sample.scale(bound.quantity)?, features(scene, &result.pair, &sample));
    let others: f64 = bound.terms.iter().filter(|t| t.cause != Cause::Mesh).map(|t| t.known.abs() + t.amount).sum();
    let room = bound.asked? - others;
    let finer: Vec<Rung> = calibrated().filter(|r| *r > rung).collect();
    let keeps = |r: &&Rung| foreseen(**r, bound.quantity, &features).is_some_and(|share| share * scale <= room);
    finer.iter().find(keeps).or(finer.first()).copied()
}

fn missed(accuracy: &Accuracy) -> String {
    let said = |b: &Bound| {
        let asked = b.asked.unwrap_or(f64::NAN);
        format!("{} is known to {:.2e} {}, {asked:.2e} is asked", b.quantity.key(), b.largest(), b.unit)
    };
    accuracy.missed().map(said).collect::<Vec<_>>().join("; ")
}

fn tried_rung(scene: &Scene, left_because: Option<String>) -> TriedRung {
    TriedRung {
        elements_profile: Rung::of(scene).map(|r| r.elements_profile),
        slices: scene.contact.slices,
        positions_per_cycle: scene.analysis.positions_per_cycle,
        left_because,
    }
}
