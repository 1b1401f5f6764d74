//! Random pairs of rigid gears: every one stands still under its load somewhere, and moves from there by any method.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::{PI, TAU};

use dynamics::{Bearing, COORDINATES, Drive, RigidBody, Speed, Torque};
use geometry::{
    Driver, FlankModification, Gear, GearData, GearModifications, GearPair, Sense,
    modification::{ProfilePlace, Relief, ReliefShape},
};
use integrate::{Forces, Mechanism, Scheme, StepControl};
use lumped::impact::{ImpactLaw, ImpactMechanism, ImpactOptions, StickSlip, contact_stiffness};
use nalgebra::{Matrix6, SVector};

use testing::Random;

use crate::recording::{Recording, impacts};

const STICK_SLIP: StickSlip =
    StickSlip { static_coefficient: 0.08, dynamic_coefficient: 0.05, static_speed: 0.1, dynamic_speed: 10.0 };
const SCHEMES: [Scheme; 3] = [Scheme::Energy, Scheme::Newmark, Scheme::GeneralisedAlpha { rho: 0.8 }];

fn gear(r: &mut Random, module: f64, teeth: u32, helix: f64, width: f64) -> Option<Gear> {
    let data = GearData {
        teeth,
        normal_module: module,
        helix_angle: helix,
        face_width: width,
        profile_shift: if teeth < 18 { r.between(0.25, 0.5) } else { r.between(-0.1, 0.3) },
        thickness_allowance: r.between(0.01, 0.03) * module,
        bore_diameter: 0.4 * f64::from(teeth) * module,
        ..GearData::default()
    };
    let plain = Gear::new(data).ok()?;
    let relief = Relief {
        amount: 1e-3 * r.between(0.0, 10.0) * module,
        start: ProfilePlace::Diameter(2.0 * plain.tip_radius() - r.between(0.3, 0.9) * module),
        shape: ReliefShape::Parabolic,
    };
    let flank = FlankModification {
        tip_relief: (r.between(0.0, 1.0) < 0.5).then_some(relief),
        lead_crowning: 1e-3 * r.between(0.0, 15.0),
        lead_slope: 1e-3 * r.between(-8.0, 8.0),
        profile_crowning: 1e-3 * r.between(0.0, 8.0),
        bias: 1e-3 * r.between(-3.0, 3.0),
        ..FlankModification::default()
    };
    plain.with_modifications(GearModifications { left: flank.clone(), right: flank, pitch_errors: Vec::new() }).ok()
}

fn body(gear: &Gear) -> RigidBody {
    let (r, b) = (gear.reference_radius(), gear.face_width());
    let mass = 7.85e-9 * PI * r * r * b;
    let polar_inertia = 0.5 * mass * r * r;
    RigidBody { mass, transverse_inertia: 0.5 * polar_inertia + mass * b * b / 12.0, polar_inertia }
}

/// A pair of 12 to 60 and 13 to 90 teeth, modules 0.5 to 6, 0.1 to 1000 N m by size, all kinds of flanks; `None` where
/// the numbers make no pair.
fn scene(seed: u64) -> Option<(ImpactMechanism, f64)> {
    let r = &mut Random::new(seed);
    let module = 0.5 * r.between(0.0, 12f64.log2()).exp2();
    let helix = if r.between(0.0, 1.0) < 0.3 { 0.0 } else { r.between(3.0, 35.0).to_radians() };
    let width = module * r.between(4.0, 14.0);
    let teeth = [r.between(12.0, 60.0) as u32, r.between(13.0, 90.0) as u32];
    let gears = [gear(r, module, teeth[0], helix, width)?, gear(r, module, teeth[1], -helix, width)?];
    let [pinion, wheel] = gears;
    let pair = GearPair::new(pinion, wheel, None).ok()?;
    let bodies = [body(&pair.pinion), body(&pair.wheel)];
    let driver = if r.between(0.0, 1.0) < 0.7 { Driver::Pinion } else { Driver::Wheel };
    // From nearly nothing to what such teeth bear.
    let strength = 20.0 * module * width * pair.pinion.reference_radius();
    let load = strength * r.between(-4.0, 0.0).exp2() * 10f64.powf(r.between(-3.0, 0.0));
    let mut free = [[false; COORDINATES]; 2];
    let mut bearings = [Bearing::default(); 2];
    for (g, body) in bodies.iter().enumerate() {
        // Bodies on bearings swing at 1 to 10 kHz.
        let at = |r: &mut Random, inertia: f64| inertia * (TAU * r.between(1e3, 1e4)).powi(2);
        let [x, y, z] = [0; 3].map(|_| at(r, body.mass));
        let [rx, ry] = [0; 2].map(|_| at(r, body.transverse_inertia));
        bearings[g].stiffness = Matrix6::from_diagonal(&SVector::from([x, y, z, rx, ry, 0.0]));
        bearings[g].damping = 2e-6 * bearings[g].stiffness;
        free[g][..5].iter_mut().for_each(|f| *f = r.between(0.0, 1.0) < 0.3);
    }
    let exponent = [1.0, 1.5, 1.5, 2.2, 3.0][r.between(0.0, 5.0) as usize];
    // As stiff as two balls at an overlap of 10 um.
    let stiffness = contact_stiffness(&pair, driver, 2.06e5, 0.3).ok()? * 0.01f64.powf(1.5 - exponent);
    let rubs = r.between(0.0, 1.0) < 0.5;
    let speed_rpm = r.between(100.0, 3000.0);
    let slices = r.between(3.0, 12.0) as usize;
    let options = ImpactOptions {
        driver,
        sense: if r.between(0.0, 1.0) < 0.5 { Sense::Ccw } else { Sense::Cw },
        bodies,
        bearings,
        free,
        drive: Drive::Speed(Speed::Constant(speed_rpm * PI / 30.0)),
        load: Torque::Constant(load),
        law: ImpactLaw { stiffness, exponent, damping: r.between(0.0, 50.0), depth: 0.1 },
        friction: rubs.then_some(STICK_SLIP),
        slices,
        start_cycles: 0.0,
    };
    let driving = f64::from(teeth[usize::from(driver == Driver::Wheel)]);
    Some((ImpactMechanism::new(pair, options).ok()?, 60.0 / (speed_rpm * driving)))
}

