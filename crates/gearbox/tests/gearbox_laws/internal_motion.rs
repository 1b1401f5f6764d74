//! A pinion in a ring in motion: both turn the same way, and all that holds of external pairs holds of them.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::sync::{Arc, OnceLock};

use crate::one_energy::{forces_are_slopes, is_angle};
use dynamics::{Bearing, Drive, MeshDamping, MotionOptions, RigidBody, Speed, Torque};
use gearbox::motion::{PairModel, PairMotion, instants};
use geometry::{Driver, Sense};
use integrate::{Forces, Mechanism, Scheme};
use mesh::Extent;
use nalgebra::{DVector, Matrix6};
use testing::{
    moving::{MovingPair, at_speed, machine, peak_to_peak, rows, started, worst},
    of_order, planet_in_ring,
};

const TORQUE: f64 = 300e3;
const ROWS: usize = 32;

/// 20 teeth in a ring of 52.
fn ring(driver: Driver, sense: Sense) -> MovingPair {
    let case = of_order(1, planet_in_ring(15.0), None, TORQUE, [2, 2, 2, 2, 1], Extent::Whole);
    let contact = case.slice_options().with_contact(|c| {
        c.driver = driver;
        c.sense = sense;
    });
    MovingPair::new(case, contact, 16)
}

fn bench() -> &'static MovingPair {
    static BENCH: OnceLock<MovingPair> = OnceLock::new();
    BENCH.get_or_init(|| ring(Driver::Pinion, Sense::Ccw))
}

fn motion(bench: &MovingPair, system: PairModel, scheme: Scheme) -> PairMotion {
    let times = bench.times(&system, scheme, ROWS);
    bench.motion(system, times)
}

/// Both gears on bearings that couple displacements and tilts, free but for the pinion's turn.
fn on_bearings(o: &mut MotionOptions) {
    let mut stiffness = Matrix6::from_diagonal(&[2e5, 3e5, 1e5, 4e7, 3e7, 0.0].into());
    (stiffness[(0, 4)], stiffness[(4, 0)]) = (5e5, 5e5);
    o.bearings = [Bearing { damping: stiffness * 1e-6, stiffness }; 2];
    o.free = [[true, true, true, true, true, false]; 2];
}

/// At two mesh cycles a second the dynamic transmission error is the static one.
#[test]
fn slow_running_is_quasi_static() {
    let bench = bench();
    let mut motion = motion(bench, bench.system(2.0, |_| ()), Scheme::GeneralisedAlpha { rho: 0.0 });
    rows(&mut motion, 1);
    let mut seen = Vec::new();
    motion
        .run_cycle(Some(&mut instants(|now, _, _| {
            seen.push((now.mesh.cycles.rem_euclid(1.0), now.mesh.transmission_error))
        })))
        .unwrap_or_else(|e| panic!("{e}"));
    let n = bench.ste.len();
    let off = |(phase, error): &(f64, f64)| {
        let place = phase * n as f64;
        let i = place.round() as usize % n;
        ((place - place.round()).abs() < 1e-6).then(|| (error - bench.ste[i]).abs())
    };
    let all: Vec<f64> = seen.iter().filter_map(off).collect();
    let worst = all.iter().copied().fold(0.0, f64::max) / peak_to_peak(&bench.ste);
    println!("{} places, off by {worst:.1e} of the peak to peak", all.len());
    assert!(all.len() == n && worst < 1e-3, "{} places, {worst:e}", all.len());
}

