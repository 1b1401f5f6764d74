//! The pair of seed 001, a gear box of a rolling mill.

use std::f64::consts::PI;

use dynamics::{Bearing, Drive, RigidBody, Speed, Torque};
use geometry::{Driver, Gear, GearData, GearPair, Sense};
use lumped::impact::{ImpactLaw, ImpactOptions, StickSlip};

/// Load on the 30-tooth gear, N mm.
pub const LOAD: f64 = 260e6;
/// Speed of the 41-tooth gear, rad/s: 6000 deg/s.
pub const SPEED: f64 = 6000.0 * PI / 180.0;

pub fn pair() -> GearPair {
    let small = GearData {
        teeth: 30,
        normal_module: 25.0,
        helix_angle: 14f64.to_radians(),
        face_width: 350.0,
        thickness_allowance: 0.0,
        bore_diameter: 300.0,
        ..GearData::default()
    };
    let big = GearData { teeth: 41, helix_angle: -small.helix_angle, ..small.clone() };
    GearPair::new(Gear::new(small).unwrap(), Gear::new(big).unwrap(), None).unwrap()
}

/// Solid disc of the reference diameter, 7.8e-9 t/mm^3.
fn body(gear: &Gear) -> RigidBody {
    let (r, b) = (gear.reference_radius(), gear.face_width());
    let mass = 7.8e-9 * PI * r * r * b;
    let polar_inertia = 0.5 * mass * r * r;
    RigidBody { mass, transverse_inertia: 0.5 * polar_inertia + mass * b * b / 12.0, polar_inertia }
}

/// As the seed has it: rigid shafts, the big gear drives by a step ramp from rest over `ramp` (s).
pub fn options(pair: &GearPair, ramp: f64) -> ImpactOptions {
    ImpactOptions {
        driver: Driver::Wheel,
        sense: Sense::Ccw,
        bodies: [body(&pair.pinion), body(&pair.wheel)],
        bearings: [Bearing::default(); 2],
        free: [[false; 6]; 2],
        drive: Drive::Speed(Speed::Ramp { from: 0.0, to: SPEED, start: 0.0, duration: ramp }),
        load: Torque::Constant(LOAD),
        law: ImpactLaw { stiffness: 1.35e6, exponent: 2.2, damping: 50.0, depth: 0.1 },
        friction: Some(StickSlip {
            static_coefficient: 0.08,
            dynamic_coefficient: 0.05,
            static_speed: 0.1,
            dynamic_speed: 10.0,
        }),
        slices: 21,
        start_cycles: 0.0,
    }
}
