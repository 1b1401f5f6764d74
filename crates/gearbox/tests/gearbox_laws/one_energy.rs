//! A pair whose gears tilt has one energy: forces are its slope in every rigid coordinate, and what else acts is in the
//! ledger to round-off.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use dynamics::{Bearing, Drive, MeshDamping, MotionOptions, RigidBody, Torque};
use fem::ElementOptions;
use gearbox::motion::{GearboxMechanism, PairModel};
use integrate::{Forces, Mechanism};
use nalgebra::{DVector, Matrix6, Vector6};
use testing::{Case, moving::machine};

const TORQUE: f64 = 150e3;
const TILT_RAD: f64 = 1e-3;

/// All twelve rigid coordinates are free, on bearings that couple displacements and tilts.
fn free_pair(friction: f64) -> PairModel {
    let case = Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default());
    let mut statics = case.slice_options();
    (statics.torque, statics.contact.friction) = (TORQUE, friction);
    let mut stiffness = Matrix6::from_diagonal(&Vector6::from([2e5, 3e5, 1e5, 4e7, 3e7, 0.0]));
    (stiffness[(0, 4)], stiffness[(4, 0)]) = (5e5, 5e5);
    let bearing = Bearing { damping: stiffness * 1e-5, stiffness };
    let options = MotionOptions {
        bodies: [RigidBody { mass: 1e-3, transverse_inertia: 0.4, polar_inertia: 0.7 }; 2],
        bearings: [bearing; 2],
        free: [[true; 6]; 2],
        drive: Drive::Torque { start: 100.0, torque: Torque::Constant(TORQUE) },
        load: Torque::Constant(TORQUE),
        damping: MeshDamping::PerLength(0.05),
        start_cycles: 0.3,
        statics,
    };
    let gears = case.reduced_gears(&options.statics);
    PairModel::new(case.pair, gears, None, options, [4e5, 30.0]).unwrap_or_else(|e| panic!("{e}"))
}

/// Both gears are displaced and tilted, and the flanks press.
fn place(system: &PairModel) -> DVector<f64> {
    let tilted = |name: &&str| if name.contains("tilt") { TILT_RAD } else { 0.0 };
    let names = system.names();
    let mut q = DVector::from_iterator(names.len(), names.iter().map(tilted));
    for (i, x) in q.iter_mut().enumerate() {
        // No coordinate stays where it is special, and no two are alike.
        *x += [2e-3, -3e-3, 5e-3][i % 3] * if *x == 0.0 { 1.0 } else { 0.1 };
    }
    if let Some(i) = names.iter().position(|name| name.contains("turn")) {
        q[i] = 1e-4;
    }
    q[system.lag()] = 0.03;
    q
}

/// f = -dV/dq in all twelve coordinates of gears that are tilted by 1 mrad about both axes. A moment about z in place of
/// that about the gear's own axis, or one that the tilts count twice in, is off by some 4e-4 of the moment. What is left is
/// how the teeth's compliance follows the place of contact, which forces leave out: 1e-5 at several times the load.
#[test]
fn forces_of_tilted_gears_are_the_slope_of_the_energy() {
    let model = free_pair(0.0);
    let (mut system, q) = (machine(&model), place(&model));
    let n = q.len();
    assert_eq!(n, 12);
    let mut forces = Forces::zeros(n);
    system.forces(0.0, &q, &DVector::zeros(n), &mut forces).unwrap();
    forces_are_slopes((&mut system, &model.names()), &q, &forces);
}

/// Whether a rigid coordinate of this name is an angle.
pub fn is_angle(name: &str) -> bool {
    name.contains("tilt") || name.contains("turn")
}

/// That f = -dV/dq in every coordinate, over the largest force or moment.
pub fn forces_are_slopes((system, names): (&mut GearboxMechanism, &[&str]), q: &DVector<f64>, forces: &Forces) {
    let n = q.len();
    // Largest force, and largest moment: those of one gear have one size.
    let sizes = [false, true].map(|angle| {
        let own = (0..n).filter(|&i| is_angle(names[i]) == angle);
        own.map(|i| forces.conservative[i].abs()).fold(0.0, f64::max)
    });
    assert!(sizes[0] > 1e3 && sizes[1] > 1e4, "{sizes:?}");
    for (i, name) in names.iter().enumerate() {
        let h = if is_angle(name) { 2e-8 } else { 1e-6 };
        let energy = |system: &mut GearboxMechanism, sign: f64| {
            let mut there = q.clone();
            there[i] += sign * h;
            system.potential(0.0, &there).unwrap()
        };
        let slope = (energy(system, 1.0) - energy(system, -1.0)) / (2.0 * h);
        let off = (slope + forces.conservative[i]) / sizes[usize::from(is_angle(name))];
        println!("{name}: force {:.6e}, off the slope of the energy by {off:.1e}", forces.conservative[i]);
        assert!(off.abs() < 3e-5, "{name}: {} beside a slope of {slope}", forces.conservative[i]);
    }
}

/// Power of friction, dampers, drive and load is what the ledger supplies less what it takes.
#[test]
fn all_power_on_tilted_gears_is_in_the_ledger() {
    let model = free_pair(0.06);
    let (mut system, q) = (machine(&model), place(&model));
    let n = q.len();
    let v = DVector::from_fn(n, |i, _| [0.3, -0.2, 0.5, 0.1][i % 4]);
    let mut forces = Forces::zeros(n);
    system.forces(0.0, &q, &v, &mut forces).unwrap();
    let (power, booked) = (forces.other.dot(&v), forces.supplied - forces.dissipated);
    println!("power {power:.9e}, in the ledger {booked:.9e}, of it {:.3e} taken", forces.dissipated);
    assert!(forces.dissipated > 0.0);
    assert!((power - booked).abs() < 1e-11 * (forces.dissipated + forces.supplied.abs()), "{power} beside {booked}");
}
