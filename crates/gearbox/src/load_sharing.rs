//! How planets share the load of their meshes, and the play that they have. Theory (85a), (85b).

use nalgebra::Vector3;

use crate::{GearMesh, GearboxPosition, Structure, mesh_numbers::mean};

/// A planet's share of the load of all planets, over several positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanetShare {
    /// Mean share.
    pub mean: f64,
    /// Smallest share.
    pub least: f64,
    /// Largest share.
    pub largest: f64,
}

/// Shares of the planets in the load of one kind of mesh, over several positions.
///
/// ```text
/// s_n = F_n/sum F,   K_gamma = N max s_n        F: sum of the normal forces, N: number of planets
/// ```
/// Theory (85a). Positions without load in these meshes have no shares.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadSharing {
    /// K_gamma: the largest share of any planet at any position, relative to an even share; `None` without load.
    pub factor: Option<f64>,
    /// Shares of the planets, in the order of their meshes; empty without load.
    pub planets: Vec<PlanetShare>,
}

impl LoadSharing {
    /// Shares in the meshes of all planets.
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

/// Share of each planet at one position; `None` if none of the meshes carries load. Theory (85a).
pub fn load_shares(position: &GearboxPosition, meshes: &[usize]) -> Option<Vec<f64>> {
    let forces = || meshes.iter().filter_map(|mesh| position.meshes.get(*mesh)).map(|mesh| mesh.normal_force);
    let sum: f64 = forces().sum();
    (sum > 0.0 && forces().count() == meshes.len()).then(|| forces().map(|force| force / sum).collect())
}

/// Play of planets between two central gears, mm along the lines of action: the play used by errors of seats, and the
/// play until flanks on the other side touch. `None` if the meshes do not have two central gears in common.
///
/// ```text
/// (max e_n - min e_n) (cos a_1 + cos a_2) <= j_1 + j_2        e_n: along the circle, mm; j: backlash on the line of action, mm
/// ```
/// Teeth and shafts are taken as rigid. `meshes` are those of all planets, in order, with either central gear. Theory
/// (85d).
pub fn planet_play(structure: &Structure, all: &[GearMesh], meshes: [&[usize]; 2]) -> Option<[f64; 2]> {
    let shafts = |mesh: &usize| Some(all.get(*mesh)?.discs.map(|disc| structure.discs[disc].shaft));
    let planets: Vec<usize> = (meshes[0].iter().zip(meshes[1]))
        .map(|(a, b)| {
            let other = shafts(b)?;
            shafts(a)?.into_iter().find(|shaft| other.contains(shaft))
        })
        .collect::<Option<_>>()?;
    let central = |mesh: &usize, planet: usize| shafts(mesh)?.into_iter().find(|shaft| *shaft != planet);
    for of in meshes {
        let gears = of.iter().zip(&planets).map(|(mesh, planet)| central(mesh, *planet)).collect::<Option<Vec<_>>>()?;
        if gears.iter().any(|gear| *gear != gears[0] || planets.contains(gear)) {
            return None;
        }
    }
    let middle = structure.shafts[central(&meshes[0][0], planets[0])?].origin;
    let along = planets.iter().map(|&planet| {
        let arm = Vector3::from(structure.shafts[planet].origin) - Vector3::from(middle);
        let off = structure.seat_offset(planet, structure.shafts.len());
        (arm.x * off.y - arm.y * off.x) / arm.x.hypot(arm.y)
    });
    let (least, most) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), e| (a.min(e), b.max(e)));
    let pairs = meshes.map(|of| &all[of[0]].pair);
    let cosines: f64 = pairs.iter().map(|pair| pair.working_pressure_angle().cos()).sum();
    Some([(most - least) * cosines, pairs.iter().map(|pair| pair.backlash()).sum()])
}
