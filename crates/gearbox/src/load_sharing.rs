//! How planets share the load of a mesh that each of them has. Theory (85a), (85b).

use crate::{GearboxPosition, mesh_numbers::mean};

/// A planet's share of the load of all planets, over some positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanetShare {
    /// Mean.
    pub mean: f64,
    /// The smallest one.
    pub least: f64,
    /// The largest one.
    pub largest: f64,
}

/// Shares of planets in a mesh that each of them has, over some positions.
///
/// ```text
/// s_n = F_n/sum F,   K_gamma = N max s_n        F: sum of the normal forces, N: number of planets
/// ```
/// Theory (85a). A mesh that bears nothing at a position has no shares there.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadSharing {
    /// K_gamma: the largest share of all planets and positions over that of an even load; `None` without load.
    pub factor: Option<f64>,
    /// Shares of the planets, in the order of their meshes; none without load.
    pub planets: Vec<PlanetShare>,
}

impl LoadSharing {
    /// Of the meshes of all planets.
    pub fn of(positions: &[GearboxPosition], meshes: &[usize]) -> Self {
        let all: Vec<Vec<f64>> = positions.iter().filter_map(|p| load_shares(p, meshes)).collect();
        if all.is_empty() {
            return Self { factor: None, planets: Vec::new() };
        }
        let planet = |n: usize| {
            let own = || all.iter().map(move |shares| shares[n]);
            PlanetShare { mean: mean(own()), least: own().fold(1.0, f64::min), largest: own().fold(0.0, f64::max) }
        };
        let planets: Vec<PlanetShare> = (0..meshes.len()).map(planet).collect();
        let largest = planets.iter().map(|own| own.largest).fold(0.0, f64::max);
        Self { factor: Some(largest * meshes.len() as f64), planets }
    }
}

/// Share of each planet at a position; `None` where no mesh of them bears anything. Theory (85a).
pub fn load_shares(position: &GearboxPosition, meshes: &[usize]) -> Option<Vec<f64>> {
    let forces = || meshes.iter().filter_map(|mesh| position.meshes.get(*mesh)).map(|mesh| mesh.normal_force);
    let sum: f64 = forces().sum();
    (sum > 0.0 && forces().count() == meshes.len()).then(|| forces().map(|force| force / sum).collect())
}
