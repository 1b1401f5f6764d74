//! Motion of planetary stages of which a member is fixed in space: balance of energy and torques whichever member that is,
//! slow motion beside rest, and planets that are flung outwards.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use gearbox::{
    Disc, GearMesh, Operation, StaticGearbox, Structure, Torque,
    motion::{Drive, GearboxInstant, GearboxMechanism, GearboxRun, MotionOptions, Speed, SpringMesh},
};
use geometry::Sense;
use integrate::Scheme;
use lumped::Fourier;
use nalgebra::Vector3;

use crate::{
    motion::steps,
    pairs::{operation, springs},
    planets::{Carried, STAGE, Stage},
};

/// Members; the ratio of ring and sun is 2.
const SUN: usize = 0;
const RING: usize = 1;
const CARRIER: usize = 2;
const RATIO: f64 = 2.0;
/// Torque of the sun, N mm.
const TORQUE: f64 = 4e5;

/// The stage on pins with heavy gears; `roles`: input, output, fixed member.
fn parts(stage: Stage, [input, output, fixed]: [usize; 3], torque: f64) -> (Structure, Vec<GearMesh>, Operation) {
    let (mut structure, meshes, run) = Stage { carried: Carried::Pins, ..stage }.parts();
    let shaft = [0, 1, 2 + stage.count];
    for (disc, size) in
        [(0, [120.0, 40.0]), (1, [300.0, 250.0])].into_iter().chain((0..stage.count).map(|n| (2 + n, [60.0, 40.0])))
    {
        let own = structure.discs[disc].clone();
        structure.discs[disc] = Disc::ring(own.name, own.shaft, own.position, size, 20.0, 7.85e-9);
    }
    for bearing in &mut structure.bearings {
        if bearing.outer.is_none() && bearing.shaft == shaft[CARRIER] {
            bearing.stiffness[(5, 5)] = 0.0;
        }
        if bearing.shaft == shaft[fixed] {
            bearing.stiffness[(5, 5)] = 1e9;
        }
    }
    let (at_input, at_output) = (run.input, run.torques[0].disc);
    structure.discs[at_input] = Disc::seat("input", shaft[input], 0.0);
    structure.discs[at_output] = Disc::seat("output", shaft[output], 60.0);
    structure.fixed = (fixed != CARRIER).then_some(shaft[fixed]);
    if fixed == CARRIER {
        let own = structure.bearings.iter_mut().find(|b| b.outer.is_none() && b.shaft == shaft[CARRIER]);
        own.unwrap().stiffness[(5, 5)] = 1e9;
    }
    let sign = -speed_of([input, output, fixed], output).signum();
    let load = Torque { disc: at_output, torque: sign * torque * [1.0, RATIO, 1.0 + RATIO][output] };
    let run = operation(&structure, at_input, Sense::Ccw, vec![load]);
    (structure, meshes, run)
}

/// Rotations of a member in space a rotation of the input.
fn speed_of([input, _, fixed]: [usize; 3], member: usize) -> f64 {
    // n_s + u n_r = (1 + u) n_c.
    let weight = [1.0, RATIO, -(1.0 + RATIO)];
    let third = 3 - input - fixed;
    match member {
        own if own == input => 1.0,
        own if own == third => -weight[input] / weight[third],
        _ => 0.0,
    }
}

fn mechanism(stage: Stage, roles: [usize; 3], drive: Drive, torque: f64, stiffness: &Fourier) -> GearboxMechanism {
    let (structure, meshes, run) = parts(stage, roles, torque);
    let options = MotionOptions { drive, modal_damping: 0.01, limit: TAU * 3000.0 };
    let made = GearboxMechanism::new(structure, meshes, run, &options, |_, mesh, meshing| {
        Ok(Box::new(SpringMesh::new(mesh, meshing, stiffness.clone())?.with_damping(5.0)))
    });
    made.unwrap_or_else(|e| panic!("{roles:?}: {e}"))
}

fn varying() -> Fourier {
    Fourier { mean: 4e5, cosine: vec![4e4], sine: vec![2e4] }
}

fn run(mechanism: &mut GearboxMechanism, cycles: u64) -> (Vec<GearboxInstant>, GearboxRun) {
    let start = mechanism.start(0.01).unwrap_or_else(|e| panic!("{e}"));
    let mut rows = Vec::new();
    let run = mechanism.run(&start, &steps(Scheme::Energy, [cycles, 60]), |instant| rows.push(instant.clone()));
    (rows, run.unwrap_or_else(|e| panic!("{e}")))
}

