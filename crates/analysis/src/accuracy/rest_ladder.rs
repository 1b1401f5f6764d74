//! The ladder of a static pair: meshes, slices, positions.

use geometry::GearPair;
use scene::{Model, Quantity, Scene, Tolerance};

use super::{
    Accuracy, Bound, CalibratedMesh, Calibration, Cause, Features, Rung, Sample, Seen, TriedRung, WholeForce,
    climb::Ladder,
    companion::Companions,
    estimate::estimate,
    features,
    features::{USUAL_LEFT, features_before},
    gear_memo::GearMemo,
    goes_with_deflection,
    rung::has_own_mesh,
    together,
};
use crate::{AnalysisError, GearCache, Observer, StaticResult, StaticSink, statics::CycleAnalysis};

/// Positions of a cycle that the ladder begins with, at least, and ends with.
const POSITIONS: [u32; 2] = [8, 256];
/// Share of what is asked that a guess leaves to the mesh.
const MESH_SHARE: f64 = 0.95;
/// Slices beyond which no more are taken.
const MOST_SLICES: u32 = 768;

/// A scene at rest on the rungs of the ladder; positions are told as they come, from the beginning at every rung.
pub(super) struct RestLadder<'a> {
    scene: &'a Scene,
    kept: GearMemo<'a>,
    companions: Companions,
    sink: &'a mut dyn StaticSink,
    /// A rung has had no equilibrium.
    failed: bool,
}

/// A scene without its load spectrum.
fn without_spectrum(scene: &Scene) -> Scene {
    let mut own = scene.clone();
    if let Some(rating) = &mut own.rating {
        rating.spectrum = None;
    }
    own
}

impl<'a> RestLadder<'a> {
    /// Ladder of a scene with `[accuracy]`.
    pub fn new(scene: &'a Scene, cache: &'a dyn GearCache, sink: &'a mut dyn StaticSink) -> Self {
        Self { scene, kept: GearMemo::new(cache), companions: Companions::default(), sink, failed: false }
    }

    /// Whether the mesh is the program's to choose.
    fn may_refine(&self) -> bool {
        self.scene.is_auto() && !has_own_mesh(self.scene)
    }

    /// The scene that is solved first.
    fn first_scene(&self) -> Scene {
        let mut scene = self.scene.clone();
        let slices = CycleAnalysis::new(self.scene).slices();
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
        let worst = accuracy.worst()?;
        let mut finer = scene.clone();
        let slices = scene.contact.slices.unwrap_or(MOST_SLICES);
        let rung = Rung::of(scene).filter(|_| self.may_refine());
        let share = |cause: Cause| worst.by(cause);
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

impl Ladder for RestLadder<'_> {
    type Rung = Scene;
    type Solved = StaticResult;
    type Tried = TriedRung;
    /// Each is twice as fine in something as one before.
    const TRIES: usize = 16;

    fn chooses(&self) -> bool {
        self.scene.is_auto()
    }

    fn first(&mut self, _: &mut dyn Observer) -> Result<Scene, AnalysisError> {
        Ok(self.first_scene())
    }

    fn solve(&mut self, scene: &Scene, observer: &mut dyn Observer) -> Result<StaticResult, AnalysisError> {
        // Loads of a spectrum are solved on the rung that is taken.
        let scene = &without_spectrum(scene);
        CycleAnalysis::new(scene).with_slices_of_scene().with_cache(&self.kept).solve_into(observer, self.sink)
    }

    /// Teeth of few elements may have no equilibrium where finer ones have: one more rung tells.
    fn after_failure(&mut self, scene: &Scene, error: &AnalysisError) -> Option<Scene> {
        let may = !self.failed && self.may_refine() && matches!(error.what(), AnalysisError::Solver(_));
        let finer = Rung::of(scene).filter(|_| may).and_then(Rung::finer)?;
        self.failed = true;
        Some(finer.scene(scene))
    }

    fn bound(
        &mut self,
        scene: &Scene,
        result: &StaticResult,
        observer: &mut dyn Observer,
    ) -> Result<Accuracy, AnalysisError> {
        estimate(scene, result, &self.kept, &mut self.companions, observer)
    }

    fn refine(&mut self, scene: &Scene, result: &StaticResult, accuracy: &Accuracy) -> Option<(Scene, String)> {
        Some((self.finer(scene, result, accuracy)?, accuracy.shortfall()))
    }

    fn tried(&self, scene: &Scene, left_because: Option<String>) -> TriedRung {
        TriedRung {
            elements_profile: Rung::of(scene).map(|r| r.elements_profile),
            slices: scene.contact.slices,
            positions_per_cycle: scene.analysis.positions_per_cycle,
            left_because,
        }
    }
}

/// What the mesh of a rung makes of a bound by its law, over the scale of the quantity; sizes as well.
fn foreseen(rung: Rung, quantity: Quantity, features: &Features, seen: &Seen) -> Option<f64> {
    let law = &Calibration::committed().of(quantity)?.of_mesh(CalibratedMesh::Rung(rung.elements_profile))?.law;
    let [known, within] = law.of(features, seen, 1.0);
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
        let size = |q: Quantity| if q == Quantity::MaxPairForce { USUAL_LEFT } else { 1.0 };
        let seen = |q: Quantity| Seen { shift: 0.0, sizes: vec![size(q)] };
        let of_mesh = |rung: Rung, q: Quantity| foreseen(rung, q, &features, &seen(q)).unwrap_or(0.0);
        let keeps = |rung: &Rung| shares.iter().all(|(q, share)| of_mesh(*rung, *q) <= MESH_SHARE * share);
        let rung = calibrated().find(keeps).or(calibrated().last()).unwrap_or(Rung::ALL[0]);
        let enough = |positions: &u32| {
            shares.iter().all(|(q, share)| {
                let law = Calibration::committed().of(*q).and_then(|laws| laws.of_positions(*positions));
                law.is_none_or(|law| together(&[law.usual, of_mesh(rung, *q)]) <= *share)
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
    let own = WholeForce::of(scene, &result.pair).number(bound.quantity, sample.get(bound.quantity)?);
    let own = Seen { sizes: own.sizes.iter().map(|size| size / scale).collect(), ..own };
    let room = bound.asked? - others;
    let finer: Vec<Rung> = calibrated().filter(|r| *r > rung).collect();
    let keeps = |r: &&Rung| foreseen(**r, bound.quantity, &features, &own).is_some_and(|share| share * scale <= room);
    finer.iter().find(keeps).or(finer.first()).copied()
}
