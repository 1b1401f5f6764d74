//! What `measure_accuracy` has measured of a pair.

use analysis::accuracy::goes_with_deflection;
use scene::Quantity;
use serde_json::Value;

/// Rungs 4 and 6 to infinitely fine elements, at order two: 1 / ((6/4)^2 - 1).
const EXTRAPOLATION: f64 = 0.8;
/// Rungs that are measured.
const RUNGS: [u32; 5] = [2, 3, 4, 6, 8];

/// A line of its file.
#[derive(Debug, Clone)]
pub struct MeasuredPair {
    pub seed: u64,
    pub index: u64,
    samples: Value,
    scene: Value,
}

impl MeasuredPair {
    /// Of a line; `None` where the pair had no result.
    pub fn new(line: Value) -> Option<Self> {
        let (seed, index) = (line["seed"].as_u64()?, line["index"].as_u64()?);
        Some(Self { seed, index, samples: line.get("samples")?.clone(), scene: line.get("scene")?.clone() })
    }

    /// What errors of a quantity are measured against, as the program does.
    pub fn scale(&self, quantity: Quantity) -> Option<f64> {
        if !goes_with_deflection(quantity) {
            return Some(self.value("mesh 4", quantity)?.abs());
        }
        let of = |key: &str| self.scene[key].as_f64();
        let helix = of("beta")?.to_radians();
        let pressure = (of("alpha")?.to_radians().tan() / helix.cos()).atan();
        let wheel = 0.5 * of("m")? * self.scene["teeth"][1].as_f64()? / helix.cos() * pressure.cos();
        Some(1e3 * of("torque")? / wheel / self.value("mesh 4", Quantity::MeshStiffness)?)
    }

    /// A number of a sample.
    pub fn value(&self, sample: &str, quantity: Quantity) -> Option<f64> {
        self.samples[sample][quantity.key()].as_f64()
    }

    /// Slices that the program has chosen.
    pub fn slices(&self) -> Option<u64> {
        self.samples["slices"].as_u64()
    }

    /// On infinitely fine elements, with the slices and positions of all meshes.
    pub fn settled(&self, quantity: Quantity) -> Option<f64> {
        let [coarse, fine] = [self.value("mesh 4", quantity)?, self.value("mesh 6", quantity)?];
        Some(self.value("mesh 8", quantity).unwrap_or(fine + EXTRAPOLATION * (fine - coarse)))
    }

    /// The same with four times the slices and positions, as the coarsest mesh shows it.
    pub fn exact(&self, quantity: Quantity) -> Option<f64> {
        let of = |sample: &str| self.value(sample, quantity);
        let finer = of(&format!("slices {} sparse", 4 * self.slices()?));
        let slices = finer.map_or(0.0, |finer| finer - of("mesh 2 sparse").unwrap_or(finer));
        let positions = of("positions 128")? - of("positions 32")?;
        Some(self.settled(quantity)? + slices + positions)
    }

    /// The coarsest rung whose error is a share of the exact value at the most.
    pub fn cheapest(&self, quantity: Quantity, share: f64) -> Option<u32> {
        let exact = self.exact(quantity)?;
        let keeps =
            |n: &u32| self.value(&format!("mesh {n}"), quantity).is_some_and(|v| (v / exact - 1.0).abs() <= share);
        RUNGS.into_iter().find(keeps)
    }
}