/// Whichever member is fixed: energy is accounted for to 1e-9, what the input does by its torque is what the ledger says, its
/// torque is that of the ratios in the mean, and the output turns by the ratio in space.
#[test]
fn any_member_is_input_output_or_fixed_in_motion() {
    let constant = Drive::Speed(Speed::Constant(150.0));
    let ramp = Drive::Speed(Speed::Ramp { from: 80.0, to: 160.0, start: 0.0, duration: 0.05 });
    let free = Drive::Torque { start: 150.0, torque: None };
    let balanced = Drive::Balanced(Speed::Constant(150.0));
    let all = [
        ([SUN, CARRIER, RING], constant),
        ([SUN, CARRIER, RING], ramp),
        ([SUN, CARRIER, RING], free),
        ([SUN, CARRIER, RING], balanced),
        ([CARRIER, SUN, RING], constant),
        ([RING, CARRIER, SUN], constant),
        ([CARRIER, RING, SUN], free),
        ([SUN, RING, CARRIER], constant),
    ];
    for (roles, drive) in all {
        let mut mechanism = mechanism(Stage { off: 2e-3, ..STAGE }, roles, drive, TORQUE, &varying());
        let (rows, done) = run(&mut mechanism, testing::cases(8, 20) as u64);
        let energy = done.energy;
        let said = format!("{roles:?}, {drive:?}: {energy:?}");
        assert!(energy.relative_residual.abs() < 1e-9, "{said}");
        assert!(energy.output_work < 0.0 && energy.input_work > 0.0 && energy.dissipated > 0.0, "{said}");
        let power = |p: &GearboxInstant| p.input_torque * p.input[1];
        let work: f64 = rows.windows(2).map(|w| 0.5 * (power(&w[0]) + power(&w[1])) * (w[1].time - w[0].time)).sum();
        let off = (work - energy.input_work) / energy.input_work.max(energy.kinetic);
        let last = &rows[rows.len() - 1];
        println!("{roles:?}: residual {:.1e}, work off by {off:.1e}", energy.relative_residual);
        assert!(off.abs() < 2e-3, "{work} beside {said}");
        let wanted = speed_of(roles, roles[1]) * last.input[1];
        assert!((last.output_speeds[0] / wanted - 1.0).abs() < 0.05, "{:?} beside {wanted}", last.output_speeds);
        if matches!(drive, Drive::Speed(Speed::Constant(_))) {
            let mean = rows.iter().map(|p| p.input_torque).sum::<f64>() / rows.len() as f64;
            let wanted = TORQUE * [1.0, RATIO, 1.0 + RATIO][roles[0]];
            assert!((mean / wanted - 1.0).abs() < 0.01, "{mean} N mm beside {wanted}: {said}");
        }
    }
}

/// In slow motion bearings carry what they do at rest: seats that do not turn with the carrier differ from those that do by the
/// lag of the carrier, which a light load leaves small.
#[test]
fn slow_motion_is_rest() {
    for roles in [[SUN, CARRIER, RING], [CARRIER, RING, SUN]] {
        let stage = Stage { off: 0.0, ..STAGE };
        let (structure, meshes, run) = parts(stage, roles, 1e-3 * TORQUE);
        let mut rest = StaticGearbox::new(structure, meshes, run, springs).unwrap_or_else(|e| panic!("{e}"));
        let rest = rest.solve(0.0).unwrap_or_else(|e| panic!("{e}"));
        let drive = Drive::Speed(Speed::Constant(1e-3));
        let mut slow = mechanism(stage, roles, drive, 1e-3 * TORQUE, &Fourier::constant(4e5));
        let start = slow.start(0.0).unwrap_or_else(|e| panic!("{e}"));
        let found = slow.instant(&start).unwrap_or_else(|e| panic!("{e}"));
        let largest = rest.bearings.iter().map(|b| Vector3::from(b.force).norm()).fold(0.0, f64::max);
        for (a, b) in rest.bearings.iter().zip(&found.bearings) {
            let off = (Vector3::from(a.force) - Vector3::from(b.force)).norm() / largest;
            assert!(off < 1e-4, "{roles:?}: {:?} and {:?} N, {off:e}", a.force, b.force);
        }
        let off = (found.input_torque / rest.input_torque - 1.0).abs();
        println!("{roles:?}: torque off by {off:.1e}");
        assert!(off < 1e-6, "{} beside {} N mm", found.input_torque, rest.input_torque);
    }
}

/// Bearings hold planets on their circle with m W^2 r beside what the meshes ask for, of all three alike, to 1e-3: bodies give
/// way by that much, and meshes take a share.
#[test]
fn planets_are_flung_outwards_by_the_turn_of_the_carrier() {
    let roles = [SUN, CARRIER, RING];
    let held = |speed: f64| -> Vec<Vector3<f64>> {
        let drive = Drive::Speed(Speed::Constant(speed));
        // Meshes that hardly hold planets radially.
        let mut own = mechanism(STAGE, roles, drive, 1e-2 * TORQUE, &Fourier::constant(1e3));
        let start = own.start(0.0).unwrap_or_else(|e| panic!("{e}"));
        let found = own.instant(&start).unwrap_or_else(|e| panic!("{e}"));
        let bearings = &own.assembly().structure().bearings;
        let of = |n: usize| bearings.iter().zip(&found.bearings).filter(move |(b, _)| b.shaft == 2 + n);
        (0..STAGE.count).map(|n| of(n).map(|(_, state)| Vector3::from(state.force)).sum()).collect()
    };
    let speed = 600.0;
    let (slow, fast) = (held(1e-3), held(speed));
    let (structure, ..) = parts(STAGE, roles, TORQUE);
    let frame = speed / (1.0 + RATIO);
    for n in 0..STAGE.count {
        let place = structure.shafts[2 + n].origin;
        let body = whole_mass(&structure, 2 + n);
        let pulled = fast[n] - slow[n];
        let wanted = -body * frame * frame * Vector3::new(place[0], place[1], 0.0);
        println!("planet {n}: {:.3?} N beside {:.3?} N", pulled.as_slice(), wanted.as_slice());
        assert!((pulled - wanted).norm() < 1e-2 * wanted.norm(), "{pulled} beside {wanted}");
    }
}

/// Mass of a shaft with its discs, t.
fn whole_mass(structure: &Structure, shaft: usize) -> f64 {
    let discs: f64 = structure.discs.iter().filter(|d| d.shaft == shaft).map(|d| d.mass).sum();
    let of_piece = |p: &fem::beam::BeamPiece| p.section.mass_per_length() * p.length;
    discs + structure.shafts[shaft].pieces.iter().map(of_piece).sum::<f64>()
}
