//! Error bounds of the headline values of a solved cycle.

use scene::{Quantity, Scene};

use study::Between;

use super::{
    Accuracy, Bound, Calibration, Cause, Curves, Features, PairLaw, Sample, Seen, Term, WholeForce,
    companion::{Companion, Companions, Standing, stride},
    coverage::{beyond_calibration, not_covered},
    features::features,
    together,
};
use crate::{
    AnalysisError, GearCache, Observer, PhaseWork, StaticResult, error::in_scene, refused::Refusal,
    results::static_headline, run_phase,
};

/// Bounds of a solved cycle: of a scene like those of the calibration on a mesh that it knows from its laws, which takes
/// no time; of any other from a companion on a rung of the ladder as well.
///
/// # Errors
/// [`AnalysisError`] where the companion cannot be solved, or something is asked that there is no bound of.
pub(super) fn estimate(
    scene: &Scene,
    result: &StaticResult,
    cache: &dyn GearCache,
    companions: &mut Companions,
    observer: &mut dyn Observer,
) -> Result<Accuracy, AnalysisError> {
    let beyond = beyond_calibration(scene, result);
    let standing = Standing::of(scene, beyond.is_empty());
    let companion = match standing {
        Standing::Calibrated(_) => None,
        Standing::Beside(rung) => {
            Some(run_phase(observer, "estimate", PhaseWork::Unknown, |_| companions.of((scene, rung), result, cache))?)
        }
    };
    let is_calibrated = beyond.is_empty();
    let seen = SeenCycle::new(scene, result, standing, companion, !is_calibrated)?;
    let own = accuracy(scene, seen.bounds(scene), standing, not_covered(scene, result, standing, beyond)?)?;
    Ok(Accuracy { is_calibrated, ..own })
}

/// Bounds that cost nothing: those of the laws alone; `None` where these do not hold.
///
/// # Errors
/// [`AnalysisError::Statistics`].
pub(super) fn free_estimate(scene: &Scene, result: &StaticResult) -> Result<Option<Accuracy>, AnalysisError> {
    let beyond = beyond_calibration(scene, result);
    let standing = Standing::of(scene, beyond.is_empty());
    if let Standing::Beside(_) = standing {
        return Ok(None);
    }
    let seen = SeenCycle::new(scene, result, standing, None, false)?;
    let own = accuracy(scene, seen.bounds(scene), standing, not_covered(scene, result, standing, beyond)?)?;
    Ok(Some(Accuracy { is_calibrated: true, ..own }))
}

fn accuracy(
    scene: &Scene,
    bounds: Vec<Bound>,
    standing: Standing,
    not_covered: Vec<String>,
) -> Result<Accuracy, AnalysisError> {
    // What is asked and cannot be bounded is not kept by silence.
    let has = |quantity: Quantity| bounds.iter().any(|b| b.quantity == quantity);
    if let Some((quantity, _)) = scene.accuracy.tolerances().iter().find(|(quantity, _)| !has(*quantity)) {
        return Err(in_scene(scene)(Refusal::no_bound(*quantity)));
    }
    let calibration = Calibration::committed();
    Ok(Accuracy {
        coverage: calibration.coverage,
        calibrated_on_pairs: calibration.pairs,
        held_against: standing.words(),
        bounds,
        not_covered,
        ..Accuracy::default()
    })
}

/// Positions from which on half of them say something.
const LEAST_HALVED: u32 = 16;
/// How many times the bounds of the calibration stand for a scene that it does not cover.
const BEYOND: f64 = 3.0;

/// Samples that differences are taken of.
struct SeenCycle {
    standing: Standing,
    positions: u32,
    features: Features,
    whole: WholeForce,
    own: Sample,
    curves: Curves,
    /// At the positions of the companion.
    sparse: Sample,
    /// At every second position; `None` for an odd number, and for a small one.
    halved: Option<Sample>,
    companion: Option<Companion>,
    /// The scene is unlike those of the calibration.
    beyond: bool,
    /// The wheel is a ring.
    internal: bool,
    /// Relative errors of the interpolated bulk compliance and of the contact iterations.
    interpolation: f64,
    iteration: f64,
}

