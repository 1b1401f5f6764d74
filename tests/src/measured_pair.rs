//! What `measure_accuracy rest` has measured of a pair.

use analysis::accuracy::{CalibratedMesh, Features, Sample, features};
use geometry::GearPair;
use scene::{Driver, Quantity, Scene};
use serde_json::Value;

use crate::random_scene::random_scene;

/// From rungs 4 and 6 to rung 8, a little less than at order two: where rung 8 was measured it lies there.
const EXTRAPOLATION: f64 = 0.4;
/// Rungs that errors are known of.
pub const RUNGS: [u32; 4] = [2, 3, 4, 6];
/// Positions of a cycle on every mesh.
pub const POSITIONS: u32 = 8;
/// Positions that stand for all of them.
pub const FINE_POSITIONS: u32 = 64;

/// A line of its file.
#[derive(Debug, Clone)]
pub struct MeasuredPair {
    pub seed: u64,
    pub index: u64,
    pub scene: Scene,
    pair: GearPair,
    samples: Value,
}

impl MeasuredPair {
    /// Pair of a line; `None` where the pair had no result.
    pub fn new(line: &Value) -> Option<Self> {
        let (seed, index) = (line["seed"].as_u64()?, line["index"].as_u64()?);
        let scene = random_scene(seed, index);
        let pair = scene.gear_pair().ok()?;
        Some(Self { seed, index, scene, pair, samples: line.get("samples")?.clone() })
    }

    /// Whether it was solved on finer meshes too, not on the coarsest rung alone.
    pub fn has_meshes(&self) -> bool {
        self.samples.get("mesh 4").is_some()
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

    /// All numbers on a mesh.
    pub fn sample(&self, mesh: CalibratedMesh) -> Option<Sample> {
        let name = Self::of_mesh(mesh);
        let driven = match self.scene.operation.driver {
            Driver::Pinion => &self.pair.wheel,
            Driver::Wheel => &self.pair.pinion,
        };
        let force = self.scene.operation.torque() / driven.base_radius();
        let deflection = force / self.value(&name, Quantity::MeshStiffness)?;
        Some(Sample::new(|q| self.value(&name, q), deflection))
    }

    /// What laws know of a run on a mesh.
    pub fn features(&self, mesh: CalibratedMesh) -> Option<Features> {
        Some(features(&self.scene, &self.pair, &self.sample(mesh)?))
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

    /// At all positions less that at some.
    pub fn positions_error(&self, positions: u32, quantity: Quantity) -> Option<f64> {
        let of = |p: u32| self.value(&format!("positions {p}"), quantity);
        Some(of(FINE_POSITIONS)? - of(positions)?)
    }

    /// At some positions less that at half of them; 0 for the fewest.
    pub fn halved_difference(&self, positions: u32, quantity: Quantity) -> Option<f64> {
        if positions <= POSITIONS {
            return Some(0.0);
        }
        Some(self.positions_error(positions / 2, quantity)? - self.positions_error(positions, quantity)?)
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
