//! Laws of meshes that are the flanks themselves: a pair in held shafts is the pair alone, friction of all meshes is what
//! input and output leave, and torque goes over the backlash of both stages.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc};

use dynamics::{Bearing, MeshDamping, RigidBody, Torque as PairTorque};
use gearbox::{
    Disc, GearMesh, Machine, Meshing, Operation, Structure, Torque,
    motion::{
        Drive, GearboxInstant, GearboxMechanism, GearboxRun, MotionOptions, MovingExactMesh, MovingMesh, PairModel,
        Speed,
    },
};
use geometry::{GearPair, Sense};
use integrate::{Integrator, Mechanism, Scheme, State, StepControl};
use ltca::StaticOptions;
use nalgebra::DVector;
use reduction::ElasticGear;

use crate::pairs::{operation, options, pair, reduced, single, two_stages};

const FRICTION: f64 = 0.06;
const DAMPING_PER_LENGTH: f64 = 0.05;

/// The same gears farther apart: backlash is some 0.07 mm.
fn with_backlash(gears: &GearPair) -> GearPair {
    let apart = GearPair::new(gears.pinion.clone(), gears.wheel.clone(), Some(gears.centre_distance() + 0.1)).unwrap();
    assert!(apart.backlash() > 0.05, "{} mm", apart.backlash());
    apart
}

/// Options of a mesh as it runs with friction, and its gears, reduced for both sides.
pub fn both_flanks(pair: &GearPair, meshing: &Meshing, friction: f64) -> (StaticOptions, Arc<[ElasticGear; 2]>) {
    let options = options(pair, meshing, 1e5).with_contact(|c| c.friction = friction);
    let gears = reduced(pair, &options.clone().with_contact(|c| c.both_flanks = true));
    (options, gears)
}