impl SeenCycle {
    fn new(
        scene: &Scene,
        result: &StaticResult,
        standing: Standing,
        companion: Option<Companion>,
        beyond: bool,
    ) -> Result<Self, AnalysisError> {
        let positions = scene.analysis.positions_per_cycle;
        let sample = |stride: u32| Sample::of(scene, &result.history, stride as usize);
        let headline = static_headline(scene, &result.history)?;
        let own = sample(1)?;
        Ok(Self {
            standing,
            positions,
            features: features(scene, &result.pair, &own),
            whole: WholeForce::of(scene, &result.pair),
            own,
            curves: Curves::of(&result.history, scene.analysis.cycles as usize),
            sparse: sample(stride(positions))?,
            halved: (positions >= LEAST_HALVED && positions.is_multiple_of(2)).then(|| sample(2)).transpose()?,
            companion,
            beyond,
            internal: result.pair.is_internal(),
            interpolation: headline.bulk_compliance_error,
            iteration: headline.worst_torque_residual.max(headline.worst_complementarity_residual),
        })
    }

    fn bounds(&self, scene: &Scene) -> Vec<Bound> {
        let bound = |&q: &Quantity| Some(self.bound(q)?.against(scene.accuracy.of(q)));
        Quantity::ALL.iter().filter_map(bound).collect()
    }

    fn bound(&self, q: Quantity) -> Option<Bound> {
        let laws = Calibration::committed().of(q)?;
        let (own, scale) = (self.own.get(q)?, self.own.scale(q)?);
        let of = |law: &PairLaw| law.of(&self.features, &self.whole.number(q, own), scale);
        let mut mesh = of(&laws.of_mesh(self.standing.mesh())?.law);
        let mut slices = of(&laws.slices);
        let halved = self.halved.as_ref().and_then(|halved| Some(own - halved.get(q)?));
        // Positions that no shape can be told from have the law of the fewest, at the size of the number itself.
        let between = self.curves.between(q).unwrap_or(Between { shift: 0.0, seen: [own; 2] });
        let between = self.whole.between(q, own, between);
        // Without half of them only the law of the fewest goes without a difference.
        let law = laws.of_positions(if halved.is_some() { self.positions } else { 0 })?;
        let mut positions = law.of(&self.features, &Seen::of(&between, halved), scale);
        if let Some(companion) = &self.companion {
            let (sparse, beside) = (self.sparse.get(q)?, companion.sample.get(q)?);
            mesh[0] += beside - sparse;
            if self.beyond {
                let fewer = beside - companion.fewer_slices.get(q)?;
                mesh = widened(mesh, 0.0);
                slices = widened(slices, fewer);
                positions = widened(positions, halved.unwrap_or(0.0));
            }
        }
        in_squares([&mut mesh[1], &mut slices[1], &mut positions[1]]);
        if self.internal {
            [&mut mesh, &mut slices, &mut positions].into_iter().for_each(|[_, within]| *within *= laws.internal);
        }
        let terms = [
            (Cause::Mesh, mesh),
            (Cause::Slices, slices),
            (Cause::Positions, positions),
            (Cause::Interpolation, [0.0, self.interpolation * scale.abs()]),
            (Cause::Iteration, [0.0, self.iteration * scale.abs()]),
        ];
        Some(Bound::new(q, own, terms.map(|(cause, [known, amount])| Term { cause, known, amount }).to_vec()))
    }
}

/// Bounds of independent causes as parts of that of all together, which add up.
fn in_squares(mut amounts: [&mut f64; 3]) {
    let all = together(&amounts.each_ref().map(|amount| **amount));
    for amount in amounts.iter_mut().filter(|_| all != 0.0) {
        **amount *= **amount / all;
    }
}

/// Known part and bound where the calibration does not hold: nothing is known, and what it says, or what is seen, may be
/// off either way.
fn widened([known, within]: [f64; 2], seen: f64) -> [f64; 2] {
    [0.0, known.abs() + BEYOND * within + seen.abs()]
}