/// Either driver and either sense: the same motion, mirrored; the ring turns as the pinion does, z_1 / z_2 as fast.
#[test]
fn either_sense_and_either_driver_move_alike() {
    let of = |bench: &MovingPair| {
        let mut motion = motion(bench, bench.system(1200.0, |_| ()), Scheme::Energy);
        let mut speeds = [0.0; 2];
        motion.run_cycle(Some(&mut instants(|now, _, _| speeds = now.speeds))).unwrap_or_else(|e| panic!("{e}"));
        (rows(&mut motion, 2), speeds)
    };
    let (reference, speeds) = of(bench());
    assert!(speeds[0] > 0.0 && (speeds[1] / speeds[0] / (20.0 / 52.0) - 1.0).abs() < 0.01, "{speeds:?} rad/s");
    // The lag is that of the driven gear on its own base circle, either way.
    for (driver, sense) in [(Driver::Pinion, Sense::Cw), (Driver::Wheel, Sense::Ccw), (Driver::Wheel, Sense::Cw)] {
        let (dte, own) = of(&ring(driver, sense));
        let way = if sense == Sense::Ccw { 1.0 } else { -1.0 };
        assert!(own.iter().all(|w| w * way > 0.0), "{driver:?} {sense:?}: {own:?} rad/s");
        if driver == Driver::Pinion {
            let off = worst(&reference, &dte) / reference[0];
            println!("{driver:?} {sense:?}: off by {off:.1e}");
            assert!(off < 1e-3, "{driver:?} {sense:?}: off by {off:e}");
        }
    }
}

/// All twelve coordinates free and displaced, flanks that press: forces are the slope of the energy, power is in the
/// ledger.
#[test]
fn forces_are_the_slope_of_the_energy() {
    for friction in [0.0, 0.06] {
        let model = bench().system(300.0, |o| {
            on_bearings(o);
            o.bodies = [RigidBody { mass: 1e-3, transverse_inertia: 0.4, polar_inertia: 0.7 }; 2];
            o.free = [[true; 6]; 2];
            o.drive = Drive::Torque { start: 100.0, torque: Torque::Constant(TORQUE * 20.0 / 52.0) };
            o.damping = MeshDamping::PerLength(0.05);
            o.statics.contact.friction = friction;
        });
        let (mut system, names) = (machine(&model), model.names());
        let n = names.len();
        let mut q = DVector::from_fn(n, |i, _| if is_angle(names[i]) { 2e-4 } else { [2e-3, -3e-3, 5e-3][i % 3] });
        q[names.iter().position(|name| *name == "pinion turn").unwrap()] = 1e-4;
        q[model.lag()] = 0.03;
        let v = DVector::from_fn(n, |i, _| [0.3, -0.2, 0.5, 0.1][i % 4]);
        let mut forces = Forces::zeros(n);
        system.forces(0.0, &q, &v, &mut forces).unwrap();
        let (power, booked) = (forces.other.dot(&v), forces.supplied - forces.dissipated);
        assert!(
            (power - booked).abs() < 1e-11 * (forces.dissipated + forces.supplied.abs()),
            "{power} beside {booked}"
        );
        if friction > 0.0 {
            continue;
        }
        forces_are_slopes((&mut system, &names), &q, &forces);
    }
}

/// On bearings with friction the ledger closes, no flank pulls, and the bearings carry equal and opposite mean forces.
#[test]
fn energy_closes_with_bearings_and_friction() {
    let bench = bench();
    let system = bench.system(900.0, |o| {
        on_bearings(o);
        o.statics.contact.friction = 0.04;
    });
    assert_eq!(system.names().len(), 11);
    let mut motion = motion(bench, system, Scheme::Energy);
    rows(&mut motion, 2);
    let mut off = 0.0f64;
    motion
        .run_cycle(Some(&mut instants(|now, _, _| {
            // Action and reaction of the mesh.
            let sum = [0, 1, 2].map(|k| now.mesh.wrench[k] + now.mesh.wrench[6 + k]).map(f64::abs);
            off = off.max(sum.into_iter().fold(0.0, f64::max) / now.normal_forces()[0]);
        })))
        .unwrap_or_else(|e| panic!("{e}"));
    let ledger = *motion.ledger().unwrap();
    println!("{ledger:?}: open by {:.1e} of the turnover; action and reaction {off:.1e}", ledger.relative_residual());
    assert!(ledger.relative_residual().abs() < 1e-6, "{ledger:?}");
    assert!(off < 1e-9, "{off:e}");
    assert!(motion.system().extremes(0).least_force.unwrap() >= 0.0);
}