/// Two rigid shafts in rigid bearings that only turn, and the exact contact between their gears, are the pair alone:
/// thrown off its equilibrium the pair rings through its backlash, slides and is damped the same way step by step.
#[test]
fn the_contact_in_held_shafts_moves_as_the_pair_alone() {
    let gears = with_backlash(&pair([23, 31], 12.0));
    let mut structure = single(&gears, 0.0);
    for (disc, polar) in structure.discs.iter_mut().zip([0.3, 0.5]) {
        (disc.mass, disc.polar_inertia, disc.diametral_inertia) = (1e-3, polar, 0.5 * polar);
    }
    let (speed, torque) = (200.0, 3e4);
    let mut operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque }]);
    operation.held = vec![0, 1];
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears.clone() }];
    let drive = Drive::Speed(Speed::Constant(speed));
    let asked = MotionOptions { drive, modal_damping: 0.0, limit: TAU * 1000.0 };
    let mut known = None;
    let made = GearboxMechanism::new(structure, meshes, operation, &asked, |_, mesh, meshing| {
        let (options, reduced) = both_flanks(&mesh.pair, meshing, FRICTION);
        let (own, coast) = (Arc::clone(&reduced), Some(Arc::clone(&reduced)));
        let element = MovingExactMesh::new(mesh.pair.clone(), own, coast, &options, DAMPING_PER_LENGTH)?;
        known = Some((options, reduced));
        Ok(Box::new(element) as Box<dyn MovingMesh>)
    });
    let mut mechanism = made.unwrap();
    let (statics, reduced) = known.unwrap();
    assert_eq!(mechanism.count(), 1);
    let polar = mechanism.mass()[(0, 0)];
    let (base, side) = (gears.wheel.base_radius(), statics.side().sign());
    let mut start = mechanism.start(0.0).unwrap();
    // The wheel is thrown back from the pinion, through the backlash.
    start.v[0] -= side * 900.0 / base;
    let step = 1.0 / mechanism.mesh_frequencies()[0] / 200.0;
    let (scheme, steps) = (Scheme::GeneralisedAlpha { rho: 0.9 }, 800);
    let plan = crate::motion::steps(scheme, [steps / 200, 200]);
    let mut found = Vec::new();
    let done =
        mechanism.run(&start, &plan, |i| found.push((i.meshes[0].transmission_error, i.meshes[0].wrench))).unwrap();
    let options = dynamics::MotionOptions {
        bodies: [RigidBody { mass: 1e-3, transverse_inertia: 1.0, polar_inertia: polar }; 2],
        bearings: [Bearing::default(); 2],
        free: [[false; 6]; 2],
        drive: dynamics::Drive::Speed(Speed::Constant(speed)),
        load: PairTorque::Constant(torque),
        damping: MeshDamping::PerLength(DAMPING_PER_LENGTH),
        start_cycles: mechanism.train().cycles(0.0)[0],
        statics,
    };
    let own = PairModel::new(gears, Arc::clone(&reduced), Some(reduced), options, [4e5, 30.0]);
    let mut own = own.and_then(|own| own.machine()).unwrap_or_else(|e| panic!("{e}"));
    let lag = |q: &DVector<f64>| q * (side * base);
    let mut state = State::new(0.0, lag(&start.q), lag(&start.v));
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(step), DVector::from_element(1, 1e-3));
    let mut wanted = vec![state.q[0]];
    let mut wrenches = vec![own.pair_instant(&state).unwrap().mesh.wrench];
    for i in 1..=steps {
        integrator.advance(&mut own, &mut state, step * i as f64, |_, _| ()).unwrap_or_else(|e| panic!("{e}"));
        wanted.push(state.q[0]);
        wrenches.push(own.pair_instant(&state).unwrap().mesh.wrench);
    }
    let size = range(&wanted);
    let off = found.iter().zip(&wanted).map(|(a, b)| (a.0 - b).abs()).fold(0.0, f64::max);
    let force = wrenches.iter().map(|w| w[0].hypot(w[1]).hypot(w[2])).fold(0.0, f64::max);
    let apart = |(a, b): (&(f64, [f64; 12]), &[f64; 12])| (0..3).map(|i| (a.1[i] - b[i]).abs()).fold(0.0, f64::max);
    let off_n = found.iter().zip(&wrenches).map(apart).fold(0.0, f64::max);
    println!("off by {off:.1e} of {size:.2e} mm and {off_n:.1e} of {force:.2e} N; {:?}", done.flanks);
    let own = done.flanks[0];
    assert!(own.contact_losses > 0 && own.coast_contacts > 0, "both flanks part: {own:?}");
    assert!(off < 1e-8 * size, "{off:.2e} mm of {size:.2e} mm");
    assert!(off_n < 1e-6 * force, "{off_n:.2e} N of {force:.2e} N");
}

fn range(values: &[f64]) -> f64 {
    let ends = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
    ends[1] - ends[0]
}

/// Two stages on shafts that bend, gears with mass, a heavy machine at the output, flanks on both sides.
pub fn two_stage_box() -> (Structure, Vec<GearMesh>, Operation) {
    let (mut structure, mut meshes) = two_stages();
    for (mesh, outer) in meshes.iter_mut().zip([[50.0, 155.0], [55.0, 140.0]]) {
        mesh.pair = with_backlash(&mesh.pair);
        for (disc, outer) in mesh.discs.into_iter().zip(outer) {
            let d = &structure.discs[disc];
            structure.discs[disc] = Disc::ring(d.name.clone(), d.shaft, d.position, [outer, 30.0], 20.0, 7.85e-9);
        }
    }
    // The axes stand as far apart as the gears do.
    let [a1, a2] = [0, 1].map(|i| meshes[i].pair.centre_distance());
    structure.shafts[1].origin = [a1, 0.0, 0.0];
    structure.shafts[2].origin = [a1 + a2 * 1.1f64.cos(), a2 * 1.1f64.sin(), 0.0];
    structure.machines = vec![Machine { name: "load".into(), disc: 5, inertia: 600.0 }];
    let operation = operation(&structure, 4, Sense::Ccw, vec![Torque { disc: 5, torque: -1e5 }]);
    (structure, meshes, operation)
}

