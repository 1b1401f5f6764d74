//! What was learnt from random pairs: how errors of headline numbers go with differences that a run can see.
//!
//! The table is made by `cargo run --release -p verification --bin calibrate_accuracy` from measured pairs.

use std::sync::LazyLock;

use scene::Quantity;
use serde::{Deserialize, Serialize};

use super::Rung;

/// How the error of a number goes with a difference `d` that was seen. Theory (64).
///
/// ```text
/// exact = value + pull d  +-  factor (|d| + floor scale)
/// ```
/// `scale` is the number itself, for transmission errors the mean deflection of the pair. The factor is that of
/// split conformal prediction: the share [`Calibration::coverage`] of the pairs that it was made of lies within.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Law {
    /// Share of the difference that is the known part of the error.
    pub pull: f64,
    /// Difference that is assumed at least, over the scale.
    pub floor: f64,
    /// Bound over the difference.
    pub factor: f64,
}

impl Law {
    /// Known part of the error, and the bound of the rest.
    pub fn of(self, difference: f64, scale: f64) -> [f64; 2] {
        [self.pull * difference, self.factor * (difference.abs() + self.floor * scale.abs())]
    }
}

/// What is known of one quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuantityLaws {
    /// Its key in `[accuracy]`.
    pub quantity: String,
    /// Of the mesh, by rung of the ladder.
    pub mesh: Vec<MeshLaw>,
    /// Of a number of slices, from half as many.
    pub slices: Law,
    /// Of a number of positions, from half as many.
    pub positions: Vec<PositionsLaw>,
}

/// What is known of a rung of the ladder.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshLaw {
    /// Elements along the profile.
    pub elements_profile: u32,
    /// From the same mesh of linear elements; `None` for fine rungs, which go by size.
    pub by_order: Option<Law>,
    /// From the next coarser rung; `None` for the coarsest.
    pub by_size: Option<Law>,
    /// Without a companion: the scale itself stands for the difference.
    pub alone: Law,
    /// What error and bound together come to in three of five pairs, over the scale.
    pub usual: f64,
}

/// What is known of a number of positions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PositionsLaw {
    /// Positions of a cycle.
    pub positions: u32,
    /// From every second of them.
    pub law: Law,
    /// What error and bound together come to in three of five pairs, over the scale.
    pub usual: f64,
}

/// All that is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Pairs that it was made of.
    pub pairs: usize,
    /// Share of them that lies within a bound.
    pub coverage: f64,
    /// By quantity.
    pub quantities: Vec<QuantityLaws>,
}

static COMMITTED: LazyLock<Calibration> = LazyLock::new(|| {
    // A file of this program, read by its tests.
    serde_json::from_str(include_str!("calibration.json")).unwrap_or(Calibration {
        pairs: 0,
        coverage: 0.0,
        quantities: Vec::new(),
    })
});

impl Calibration {
    /// The committed one.
    pub fn committed() -> &'static Self {
        &COMMITTED
    }

    /// Whether there are laws of a rung.
    pub fn knows(&self, rung: Rung) -> bool {
        let of_rung = |laws: &QuantityLaws| laws.mesh.iter().any(|law| law.elements_profile == rung.elements_profile);
        self.quantities.iter().any(of_rung)
    }

    /// What is known of a quantity.
    pub fn of(&self, quantity: Quantity) -> Option<&QuantityLaws> {
        self.quantities.iter().find(|laws| laws.quantity == quantity.key())
    }
}