/// Driver and load in balance: the mean speed and the momentum of the common motion stay, and T_1 / T_2 = z_1 / z_2.
#[test]
fn a_balanced_driver_keeps_the_speed() {
    let bench = bench();
    let speed = bench.speed(800.0);
    let system = bench.system(800.0, |o| o.drive = Drive::Balanced(Speed::Constant(speed)));
    let masses = system.base_circle_masses();
    let mut motion = motion(bench, system, Scheme::Energy);
    rows(&mut motion, 3);
    let (mut speeds, mut torque, mut drift) = ([0.0; 2], 0.0, 0.0f64);
    let base = [bench.case.pair.pinion.base_radius(), -bench.case.pair.wheel.base_radius()];
    let momentum = |speeds: [f64; 2]| (0..2).map(|g| masses[g] * base[g] * speeds[g]).sum::<f64>();
    let wanted = momentum([speed, speed * 20.0 / 52.0]);
    motion
        .run_cycle(Some(&mut instants(|now, _, _| {
            (0..2).for_each(|g| speeds[g] += now.speeds[g] / ROWS as f64);
            drift = drift.max((momentum(now.speeds) / wanted - 1.0).abs());
            torque += now.drive_torque / ROWS as f64;
        })))
        .unwrap_or_else(|e| panic!("{e}"));
    println!("{speeds:?} rad/s, driver {torque:.3} N mm, momentum off by {drift:.1e}");
    assert!(drift < 1e-12, "{drift:e}");
    assert!((speeds[0] / speed - 1.0).abs() < 1e-3, "{speeds:?} rad/s, asked {speed}");
    // Damping acts along the normals of bent flanks.
    assert!((torque / (TORQUE * 20.0 / 52.0) - 1.0).abs() < 1e-5, "{torque} N mm");
    let ledger = *motion.ledger().unwrap();
    assert!(ledger.relative_residual().abs() < 1e-6, "{ledger:?}");
}

/// Without load behind them the gears part, and the coast flanks of the ring catch them: impacts on both sides of the
/// teeth, the ledger closes.
#[test]
fn coast_flanks_catch_gears_that_part() {
    let bench = bench();
    let speed = bench.speed(1000.0);
    let mut options = at_speed(bench.contact.clone(), bench.bodies, speed, TORQUE, 0.02);
    options.load = Torque::Harmonic { mean: 0.1 * TORQUE, amplitude: TORQUE, frequency_hz: 500.0, phase: 0.0 };
    let coast = Arc::new(bench.case.reduced_gears(&bench.contact.driven_backwards()));
    let driving = Arc::clone(&bench.gears);
    let system = PairModel::new(bench.case.pair.clone(), driving, Some(coast), options, bench.means);
    let system = system.unwrap_or_else(|e| panic!("{e}"));
    let (_, start) = started(&bench.system(1000.0, |o| o.load = Torque::Constant(0.1 * TORQUE)), 0.0);
    let times = bench.times(&system, Scheme::Energy, ROWS);
    let mut motion = PairMotion::new(machine(&system), times, start);
    let mut pressed = [0.0f64; 2];
    for _ in 0..6 {
        motion
            .run_cycle(Some(&mut instants(|now, _, _| {
                (0..2).for_each(|side| pressed[side] = pressed[side].max(now.normal_forces()[side]));
            })))
            .unwrap_or_else(|e| panic!("{e}"));
    }
    let (ledger, extremes) = (*motion.ledger().unwrap(), *motion.system().extremes(0));
    let (gap, open) = (extremes.largest_gap, ledger.relative_residual());
    println!("largest forces {pressed:.0?} N, gap {gap:.4} mm; open by {open:.1e}");
    assert!(pressed.iter().all(|f| *f > 100.0), "{pressed:?} N");
    assert!(ledger.relative_residual().abs() < 1e-6, "{ledger:?}");
}
