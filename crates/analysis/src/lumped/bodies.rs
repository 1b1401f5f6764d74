//! Bodies, supports and torques of the scene in the form of the lumped models.

use ::lumped::{Fourier, FourierTorque, lumped8::Support8, lumped12::Support12};
use dynamics::{Bearing, Drive, RigidBody, Torque};
use geometry::GearPair;
use scene::{Axis, GearScene, Scene, TorqueScene};
use std::f64::consts::{PI, TAU};

use crate::motion::{bearing, drive, stated_body, torque};

/// Pinion and wheel: what the scene states, else a ring from bore to reference diameter.
pub(super) fn bodies(stated: [&GearScene; 2], pair: &GearPair) -> [RigidBody; 2] {
    let gears = [&pair.pinion, &pair.wheel];
    [0, 1].map(|i| {
        let (gear, stated) = (gears[i], stated[i]);
        let (outer, inner) = (gear.reference_radius(), 0.5 * stated.bore_diameter_mm);
        let (b, squares) = (gear.face_width(), outer * outer + inner * inner);
        let mass = stated.material.density() * PI * (outer * outer - inner * inner) * b;
        let ring = RigidBody {
            mass,
            transverse_inertia: mass * (3.0 * squares + b * b) / 12.0,
            polar_inertia: 0.5 * mass * squares,
        };
        stated_body(&stated.body.clone().unwrap_or_default(), ring)
    })
}

/// Bearings of pinion and wheel.
pub(super) fn bearings(gears: [&GearScene; 2], bodies: &[RigidBody; 2]) -> [Bearing; 2] {
    [0, 1].map(|i| {
        let gear = gears[i];
        let free: &[Axis] = gear.body.as_ref().map_or(&[], |b| &b.free);
        bearing(&gear.bearing, free, &bodies[i])
    })
}

/// Supports with eight coordinates, of pinion and wheel.
pub(super) fn supports8(gears: [&GearScene; 2], bodies: &[RigidBody; 2]) -> [Support8; 2] {
    let all = bearings(gears, bodies);
    [0, 1].map(|i| {
        let (stated, b) = (&gears[i].bearing, &all[i]);
        Support8 {
            stiffness: [0, 1, 2].map(|k| b.stiffness[(k, k)]),
            damping: [0, 1, 2].map(|k| b.damping[(k, k)]),
            turning_stiffness: stated.stiffness_rz_nmm_per_rad.unwrap_or(0.0),
            turning_damping: stated.damping_rz_nmms_per_rad.unwrap_or(0.0),
        }
    })
}

/// Supports with twelve.
pub(super) fn supports12(gears: [&GearScene; 2]) -> [Support12; 2] {
    gears.map(|gear| {
        let [x, y, z, rx, ry] = gear.bearing.stiffnesses().map(|k| k.unwrap_or(0.0));
        Support12 { stiffness: [x, y, z, rx, ry, gear.bearing.stiffness_rz_nmm_per_rad.unwrap_or(0.0)] }
    })
}

/// Torque on the driver and load on the driven gear, N mm. A driver whose speed is given balances the mean load.
pub(super) fn torques(scene: &Scene, pair: &GearPair, balanced: f64) -> [FourierTorque; 2] {
    let load = torque(scene.load.as_ref().unwrap_or(&TorqueScene::default()), scene.operation.torque());
    let driving = match drive(scene, pair) {
        Drive::Torque { torque, .. } => series(&torque),
        Drive::Speed(_) | Drive::Balanced(_) => FourierTorque::constant(balanced),
    };
    [driving, series(&load)]
}

/// T_0 + T_1 cos(omega t + phase) as a series; a table, which scenes of these models do not have, by its first value.
fn series(torque: &Torque) -> FourierTorque {
    match *torque {
        Torque::Harmonic { mean, amplitude, frequency_hz, phase } => FourierTorque {
            series: Fourier::first_order(mean, amplitude * phase.cos(), -amplitude * phase.sin()),
            angular_frequency: TAU * frequency_hz,
        },
        _ => FourierTorque::constant(torque.at(0.0)),
    }
}
