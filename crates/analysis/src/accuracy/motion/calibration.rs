//! What was learnt from random pairs in motion: how far models and steps are off.
//!
//! The table is made by `cargo run --release -p verification --bin accuracy -- calibrate motion` from measured motions.

use std::sync::LazyLock;

use scene::Quantity;
use serde::{Deserialize, Serialize};

use super::{MotionModel, PairAtRest};
use crate::accuracy::Law;

/// What is known of one quantity of a motion. Each law is that of theory (67), s the number itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionLaws {
    /// Key of the quantity in `[accuracy]`.
    pub quantity: String,
    /// Law of steps of time; d: what half as many change, s: the number itself times the square of
    /// [`MotionCalibration::STEPS`] over the steps in a period of the mesh resonance.
    pub step: Law,
    /// Law of elasticity without inertia; d: what theory (63) says that it may change.
    pub elasticity: Law,
    /// Laws of twelve coordinates, by stratum of speed; d: what the motion adds to the number at rest.
    pub lumped12: Vec<SpeedLaw>,
    /// What bounds usually come to, by stratum and model.
    pub usual: Vec<UsualBound>,
}

/// A law for mesh frequencies up to a share of the resonance, from that of the law before.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpeedLaw {
    /// Largest mesh frequency over the mesh resonance.
    pub speed_to: f64,
    /// Motions that it was made of.
    pub motions: usize,
    /// The law.
    pub law: Law,
}

/// What steps, elasticity and model together come to in three of five motions of a stratum.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UsualBound {
    /// Name of the model.
    pub model: String,
    /// Largest mesh frequency over the mesh resonance.
    pub speed_to: f64,
    /// Largest mesh frequency over the lowest elastic frequency.
    pub elastic_to: f64,
    /// Motions of the stratum.
    pub motions: usize,
    /// Over the number itself.
    pub share: f64,
}

/// All that is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionCalibration {
    /// Motions that it was made of.
    pub motions: usize,
    /// Pairs that they were of.
    pub pairs: usize,
    /// Share of them that lies within a bound.
    pub coverage: f64,
    /// Laws by quantity.
    pub quantities: Vec<MotionLaws>,
}

static COMMITTED: LazyLock<MotionCalibration> = LazyLock::new(|| {
    // A file of this program, read by its tests.
    serde_json::from_str(include_str!("calibration.json")).unwrap_or(MotionCalibration {
        motions: 0,
        pairs: 0,
        coverage: 0.0,
        quantities: Vec::new(),
    })
});

impl MotionCalibration {
    /// Steps in a period of the mesh resonance that the law of steps was made at.
    pub const STEPS: f64 = 16.0;
    /// Upper ends of the strata of mesh frequency over mesh resonance.
    pub const SPEEDS: [f64; 3] = [0.16, 0.48, 1.5];
    /// Upper ends of the strata of mesh frequency over the lowest elastic frequency.
    pub const ELASTIC: [f64; 2] = [0.1, f64::MAX];

    /// The committed one.
    pub fn committed() -> &'static Self {
        &COMMITTED
    }

    /// What is known of a quantity.
    pub fn of(&self, quantity: Quantity) -> Option<&MotionLaws> {
        self.quantities.iter().find(|laws| laws.quantity == quantity.key())
    }

    /// The highest mesh frequency over the resonance that it knows of.
    pub fn fastest() -> f64 {
        Self::SPEEDS[Self::SPEEDS.len() - 1]
    }
}

impl MotionLaws {
    /// Law of twelve coordinates at a speed; beyond all strata the last one.
    pub fn lumped12_at(&self, rest: &PairAtRest) -> Option<Law> {
        let found = self.lumped12.iter().find(|law| rest.speed_ratio() <= law.speed_to);
        Some(found.or(self.lumped12.last())?.law)
    }

    /// What the bound of a model usually comes to, over the number itself; `None` for a stratum without motions.
    pub fn usual(&self, model: MotionModel, rest: &PairAtRest) -> Option<f64> {
        let of_model = |u: &&UsualBound| u.model == model.name();
        let fits = |u: &&UsualBound| rest.speed_ratio() <= u.speed_to && rest.elastic_ratio() <= u.elastic_to;
        self.usual.iter().filter(of_model).find(fits).map(|u| u.share)
    }
}