fn run_two_stages(drive: Drive, friction: f64, cycles: u64, per_cycle: u64) -> (Vec<GearboxInstant>, GearboxRun) {
    let (structure, meshes, operation) = two_stage_box();
    let options = MotionOptions { drive, modal_damping: 0.02, limit: TAU * 2000.0 };
    let made = GearboxMechanism::new(structure, meshes, operation, &options, |_, mesh, meshing| {
        let (options, reduced) = both_flanks(&mesh.pair, meshing, friction);
        let coast = Some(Arc::clone(&reduced));
        let element = MovingExactMesh::new(mesh.pair.clone(), reduced, coast, &options, DAMPING_PER_LENGTH)?;
        Ok(Box::new(element) as Box<dyn MovingMesh>)
    });
    let mut mechanism = made.unwrap();
    let start = mechanism.start(options.modal_damping).unwrap();
    let plan = crate::motion::steps(Scheme::Energy, [cycles, per_cycle]);
    let mut rows = Vec::new();
    let done = mechanism.run(&start, &plan, |instant| rows.push(instant.clone())).unwrap();
    (rows, done)
}

/// Friction on both meshes: input less output is what is stored and what friction and dampers take, to round-off; and what
/// they take is what friction on two such meshes takes.
#[test]
fn power_lost_is_input_less_output() {
    let drive = Drive::Speed(Speed::Constant(200.0));
    let share = |friction: f64| {
        let (rows, run) = run_two_stages(drive, friction, 6, 40);
        let energy = run.energy;
        let lost = energy.dissipated / energy.input_work;
        println!("friction {friction}: {lost:.4} lost, open by {:.1e}; {energy:?}", energy.relative_residual);
        assert!(energy.relative_residual.abs() < 1e-9, "{energy:?}");
        assert!(energy.input_work > 0.0 && energy.output_work < 0.0, "{energy:?}");
        // Work of the torque that results have, by the trapezoidal rule.
        let power = |row: &GearboxInstant| row.input_torque * row.input[1];
        let work: f64 = rows.windows(2).map(|w| 0.5 * (power(&w[0]) + power(&w[1])) * (w[1].time - w[0].time)).sum();
        assert!((work / energy.input_work - 1.0).abs() < 1e-3, "{work} N mm beside {energy:?}");
        lost
    };
    let [smooth, rough] = [0.0, FRICTION].map(share);
    assert!((0.002..0.05).contains(&(rough - smooth)), "friction takes {} of the input", rough - smooth);
}

/// A train that is slowed down faster than its load runs out drives the input: both stages go through their backlash, and
/// their coast flanks carry. The energy is accounted for all the while.
#[test]
fn torque_reverses_through_the_backlash_of_both_stages() {
    let drive = Drive::Speed(Speed::Ramp { from: 200.0, to: 120.0, start: 0.0, duration: 0.02 });
    let (rows, run) = run_two_stages(drive, 0.0, 10, 60);
    let negative = rows.iter().filter(|row| row.input_torque < 0.0).count();
    println!("{} of {} rows brake, {:?}; {:?}", negative, rows.len(), run.flanks, run.energy);
    for (mesh, own) in run.flanks.iter().enumerate() {
        assert!(own.contact_losses > 0, "mesh {mesh}: {own:?}");
        let te: Vec<f64> = rows.iter().map(|row| row.meshes[mesh].transmission_error).collect();
        assert!(range(&te) > 0.05, "mesh {mesh} does not go through its backlash: {} mm", range(&te));
    }
    assert!(negative > 0, "the load never drives");
    assert!(run.energy.relative_residual.abs() < 1e-9, "{:?}", run.energy);
}
