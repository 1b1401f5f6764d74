//! What `accuracy measure rest` has measured of a pair: numbers on settings from coarse to fine, curves over a mesh cycle.

use std::collections::BTreeMap;

use analysis::accuracy::{CalibratedMesh, Curves, Features, Sample, Seen, WholeForce, features};
use geometry::GearPair;
use scene::{Quantity, Scene};
use serde_json::Value;

use crate::random_scene::{random_scene, torque_of_pressure};

/// From rungs 4 and 6 to rung 8, a little less than at order two: where rung 8 was measured it lies there.
const EXTRAPOLATION: f64 = 0.4;
/// Rungs that errors are known of.
pub const RUNGS: [u32; 4] = [2, 3, 4, 6];
/// Error over the scale below which none is told from another: that of one pair of teeth that bears all is round-off.
pub const LEAST_ERROR: f64 = 1e-5;
/// Positions of a cycle on every mesh.
pub const POSITIONS: u32 = 8;
/// Positions of the curves, which stand for all of them.
pub const CURVE_POSITIONS: u32 = 128;

/// All that is measured of a pair, of one line or several.
#[derive(Debug, Clone)]
pub struct MeasuredPair {
    pub seed: u64,
    pub index: u64,
    pub scene: Scene,
    pair: GearPair,
    samples: Value,
    curves: Option<Curves>,
}

impl MeasuredPair {
    /// Pairs of some lines, in the order of seeds and numbers; those without a result are left out.
    pub fn all(lines: &[Value]) -> Vec<Self> {
        let mut pairs = BTreeMap::<(u64, u64), Self>::new();
        for line in lines {
            let of = |key: &str| line[key].as_u64();
            let (Some(seed), Some(index)) = (of("seed"), of("index")) else { continue };
            let samples = line.get("samples").filter(|samples| !samples.is_null());
            let curves = line.get("curves").and_then(|c| serde_json::from_value::<Curves>(c.clone()).ok());
            if samples.is_none() && curves.is_none() {
                continue;
            }
            let Some(pair) = Self::unmeasured(seed, index) else { continue };
            let pair = pairs.entry((seed, index)).or_insert(pair);
            if let Some(samples) = samples {
                pair.samples = samples.clone();
            }
            pair.curves = curves.or(pair.curves.take());
        }
        pairs.into_values().collect()
    }

    fn unmeasured(seed: u64, index: u64) -> Option<Self> {
        let scene = random_scene(seed, index);
        let pair = scene.gear_pair().ok()?;
        Some(Self { seed, index, scene, pair, samples: Value::Null, curves: None })
    }

    /// Contact ratio of the whole flanks.
    pub fn contact_ratio(&self) -> f64 {
        self.pair.transverse_contact_ratio() + self.pair.overlap_ratio()
    }

    /// Hertz pressure at the pitch point, as pairs are drawn by it, MPa.
    pub fn pressure_mpa(&self) -> f64 {
        1000.0 * (1e3 * self.scene.operation.torque_nm / torque_of_pressure(&self.pair, 1000.0)).sqrt()
    }

    /// Whether it was solved on finer meshes.
    pub fn has_meshes(&self) -> bool {
        self.samples.get("mesh 4").is_some()
    }

    /// Whether its curves are known.
    pub fn has_curves(&self) -> bool {
        self.curves.is_some()
    }

    /// A number of a sample.
    pub fn value(&self, sample: &str, quantity: Quantity) -> Option<f64> {
        self.samples[sample][quantity.key()].as_f64()
    }

    fn of_mesh(mesh: CalibratedMesh) -> String {
        match mesh {
            CalibratedMesh::Rung(n) => format!("mesh {n}"),
            CalibratedMesh::Default => "default".into(),
        }
    }

    /// Mean force over stiffness, um.
    fn deflection(&self, stiffness: f64) -> f64 {
        let driven = match self.scene.operation.driver {
            scene::Driver::Pinion => &self.pair.wheel,
            scene::Driver::Wheel => &self.pair.pinion,
        };
        self.scene.operation.torque() / driven.base_radius().abs() / stiffness
    }