/// Balances at phases of the cycle, then moves half a mesh cycle by each method.
///
/// Whether the seed makes a pair at all; what does not stand or move in words.
fn stands_and_moves(seed: u64, phases: u32, schemes: &[Scheme]) -> Result<bool, String> {
    let Some((model, cycle)) = scene(seed) else { return Ok(false) };
    for phase in 0..phases {
        let mut there = model.beginning_at(f64::from(phase) / f64::from(phases)).unwrap();
        let q = there.rolling_state().map_err(|e| format!("seed {seed}, phase {phase}/{phases}: {e}"))?;
        let mut forces = Forces::zeros(q.len());
        let Ok(()) = there.forces(0.0, &q, &(0.0 * &q), &mut forces);
        let scale = there.scale();
        let left = (&forces.conservative + &forces.other).component_mul(&scale).amax();
        let pressing = forces.conservative.component_mul(&scale).amax();
        if left > 1e-6 * pressing {
            return Err(format!("seed {seed}, phase {phase}: {left:e} left of {pressing:e}"));
        }
    }
    for &scheme in schemes {
        let plan = Recording {
            scheme,
            control: StepControl::Fixed(cycle / 64.0),
            settle: 0.0,
            duration: 0.5 * cycle,
            rows: 16,
        };
        let mut own = model.beginning_at(0.0).unwrap();
        let recorded = impacts(&mut own, &plan).map_err(|e| format!("seed {seed}, {scheme:?}: {e}"))?;
        if !recorded.rows.iter().all(|r| r.transmission_error_um.is_finite() && r.least_slice_force >= 0.0) {
            return Err(format!("seed {seed}, {scheme:?}: a flank pulls, or there is no number"));
        }
    }
    Ok(true)
}

/// How many of the seeds make a pair; none of them may fail.
fn all_stand_and_move(seeds: std::ops::Range<u64>, phases: u32) -> usize {
    let tried: Vec<_> = seeds.map(|seed| stands_and_moves(seed, phases, &SCHEMES)).collect();
    let failed: Vec<_> = tried.iter().filter_map(|t| t.as_ref().err()).collect();
    assert!(failed.is_empty(), "{} fail:\n{failed:#?}", failed.len());
    tried.iter().filter(|t| **t == Ok(true)).count()
}

