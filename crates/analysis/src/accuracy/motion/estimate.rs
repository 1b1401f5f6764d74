//! Error bounds of a run of a motion.

use std::f64::consts::TAU;

use scene::{Quantity, Scene};

use super::{MotionCalibration, MotionModel, MotionSample, PairAtRest, mesh_bound};
use crate::accuracy::{Bound, Cause, Term};

/// What is seen of the error of a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen<'a> {
    pub model: MotionModel,
    pub rest: &'a PairAtRest,
    /// Bounds of the pair at rest: of the peak to peak of its transmission error (um), and of its mean tangent
    /// stiffness over itself.
    pub at_rest: [f64; 2],
    pub own: MotionSample,
    /// Steps in a period of the mesh resonance.
    pub steps: f64,
    /// With half the steps; `None`: rows are the steps, and there are more than were asked.
    pub halved: Option<MotionSample>,
    /// Share of the peak to peak that the inertia of elastic deformation which the model leaves out may change.
    pub elastic_share: f64,
}

impl Seen<'_> {
    /// Bounds of all values of a motion, compared with the accuracy that the scene requests.
    pub fn bounds(&self, scene: &Scene) -> Vec<Bound> {
        let bound = |q: &Quantity| Some(self.bound(*q)?.against(scene.accuracy.of(*q)));
        Quantity::OF_MOTION.iter().filter_map(bound).collect()
    }

    fn bound(&self, q: Quantity) -> Option<Bound> {
        let laws = MotionCalibration::committed().of(q)?;
        let own = self.own.get(q);
        let d = self.halved.map_or(0.0, |halved| own - halved.get(q));
        // Midpoint steps: twice as many leave a quarter of the error.
        let step = laws.step.of(d, own * (MotionCalibration::STEPS / self.steps).powi(2));
        let mut terms = vec![
            (Cause::Mesh, [0.0, mesh_bound(q, self.rest, self.at_rest[0], self.at_rest[1])]),
            (Cause::Step, step),
            (Cause::QuasiStaticElasticity, laws.elasticity.of(self.elastic_share * own, own)),
        ];
        if self.model == MotionModel::Lumped12 {
            let still = self.rest.ste_um[usize::from(q == Quantity::PeakToPeakDte)];
            terms.push((Cause::Model, laws.lumped12_at(self.rest)?.of(own - still, own)));
        }
        terms.push((Cause::Settling, [0.0, self.settling(own)]));
        let term = |(cause, [known, amount]): (Cause, [f64; 2])| Term { cause, known, amount };
        Some(Bound::new(q, own, terms.into_iter().map(term).collect()))
    }

    /// What is left of a transient: a difference from cycle to cycle that shrinks as the resonance decays, summed to its
    /// end. Theory (66).
    fn settling(&self, own: f64) -> f64 {
        let ratio = self.own.periodicity.unwrap_or(0.0);
        let decay = TAU * self.rest.resonance.damping / self.rest.speed_ratio();
        own * ratio / (1.0 - (-decay).exp()).max(f64::MIN_POSITIVE)
    }
}

/// What the bounds of a motion do not cover, in words, beside what those of the pair at rest do not.
pub(super) fn not_covered(seen: &Seen<'_>, scene: &Scene) -> Vec<String> {
    let mut all = Vec::new();
    let fastest = MotionCalibration::fastest();
    if seen.rest.speed_ratio() > fastest {
        all.push(format!(
            "a mesh frequency of {:.2} of the mesh resonance: the calibration ends at {fastest}",
            seen.rest.speed_ratio()
        ));
    }
    let damping = seen.rest.resonance.damping;
    if !(0.04..=0.12).contains(&damping) {
        all.push(format!("a damping ratio of the mesh of {damping:.3}: the calibration has 0.04 to 0.12"));
    }
    if scene.gears().iter().any(|g| g.body.as_ref().is_some_and(|b| !b.free.is_empty())) {
        all.push("bearings: in the calibration the gears turn about fixed axes".into());
    }
    if seen.own.least_force <= 0.0 {
        all.push("flanks that part: the calibration has few such motions, and another answer may stand beside".into());
    }
    all.push("damping, bodies, drive and load as they are given".into());
    all
}
