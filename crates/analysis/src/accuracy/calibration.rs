//! What was learnt from random pairs: how errors of headline numbers go with what is known of a run.
//!
//! The table is made by `cargo run --release -p verification --bin accuracy -- calibrate rest` from measured pairs.

use std::{collections::BTreeMap, sync::LazyLock};

use scene::Quantity;
use serde::{Deserialize, Serialize};

use super::{
    CalibratedMesh, Features, Seen,
    features::{FEATURES, is_spur},
};

/// How the error of a number goes with the features `x` of a run, and with sizes `d` that were seen in it. Theory (64).
///
/// ```text
/// exact = value + scale a'x + p t  +-  scale factor exp(b'x + sum_j c_j ln(|d_j| / scale + LEAST))
/// ```
/// `scale` is the number itself, for transmission errors the mean deflection of the pair; t: what the shape of the curve
/// adds to it ([`Seen::shift`]). The factor is that of conformal prediction: of pairs that took no part in a, b, c and p, the
/// share [`Calibration::coverage`] lies within.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairLaw {
    /// a, the known part of the error; empty where nothing is known of it.
    pub known: Vec<f64>,
    /// p, share of what the shape of the curve adds.
    pub pull: f64,
    /// b, logarithm of the spread about it.
    pub spread: Vec<f64>,
    /// c, powers of what is seen in the spread; none where nothing is seen.
    pub powers: Vec<f64>,
    /// What makes a bound of the spread.
    pub factor: f64,
}

/// Difference over the scale that counts as none.
pub const LEAST_DIFFERENCE: f64 = 1e-5;

impl PairLaw {
    /// Known part of the error, and the bound of the rest. A size that is not seen counts as none.
    pub fn of(&self, x: &Features, seen: &Seen, scale: f64) -> [f64; 2] {
        let dot = |with: &[f64]| with.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
        let sizes = seen.sizes.iter().copied().chain(std::iter::repeat(0.0));
        let logarithms = self.powers.iter().zip(sizes).map(|(c, d)| c * logarithm(d, scale)).sum::<f64>();
        let known = scale * dot(&self.known) + self.pull * seen.shift;
        [known, scale.abs() * self.factor * (dot(&self.spread) + logarithms).exp()]
    }

    /// Whether it has a number for each feature.
    pub fn is_whole(&self) -> bool {
        let all = [&self.known, &self.spread, &self.powers].into_iter().flatten().chain([&self.pull, &self.factor]);
        let known = [0, FEATURES].contains(&self.known.len());
        known && self.spread.len() == FEATURES && all.into_iter().all(|a| a.is_finite())
    }
}

/// Bound of independent causes with bounds of their own: the root of the sum of squares.
pub fn together(amounts: &[f64]) -> f64 {
    amounts.iter().map(|amount| amount * amount).sum::<f64>().sqrt()
}

/// Logarithm of a size over the scale, of which the smallest count as none.
pub fn logarithm(size: f64, scale: f64) -> f64 {
    (size.abs() / scale.abs() + LEAST_DIFFERENCE).ln()
}

/// What is known of one quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuantityLaws {
    /// Key of the quantity in `[accuracy]`.
    pub quantity: String,
    /// Laws of the mesh.
    pub mesh: Vec<MeshLaw>,
    /// Law of the number of slices that a pair asks for.
    pub slices: PairLaw,
    /// Laws of a number of positions, from half as many.
    pub positions: Vec<PositionsLaw>,
}

/// What is known of a mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeshLaw {
    /// Which.
    pub mesh: CalibratedMesh,
    /// Law of the mesh.
    pub law: PairLaw,
}

/// What is known of a number of positions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PositionsLaw {
    /// Positions of a cycle.
    pub positions: u32,
    /// From the shape of the curves, and from every second position.
    pub law: PairLaw,
    /// How many times its bound holds for spur pairs, 1 or more. Their load jumps from pair to pair, which few positions
    /// miss; of all pairs they are too few to tell.
    pub spur: f64,
    /// What error and bound together come to in three of five pairs, over the scale.
    pub usual: f64,
}

/// All that is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Pairs that it was made of.
    pub pairs: usize,
    /// Which they are, and those whose curves alone were measured: numbers of `tests/src/random_scene.rs` by their seed.
    pub made_of: BTreeMap<u64, Vec<u64>>,
    /// Share of them that lies within its bounds.
    pub coverage: f64,
    /// Laws by quantity.
    pub quantities: Vec<QuantityLaws>,
}

static COMMITTED: LazyLock<Calibration> = LazyLock::new(|| {
    // A file of this program, read by its tests.
    serde_json::from_str(include_str!("calibration.json")).unwrap_or(Calibration {
        pairs: 0,
        made_of: BTreeMap::new(),
        coverage: 0.0,
        quantities: Vec::new(),
    })
});

impl Calibration {
    /// The committed one.
    pub fn committed() -> &'static Self {
        &COMMITTED
    }

    /// Whether there are laws of a mesh.
    pub fn knows(&self, mesh: CalibratedMesh) -> bool {
        self.quantities.iter().any(|laws| laws.of_mesh(mesh).is_some())
    }

    /// What is known of a quantity.
    pub fn of(&self, quantity: Quantity) -> Option<&QuantityLaws> {
        self.quantities.iter().find(|laws| laws.quantity == quantity.key())
    }
}

impl PositionsLaw {
    /// Known part of the error, and the bound of the rest, as [`PairLaw::of`]; a pair without overlap is a spur pair.
    pub fn of(&self, x: &Features, seen: &Seen, scale: f64) -> [f64; 2] {
        let [known, within] = self.law.of(x, seen, scale);
        [known, if is_spur(x) { self.spur * within } else { within }]
    }
}

impl QuantityLaws {
    /// The law of a mesh.
    pub fn of_mesh(&self, mesh: CalibratedMesh) -> Option<&MeshLaw> {
        self.mesh.iter().find(|law| law.mesh == mesh)
    }

    /// Law of the largest calibrated number of positions that a run has; the smallest for fewer.
    pub fn of_positions(&self, positions: u32) -> Option<&PositionsLaw> {
        self.positions.iter().rev().find(|law| law.positions <= positions).or(self.positions.first())
    }
}
