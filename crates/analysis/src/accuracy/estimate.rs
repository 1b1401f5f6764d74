//! Bounds of the headline numbers of a solved cycle.

use scene::{Quantity, Scene};
use serde::Serialize;

use super::{
    Bound, Calibration, Cause, Law, PositionsLaw, QuantityLaws, Sample, Term,
    companion::{Companion, Companions, Standing, stride},
    coverage::not_covered,
};
use crate::{AnalysisError, GearCache, Observer, PhaseWork, StaticResult, results::static_headline, run_phase};

/// How exact a result is, and how that is known.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Accuracy {
    /// Share of the pairs of the calibration that lie within their bounds, by cause.
    pub coverage: f64,
    /// Pairs that the calibration was made of.
    pub calibrated_on_pairs: usize,
    /// What the run was held against.
    pub held_against: String,
    /// Bounds of all headline numbers that the run has.
    pub bounds: Vec<Bound>,
    /// Rungs of the ladder that were tried, in their order; empty where the scene says what is taken.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rungs: Vec<super::TriedRung>,
    /// Models of a motion that were tried, in their order; empty where the scene says what is taken, and at rest.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub models: Vec<super::motion::TriedModel>,
    /// What the bounds do not cover.
    pub not_covered: Vec<String>,
}

impl Accuracy {
    /// Whether everything that is asked is kept.
    pub fn is_met(&self) -> bool {
        self.bounds.iter().all(|b| b.met != Some(false))
    }

    /// What is asked and not kept.
    pub fn missed(&self) -> impl Iterator<Item = &Bound> {
        self.bounds.iter().filter(|b| b.met == Some(false))
    }
}

/// Bounds of a solved cycle, from a companion on another mesh, half the slices and half the positions.
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
    let calibration = Calibration::committed();
    let companion = run_phase(observer, "estimate", PhaseWork::Unknown, |_| companions.of(scene, result, cache))?;
    let standing = Standing::of(scene);
    let seen = Seen::new(scene, result, standing, companion)?;
    let bound = |&q: &Quantity| Some(seen.bound(q, calibration.of(q)?)?.against(scene.accuracy.of(q)));
    let bounds: Vec<Bound> = Quantity::ALL.iter().filter_map(bound).collect();
    // What is asked and cannot be bounded is not kept by silence.
    let has = |quantity: Quantity| bounds.iter().any(|b| b.quantity == quantity);
    if let Some((quantity, _)) = scene.accuracy.tolerances().iter().find(|(quantity, _)| !has(*quantity)) {
        return Err(AnalysisError::NoBound { file: scene.file.display().to_string(), quantity: quantity.key() });
    }
    Ok(Accuracy {
        coverage: calibration.coverage,
        calibrated_on_pairs: calibration.pairs,
        held_against: standing.words(),
        bounds,
        rungs: Vec::new(),
        models: Vec::new(),
        not_covered: not_covered(scene, result, standing)?,
    })
}

/// Positions from which on half of them say something.
const LEAST_HALVED: u32 = 16;

/// Samples that differences are taken of.
struct Seen {
    standing: Standing,
    positions: u32,
    own: Sample,
    /// At the positions of the companion.
    sparse: Sample,
    /// At every second position; `None` for an odd number, and for a small one.
    halved: Option<Sample>,
    companion: Companion,
    /// Relative errors of the interpolated bulk compliance and of the contact iterations.
    interpolation: f64,
    iteration: f64,
}

impl Seen {
    fn new(
        scene: &Scene,
        result: &StaticResult,
        standing: Standing,
        companion: Companion,
    ) -> Result<Self, AnalysisError> {
        let positions = scene.analysis.positions_per_cycle;
        let sample = |stride: u32| Sample::of(scene, &result.history, stride as usize);
        let headline = static_headline(scene, &result.history)?;
        Ok(Self {
            standing,
            positions,
            own: sample(1)?,
            sparse: sample(stride(positions))?,
            halved: (positions >= LEAST_HALVED && positions.is_multiple_of(2)).then(|| sample(2)).transpose()?,
            companion,
            interpolation: headline.bulk_compliance_error,
            iteration: headline.worst_torque_residual.max(headline.worst_complementarity_residual),
        })
    }

    fn bound(&self, q: Quantity, laws: &QuantityLaws) -> Option<Bound> {
        let (own, sparse, companion) = (self.own.get(q)?, self.sparse.get(q)?, self.companion.sample.get(q)?);
        let scale = self.own.scale(q)?;
        let law = laws.mesh.iter().find(|law| law.elements_profile == self.standing.rung().elements_profile)?;
        let [mesh_shift, mesh] = match self.standing {
            Standing::Low(_) => law.by_order?.of(sparse - companion, scale),
            Standing::High(_) => law.by_size?.of(sparse - companion, scale),
            Standing::Beside(_) => {
                let [known, within] = law.alone.of(scale, scale);
                [companion + known - sparse, within]
            }
        };
        let of_slices = companion - self.companion.fewer_slices.get(q)?;
        let [slice_shift, slices] = laws.slices.of(of_slices, scale);
        let [position_shift, positions] = self.positions_law(laws)?.of(self.halved_difference(q, own), scale);
        let terms = [
            (Cause::Mesh, mesh),
            (Cause::Slices, slices),
            (Cause::Positions, positions),
            (Cause::Interpolation, self.interpolation * scale),
            (Cause::Iteration, self.iteration * scale),
        ];
        let corrected = own + mesh_shift + slice_shift + position_shift;
        Some(Bound::new(q, own, corrected, terms.map(|(cause, amount)| Term { cause, amount }).to_vec()))
    }

    /// What every second position leaves out; 0 where the law goes without.
    fn halved_difference(&self, q: Quantity, own: f64) -> f64 {
        self.halved.as_ref().and_then(|halved| Some(own - halved.get(q)?)).unwrap_or(0.0)
    }

    /// Of the largest calibrated number of positions that the run has, else the smallest: that goes without a
    /// difference, as an odd number of positions does.
    fn positions_law(&self, laws: &QuantityLaws) -> Option<Law> {
        let fits = |law: &&PositionsLaw| law.positions <= self.positions && self.halved.is_some();
        Some(laws.positions.iter().rev().find(fits).or(laws.positions.first())?.law)
    }
}
