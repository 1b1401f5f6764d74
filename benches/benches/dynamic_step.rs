//! Steps of the default pair in motion: time of one, and how that stands to the time it simulates; see
//! `benches/README.md`.
#![allow(clippy::print_stdout, reason = "the table is what the bench is for")]

use std::{f64::consts::TAU, time::Instant};

use ale::Station;
use dynamics::{Bearing, Drive, MeshDamping, MotionOptions, RigidBody, Speed, Torque};
use gearbox::motion::{GearboxMechanism, PairModel};
use integrate::{Integrator, Scheme, StepControl};
use nalgebra::Matrix6;
use testing::{default_data, quadratic};

const TORQUE: f64 = 150e3;
const SPEED_RPM: f64 = 1000.0;
const STEPS_PER_CYCLE: usize = 64;
/// Mesh cycles before those that are timed, and these: of a motion that settles, and of one that repeats itself.
const SPANS: [[usize; 2]; 2] = [[1, 4], [16, 4]];

fn main() {
    println!("Default pair at {SPEED_RPM} /min, {STEPS_PER_CYCLE} steps a mesh cycle, slices, one core.");
    println!(
        "\n| free coordinates | scheme | motion | step, us | steps/s | simulated over wall time |\n|---|---|---|---|---|---|"
    );
    let schemes = [
        ("generalised-alpha", Scheme::GeneralisedAlpha { rho: 0.8 }),
        ("energy", Scheme::Energy),
        ("Dormand-Prince", Scheme::DormandPrince),
    ];
    for (name, free) in [("turn of the wheel", [false; 6]), ("all of both gears", [true; 6])] {
        for (scheme_name, scheme) in schemes {
            for (motion, (step, ratio)) in ["settles", "repeats itself"].into_iter().zip(run(free, scheme)) {
                println!("| {name} | {scheme_name} | {motion} | {:.0} | {:.0} | {ratio:.3} |", 1e6 * step, 1.0 / step);
            }
        }
    }
}

/// Wall time of a step, s, and simulated over wall time, in either span.
fn run(free: [bool; 6], scheme: Scheme) -> [(f64, f64); 2] {
    let case = quadratic(default_data(20.0), None, TORQUE, [4, 3, 4, 8, 2], mesh::Extent::Periodic);
    let contact = case.slice_options();
    let mut model = case.reduced(contact.clone());
    let at_rest = model.solve(Station { cycle: 0, phase: 0.0 }).expect("a sound pair");
    let bodies = [0, 1].map(|i| {
        let m = fem::mass_properties(case.meshes[i].mesh(), &fem::Material::STEEL).expect("a sound mesh");
        // Thirty sectors.
        let whole = 30.0;
        RigidBody::of_tensor(whole * m.mass_t, m.inertia_about_tmm2([0.0; 3]).map(|row| row.map(|x| whole * x)))
    });
    // Bearings of 2e5 N/mm and 1e8 N mm; the gear's own turn is free.
    let stiffness = Matrix6::from_diagonal(&[2e5, 2e5, 2e5, 1e8, 1e8, 0.0].into());
    let bearing = Bearing { stiffness, damping: 1e-6 * stiffness };
    let speed = SPEED_RPM * TAU / 60.0;
    let options = MotionOptions {
        statics: contact.clone(),
        bodies,
        bearings: [bearing; 2],
        free: [free; 2],
        drive: Drive::Speed(Speed::Constant(speed)),
        load: Torque::Constant(TORQUE),
        damping: MeshDamping::Ratio(0.05),
        start_cycles: 0.0,
    };
    let means = [at_rest.tangent_stiffness, at_rest.contact_line_length];
    let gears = case.reduced_gears(&contact);
    let model = PairModel::new(case.pair.clone(), gears, None, options, means).expect("a sound pair");
    let mut system = model.machine().expect("a sound pair");
    let mut state = system.start(0.0).expect("a balance");
    let period = case.pair.pinion.pitch_angle() / speed;
    let step = StepControl::Fixed(period / STEPS_PER_CYCLE as f64);
    let mut integrator = Integrator::new(scheme, step, model.scale(at_rest.transmission_error));
    let mut until = |cycles: usize, system: &mut GearboxMechanism| {
        let end = cycles as f64 * period;
        integrator.advance(system, &mut state, end, |_, _| ()).unwrap_or_else(|e| panic!("{e}"));
    };
    SPANS.map(|[warm, timed]| {
        until(warm, &mut system);
        let start = Instant::now();
        until(warm + timed, &mut system);
        let wall = start.elapsed().as_secs_f64();
        (wall / (timed * STEPS_PER_CYCLE) as f64, timed as f64 * period / wall)
    })
}