/// Two small gears on bearings, with friction that turns round within a tenth of a mm/s.
fn small_pair() -> ImpactMechanism {
    let pinion = GearData {
        teeth: 12,
        normal_module: 0.5,
        helix_angle: 0.0,
        face_width: 4.69,
        profile_shift: 0.532,
        thickness_allowance: 0.01,
        tip_edge_radius: 0.025,
        bore_diameter: 2.4,
        ..GearData::default()
    };
    let wheel = GearData { teeth: 13, profile_shift: 0.35, tip_edge_radius: 0.0, bore_diameter: 2.6, ..pinion.clone() };
    let pair = GearPair::new(Gear::new(pinion).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
    let stiffness = Matrix6::from_diagonal(&SVector::from([4.278e4, 1.856e5, 0.0, 8.151e8, 0.0, 0.0]));
    let bearing = Bearing { stiffness, ..Bearing::default() };
    let stiffness = contact_stiffness(&pair, Driver::Pinion, 2.06e5, 0.3).unwrap();
    let options = ImpactOptions {
        driver: Driver::Pinion,
        sense: Sense::Ccw,
        bodies: [body(&pair.pinion), body(&pair.wheel)],
        bearings: [bearing, Bearing::default()],
        free: [[true, true, false, true, false, false], [false; COORDINATES]],
        drive: Drive::Speed(Speed::Constant(1805.0 * PI / 30.0)),
        load: Torque::Constant(744.215),
        law: ImpactLaw { stiffness, exponent: 1.5, damping: 50.0, depth: 0.1 },
        friction: Some(STICK_SLIP),
        slices: 8,
        start_cycles: 0.0,
    };
    ImpactMechanism::new(pair, options).unwrap()
}

/// Two mesh cycles by each method in steps of a 32nd and of a 256th: where flanks turn round at the pitch line, a whole
/// Newton step jumps from one sign of the friction to the other whatever the time step.
#[test]
fn friction_that_turns_round_has_a_solution() {
    let cycle = 60.0 / (1805.0 * 12.0);
    for scheme in SCHEMES {
        for steps in [32.0, 256.0] {
            let control = StepControl::Fixed(cycle / steps);
            let plan = Recording { scheme, control, settle: 0.0, duration: 2.0 * cycle, rows: 64 };
            let done = impacts(&mut small_pair(), &plan).unwrap_or_else(|e| panic!("{scheme:?}, {steps} steps: {e}"));
            let force: f64 = done.rows.iter().map(|r| r.normal_force[0]).sum::<f64>() / done.rows.len() as f64;
            println!("{scheme:?}, {steps} steps a cycle: mean normal force {force:.1} N");
        }
    }
}

/// 14 um of lead crowning under 0.5 N m: at the lag at which two whole pairs would carry the load nothing touches yet.
#[test]
fn light_load_on_crowned_flanks_finds_its_balance() {
    let data = GearData {
        teeth: 20,
        normal_module: 2.0,
        face_width: 12.0,
        thickness_allowance: 0.04,
        bore_diameter: 15.0,
        ..GearData::default()
    };
    let wheel = GearData { teeth: 40, helix_angle: -data.helix_angle, bore_diameter: 30.0, ..data.clone() };
    let flank = FlankModification { lead_crowning: 0.014, ..FlankModification::default() };
    let crowned = GearModifications { left: flank.clone(), right: flank, pitch_errors: Vec::new() };
    let pinion = Gear::new(data).unwrap().with_modifications(crowned).unwrap();
    let pair = GearPair::new(pinion, Gear::new(wheel).unwrap(), None).unwrap();
    let stiffness = contact_stiffness(&pair, Driver::Pinion, 2.06e5, 0.3).unwrap();
    let options = ImpactOptions {
        driver: Driver::Pinion,
        sense: Sense::Ccw,
        bodies: [body(&pair.pinion), body(&pair.wheel)],
        bearings: [Bearing::default(); 2],
        free: [[false; COORDINATES]; 2],
        drive: Drive::Speed(Speed::Constant(300.0 * PI / 30.0)),
        load: Torque::Constant(500.0),
        law: ImpactLaw { stiffness, exponent: 1.5, damping: 50.0, depth: 0.1 },
        friction: None,
        slices: 4,
        start_cycles: 0.0,
    };
    let normal = 500.0 / (pair.wheel.base_radius() * pair.base_helix_angle().cos());
    let model = ImpactMechanism::new(pair, options).unwrap();
    for phase in 0..16 {
        let mut there = model.beginning_at(f64::from(phase) / 16.0).unwrap();
        let q = there.rolling_state().unwrap_or_else(|e| panic!("phase {phase}/16: {e}"));
        let found = there.row(0.0, &q, &(0.0 * &q)).normal_force[0];
        // Tips that meet early push at other levers.
        assert!((found / normal - 1.0).abs() < 0.01, "phase {phase}/16: {found} N, not {normal} N");
    }
}

/// A few of them.
#[test]
fn random_pairs_stand_and_move() {
    let made = all_stand_and_move(0..12, 2);
    assert!(made >= 8, "{made} of 12 seeds make a pair");
}

/// Many of them, the whole mesh cycle.
#[test]
#[ignore = "a minute: run once, figures in docs/validation.md"]
fn many_random_pairs_stand_and_move() {
    let made = all_stand_and_move(100..220, 8);
    println!("{made} pairs stand still at 8 phases and move by {} methods", SCHEMES.len());
    assert!(made >= 60, "{made} of 120 seeds make a pair");
}
