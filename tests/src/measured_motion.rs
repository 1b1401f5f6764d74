//! What `accuracy measure motion` has measured of a pair at a speed.

use scene::Quantity;
use serde_json::Value;

use crate::law_fit::Case;

/// Steps of second order: what half of them leave, over what they change.
const RICHARDSON: f64 = 1.0 / 3.0;

/// Mesh frequency over the resonance from which on 64 rows in a mesh cycle are more steps than are compared.
const ROWS_AS_STEPS: f64 = 0.5;

/// A line of its file.
#[derive(Debug, Clone)]
pub struct MeasuredMotion {
    pub seed: u64,
    pub index: u64,
    /// Mesh frequency over the mesh resonance.
    pub speed: f64,
    /// Mesh frequency over the lowest elastic frequency.
    pub elastic_ratio: f64,
    elastic_share: f64,
    line: Value,
}

impl MeasuredMotion {
    /// Motion of a line; `None` where the pair had no result.
    pub fn new(line: Value) -> Option<Self> {
        let of = |key: &str| line[key].as_f64();
        let (speed, elastic_ratio, elastic_share) = (of("speed")?, of("elastic_ratio")?, of("elastic_share")?);
        Some(Self {
            seed: line["seed"].as_u64()?,
            index: line["index"].as_u64()?,
            speed,
            elastic_ratio,
            elastic_share,
            line,
        })
    }

    /// A number of a run, as `reduced 16`; `None` where it has none, or does not repeat itself.
    pub fn value(&self, run: &str, q: Quantity) -> Option<f64> {
        let run = &self.line["runs"][run];
        run[q.key()].as_f64().filter(|_| run["periodicity"].as_f64().is_some_and(|p| p < 0.01))
    }

    /// With steps as fine as there are.
    fn reduced(&self, q: Quantity) -> Option<f64> {
        let coarse = self.value("reduced 16", q)?;
        Some(self.value("reduced 32", q).map_or(coarse, |fine| fine + RICHARDSON * (fine - coarse)))
    }

    /// Sixteen steps in a period of the resonance, beside eight.
    pub fn step(&self, q: Quantity) -> Option<Case> {
        let own = self.value("reduced 16", q)?;
        self.value("reduced 32", q).filter(|_| self.speed < ROWS_AS_STEPS)?;
        Some(Case { difference: own - self.value("reduced 8", q)?, error: self.reduced(q)? - own, scale: own })
    }

    /// Elasticity without inertia, beside what theory (63) says of it.
    pub fn elasticity(&self, q: Quantity) -> Option<Case> {
        let own = self.reduced(q)?;
        Some(Case { difference: self.elastic_share * own, error: self.value("reduced+modes 6", q)? - own, scale: own })
    }

    /// Twelve coordinates, beside what the motion adds to the number at rest; flanks that part are not theirs.
    pub fn lumped12(&self, q: Quantity) -> Option<Case> {
        let own = self.value("lumped12 16", q)?;
        let rest = self.line["ste"][q.key()].as_f64()?;
        let holds = self.line["runs"]["lumped12 16"]["least_force"].as_f64()? > 0.0;
        holds.then_some(Case { difference: own - rest, error: self.value("reduced 16", q)? - own, scale: own })
    }
}