    /// All numbers on a mesh.
    pub fn sample(&self, mesh: CalibratedMesh) -> Option<Sample> {
        let name = Self::of_mesh(mesh);
        let deflection = self.deflection(self.value(&name, Quantity::MeshStiffness)?);
        Some(Sample::new(|q| self.value(&name, q), deflection))
    }

    /// All numbers of so many positions on the coarsest rung.
    pub fn of_positions(&self, positions: u32) -> Option<Sample> {
        let curves = self.curves_of(positions)?;
        let deflection = self.deflection(curves.value(Quantity::MeshStiffness)?);
        Some(Sample::new(|q| curves.value(q), deflection))
    }

    /// What laws know of a run on a mesh.
    pub fn features(&self, mesh: CalibratedMesh) -> Option<Features> {
        Some(features(&self.scene, &self.pair, &self.sample(mesh)?))
    }

    /// What they know of one of so many positions.
    pub fn features_of_positions(&self, positions: u32) -> Option<Features> {
        Some(features(&self.scene, &self.pair, &self.of_positions(positions)?))
    }

    /// On infinitely fine elements less that on a mesh.
    pub fn mesh_error(&self, mesh: CalibratedMesh, quantity: Quantity) -> Option<f64> {
        let [coarse, fine] = [self.value("mesh 4", quantity)?, self.value("mesh 6", quantity)?];
        let settled = self.value("mesh 8", quantity).unwrap_or(fine + EXTRAPOLATION * (fine - coarse));
        Some(settled - self.value(&Self::of_mesh(mesh), quantity)?)
    }

    /// With four times the slices less that with those of the program's choice.
    pub fn slices_error(&self, quantity: Quantity) -> Option<f64> {
        let slices = self.samples["slices"].as_u64()?;
        Some(self.value(&format!("slices {}", 4 * slices), quantity)? - self.value("mesh 2", quantity)?)
    }

    fn curves_of(&self, positions: u32) -> Option<Curves> {
        Some(self.curves.as_ref()?.every((CURVE_POSITIONS / positions) as usize))
    }

    /// At all positions less that at some.
    pub fn positions_error(&self, positions: u32, quantity: Quantity) -> Option<f64> {
        let of = |p: u32| self.curves_of(p)?.value(quantity);
        Some(of(CURVE_POSITIONS)? - of(positions)?)
    }

    /// What some positions show of what they miss: as a run shows it.
    pub fn seen(&self, positions: u32, quantity: Quantity) -> Option<Seen> {
        let curves = self.curves_of(positions)?;
        let halved = || Some(curves.value(quantity)? - self.curves_of(positions / 2)?.value(quantity)?);
        let halved = if positions > POSITIONS { Some(halved()?) } else { None };
        let between = self.whole().between(quantity, curves.value(quantity)?, curves.between(quantity)?);
        Some(Seen::of(&between, halved))
    }

    /// What a number of a run shows of the errors of its mesh and its slices.
    pub fn number(&self, quantity: Quantity, value: f64) -> Seen {
        self.whole().number(quantity, value)
    }

    fn whole(&self) -> WholeForce {
        WholeForce::of(&self.scene, &self.pair)
    }

    /// On infinitely fine elements, slices and positions.
    pub fn exact(&self, quantity: Quantity) -> Option<f64> {
        let mesh = CalibratedMesh::Rung(2);
        let own = self.value(&Self::of_mesh(mesh), quantity)?;
        let slices = self.slices_error(quantity).unwrap_or(0.0);
        Some(own + self.mesh_error(mesh, quantity)? + slices + self.positions_error(POSITIONS, quantity)?)
    }

    /// The coarsest rung whose error is a share of the exact value at the most.
    pub fn cheapest(&self, quantity: Quantity, share: f64) -> Option<u32> {
        let exact = self.exact(quantity)?;
        let keeps = |n: &u32| {
            let error = self.mesh_error(CalibratedMesh::Rung(*n), quantity);
            error.is_some_and(|e| (e / exact).abs() <= share)
        };
        RUNGS.into_iter().find(keeps)
    }
}
