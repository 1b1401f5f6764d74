//! The seeds' pairs.

use std::f64::consts::{PI, TAU};

use dynamics::RigidBody;
use geometry::{Driver, Gear, GearData, GearPair, Sense};
use lumped::{
    Fourier, LumpedPair, MeshCycle, Operation,
    lumped8::{Lumped8, MeshLaw, Support8},
    lumped12::{Lumped12, Support12},
};

pub fn pair(teeth: [u32; 2], data: GearData, centre_distance: Option<f64>) -> GearPair {
    let gear = |i: usize| {
        let helix_angle = if i == 0 { data.helix_angle } else { -data.helix_angle };
        Gear::new(GearData { teeth: teeth[i], helix_angle, thickness_allowance: 0.0, ..data.clone() }).unwrap()
    };
    GearPair::new(gear(0), gear(1), centre_distance).unwrap()
}

/// Seed 004: z 30/90, m_n 3, 20 deg, beta 10 deg right hand, b 60.
pub fn gears_004() -> GearPair {
    pair(
        [30, 90],
        GearData {
            normal_module: 3.0,
            helix_angle: 10f64.to_radians(),
            face_width: 60.0,
            bore_diameter: 30.0,
            ..GearData::default()
        },
        None,
    )
}

/// Seed 003 by the parameters of the validation notes: m_n 1.5057, alpha_n 15 deg, beta 30.25 deg, b 27.09; addendum
/// for eps_alpha 2.00.
pub fn gears_003(helix_deg: f64) -> GearPair {
    let data = GearData {
        normal_module: 1.5057,
        normal_pressure_angle: 15f64.to_radians(),
        helix_angle: helix_deg.to_radians(),
        face_width: 27.09,
        addendum_coefficient: 1.141,
        dedendum_coefficient: 1.45,
        bore_diameter: 40.0,
        ..GearData::default()
    };
    pair([86, 82], data, None)
}

/// 5 kg and 45 kg, inertia of a disc of the base circle's radius (the 2 of the seed's dimensionless equations): J = M
/// r_b^2 / 2.
pub fn bodies_004(gears: &GearPair) -> [RigidBody; 2] {
    [(0.005, &gears.pinion), (0.045, &gears.wheel)].map(|(mass, gear)| {
        let disc = 0.5 * mass * gear.base_radius().powi(2);
        RigidBody { mass, transverse_inertia: 0.5 * disc, polar_inertia: disc }
    })
}

pub fn operation(torque: f64, friction: f64) -> Operation {
    Operation { driver: Driver::Pinion, sense: Sense::Ccw, speed: 1000.0 * TAU / 60.0, torque, friction }
}

/// Seed 004: K 5e9 +- 0.2e9 N/m along the normal, 300 / 900 N m, 1000/min.
pub fn pair_004(friction: f64) -> LumpedPair {
    let gears = gears_004();
    let cos = gears.base_helix_angle().cos();
    let cycle = MeshCycle::new(Fourier::first_order(5.0e6 * cos, 0.2e6 * cos, 0.0), Fourier::default());
    LumpedPair::new(&gears, &operation(900e3, friction), bodies_004(&gears), cycle).unwrap()
}

/// The seed says nothing of supports and damping: 5e8 N/m, and 2 % of them at their own frequency; mesh damping ratio
/// 0.07.
pub fn seed_004(law: MeshLaw, friction: f64) -> Lumped8 {
    let pair = pair_004(friction);
    let support = |mass: f64| {
        let k = 5e5;
        Support8 { stiffness: [k; 3], damping: [2.0 * 0.02 * f64::sqrt(k * mass); 3], ..Support8::default() }
    };
    let supports = [support(0.005), support(0.045)];
    Lumped8::new(pair, supports, 0.07, 0.1, law).unwrap()
}

/// Seed 003: k 1.5e8 +- 2e7 N/m along the normal, e = 1 um sin, no load, driver at 1000/min, alpha_ij 75.5 deg; steel
/// discs.
pub fn pair_003(helix_deg: f64, sense: Sense, friction: f64) -> LumpedPair {
    let gears = gears_003(helix_deg);
    let cos2 = gears.base_helix_angle().cos().powi(2);
    let cycle =
        MeshCycle::new(Fourier::first_order(1.5e5 * cos2, 0.0, 2.0e4 * cos2), Fourier::first_order(0.0, 0.0, 1e-3));
    let operation = Operation { driver: Driver::Pinion, sense, speed: 1000.0 * TAU / 60.0, torque: 0.0, friction };
    let bodies = [&gears.pinion, &gears.wheel].map(|gear| {
        let (r, b) = (gear.reference_radius(), gear.face_width());
        let mass = 7.85e-9 * PI * r * r * b;
        RigidBody { mass, transverse_inertia: mass * (3.0 * r * r + b * b) / 12.0, polar_inertia: 0.5 * mass * r * r }
    });
    let mut pair = LumpedPair::new(&gears, &operation, bodies, cycle).unwrap();
    pair.frame.orientation = 75.5f64.to_radians();
    pair
}

/// Supports of seed 003 (it gives none): 1e5 N/mm, a fiftieth softer along global x, 1e8 N mm/rad against tilting; 3 %
/// damping between 400 and 4000 Hz.
pub fn seed_003(helix_deg: f64, sense: Sense, friction: f64) -> Lumped12 {
    let stiffness = [0.98e5, 1e5, 1e5, 1e8, 1e8, 0.0];
    Lumped12::new(pair_003(helix_deg, sense, friction), [Support12 { stiffness }; 2], 0.03, [400.0 * TAU, 4000.0 * TAU])
        .unwrap()
}

/// Largest difference of two lists over the largest entry of the first.
pub fn relative(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = a.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size
}
