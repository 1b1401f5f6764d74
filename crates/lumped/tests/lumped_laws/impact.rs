//! Rigid gears on their true flanks: the laws of the model, and seed 001.
//!
//! Normal force of seed 001: T / (r_b cos b_b) = 7.378e5 N. The paper prints 7.89e5 N as theory; its formula 2 T / (d
//! cos a_n cos b) needs d = 722 mm for that, and the 30-tooth gear's reference diameter is 773 mm.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::{PI, TAU};

use dynamics::{Drive, Speed, Torque};
use geometry::{Driver, Sense};
use integrate::{Forces, Mechanism, Scheme, StepControl};
use lumped::impact::{ImpactMechanism, ImpactOptions, ImpactRow, contact_stiffness};
use nalgebra::{DVector, Matrix6, SVector};

use crate::{
    mill,
    recording::{Recorded, Recording, impacts},
};

/// T / (r_b cos b_b), N.
fn normal_force() -> f64 {
    let pair = mill::pair();
    mill::LOAD / (pair.pinion.base_radius() * pair.base_helix_angle().cos())
}

fn run(h: f64, settle: f64, duration: f64) -> Recording {
    Recording {
        scheme: Scheme::GeneralisedAlpha { rho: 0.8 },
        control: StepControl::Fixed(h),
        settle,
        duration,
        rows: (duration / h).round() as usize,
    }
}

fn model(change: impl FnOnce(&mut ImpactOptions)) -> ImpactMechanism {
    let pair = mill::pair();
    let mut options = mill::options(&pair, 0.3);
    change(&mut options);
    ImpactMechanism::new(pair, options).unwrap()
}

/// All coordinates of both gears on soft bearings, the driver turned by a torque.
fn free(o: &mut ImpactOptions) {
    o.free = [[true; 6]; 2];
    for b in &mut o.bearings {
        b.stiffness = Matrix6::from_diagonal(&SVector::from([2e6, 1.5e6, 1e6, 5e11, 4e11, 0.0]));
        b.damping = 1e-4 * b.stiffness;
    }
    o.drive = Drive::Torque { start: mill::SPEED, torque: Torque::Constant(mill::LOAD * 41.0 / 30.0) };
}

/// Amplitude at `frequency` (Hz) of samples `h` apart.
fn amplitude(samples: &[f64], h: f64, frequency: f64) -> f64 {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let n = samples.len() as f64;
    let (mut re, mut im) = (0.0, 0.0);
    for (k, x) in samples.iter().enumerate() {
        // Hann's window: the run is not cut to whole cycles.
        let window = 1.0 - (TAU * (k as f64 + 0.5) / n).cos();
        let (sin, cos) = (TAU * frequency * h * k as f64).sin_cos();
        re += (x - mean) * window * cos;
        im += (x - mean) * window * sin;
    }
    2.0 * re.hypot(im) / n
}

/// What must be true of a run of the seed: mean force, no pull, no coast contact, speed, peaks of the spectrum at
/// multiples of the mesh frequency.
fn judge(rows: &[ImpactRow], h: f64, from: f64) {
    let wanted = normal_force();
    let steady: Vec<&ImpactRow> = rows.iter().filter(|r| r.time > from).collect();
    let force: Vec<f64> = steady.iter().map(|r| r.normal_force[0]).collect();
    let mean = force.iter().sum::<f64>() / force.len() as f64;
    let turning = steady.iter().map(|r| r.speed[0]).sum::<f64>() / steady.len() as f64 / TAU;
    let (low, high) = force.iter().fold((f64::INFINITY, 0.0f64), |(a, b), &f| (a.min(f), b.max(f)));
    println!(
        "mean {mean:.0} N ({:+.2} % of {wanted:.0}), {low:.0} .. {high:.0} N, output {turning:.3} Hz",
        100.0 * (mean / wanted - 1.0)
    );
    assert!((mean / 7.378e5 - 1.0).abs() < 0.01, "mean normal force {mean} N");
    assert!((turning.abs() - 22.78).abs() < 0.005, "output {turning} Hz");
    assert!(rows.iter().all(|r| r.least_slice_force >= 0.0), "flanks pull");
    assert!(rows.iter().all(|r| r.normal_force[1] == 0.0), "coast flanks strike");
    let bin = 1.0 / (h * force.len() as f64);
    let mesh = 41.0 * 6000.0 / 360.0;
    let all: Vec<f64> = (1..(3.5 * mesh / bin) as usize).map(|i| amplitude(&force, h, i as f64 * bin)).collect();
    for multiple in 1..=3 {
        let place = f64::from(multiple) * mesh;
        let near = |i: &usize| ((*i as f64 + 1.0) * bin - place).abs() < 0.4 * mesh;
        let peak = (0..all.len()).filter(near).max_by(|&a, &b| all[a].total_cmp(&all[b])).unwrap();
        let found = (peak as f64 + 1.0) * bin;
        println!("{multiple} f_m = {place:.2} Hz: peak at {found:.2} Hz, {:.0} N, bin {bin:.2} Hz", all[peak]);
        assert!((found - place).abs() <= bin, "peak at {found} Hz, not {place}");
    }
    let largest = all.iter().copied().fold(0.0, f64::max);
    let at_mesh = all[((mesh / bin).round() as usize) - 1];
    assert!(at_mesh > 0.5 * largest, "the mesh frequency is not among the largest peaks: {at_mesh} N of {largest} N");
}

/// The start: from the static equilibrium along (T + J alpha) / (r_b cos b_b), with what the first mesh resonance adds
/// on the way; nothing is thrown off.
fn judge_ramp(rows: &[ImpactRow], duration: f64) {
    let pair = mill::pair();
    let ramp = Speed::Ramp { from: 0.0, to: mill::SPEED, start: 0.0, duration };
    let inertia = mill::options(&pair, duration).bodies[0].polar_inertia;
    let of = |t: f64| normal_force() * (1.0 + inertia * ramp.acceleration(t) * 41.0 / 30.0 / mill::LOAD);
    let first = rows[0].normal_force[0];
    assert!((first / normal_force() - 1.0).abs() < 0.005, "the run begins with {first} N");
    let (mut sum, mut expected, mut worst) = (0.0, 0.0, [f64::INFINITY, 0.0f64]);
    for r in rows.iter().filter(|r| r.time <= duration) {
        let quasi_static = of(r.time);
        sum += r.normal_force[0];
        expected += quasi_static;
        let ratio = r.normal_force[0] / quasi_static;
        worst = [worst[0].min(ratio), worst[1].max(ratio)];
    }
    println!("ramp: {:.3} to {:.3} of the quasi-static force, mean {:.4}", worst[0], worst[1], sum / expected);
    assert!((sum / expected - 1.0).abs() < 0.015 && worst[0] > 0.7 && worst[1] < 1.3, "{worst:?}");
    // Before the mesh reaches its first resonance there is nothing but the load.
    let early = rows.iter().filter(|r| r.time < 0.15 * duration).map(|r| (r.normal_force[0] / of(r.time) - 1.0).abs());
    let early = early.fold(0.0, f64::max);
    assert!(early < 0.03, "off by {early} in the first moments");
}

/// K = 4/3 sqrt(R) E* with the seed's data (E 2.1e5 MPa, nu 0.29): 1.371e6; printed 1.35e6.
#[test]
fn stiffness_formula_gives_the_reference_number() {
    let found = contact_stiffness(&mill::pair(), Driver::Wheel, 2.1e5, 0.29).unwrap();
    println!("K = {found:.4e} N/mm^1.5");
    assert!((found / 1.371e6 - 1.0).abs() < 5e-4, "{found:e}");
    assert!(contact_stiffness(&mill::pair(), Driver::Wheel, -1.0, 0.29).is_err());
    assert!(contact_stiffness(&mill::pair(), Driver::Wheel, 2.1e5, 1.0).is_err());
}

/// Seed 001 shortened: ramp of 0.1 s, 0.25 s after it, 13 slices. Sixteen steps a mesh cycle: what slices that come and
/// go leave above half the sampling rate folds back onto multiples of the mesh frequency and not between them.
#[test]
fn seed_001_shortened() {
    let mut model = model(|o| {
        o.drive = Drive::Speed(Speed::Ramp { from: 0.0, to: mill::SPEED, start: 0.0, duration: 0.1 });
        o.slices = 13;
    });
    let h = 360.0 / (41.0 * 6000.0 * 16.0);
    let rows = impacts(&mut model, &run(h, 0.0, 0.45)).unwrap().rows;
    judge(&rows, h, 0.2);
}

/// Seed 001 as it is: 2 s in 20000 steps, ramp of 0.3 s, 33 slices; half a minute of one core.
#[test]
#[ignore = "half a minute: run once, figures in docs/validation.md"]
fn seed_001_whole() {
    let rows = impacts(&mut model(|o| o.slices = 33), &run(1e-4, 0.0, 2.0)).unwrap().rows;
    assert_eq!(rows.len(), 20_000);
    judge_ramp(&rows, 0.3);
    judge(&rows, 1e-4, 0.4);
}

/// Ramp of the seed, 7 slices.
#[test]
fn start_is_without_a_jolt() {
    let rows = impacts(&mut model(|o| o.slices = 7), &run(2e-4, 0.0, 0.3)).unwrap().rows;
    judge_ramp(&rows, 0.3);
}

/// Without friction the torque alone says what the mean force is; with it the sliding teeth take their share, less than
/// 1 %.
#[test]
fn friction_raises_the_mean_force() {
    let mean = |with: bool| {
        let mut model = model(|o| {
            o.drive = Drive::Speed(Speed::Constant(mill::SPEED));
            o.slices = 9;
            if !with {
                o.friction = None;
            }
        });
        let cycle = 1.0 / (41.0 * 6000.0 / 360.0);
        let rows = impacts(&mut model, &run(cycle / 16.0, 100.0 * cycle, 20.0 * cycle)).unwrap().rows;
        rows.iter().map(|r| r.normal_force[0]).sum::<f64>() / rows.len() as f64 / normal_force()
    };
    let [without, with] = [false, true].map(mean);
    println!("mean normal force over T/(r_b cos b_b): {without:.5} without friction, {with:.5} with");
    // Tips that meet early push at other levers: a thousandth or two.
    assert!((without - 1.0).abs() < 0.003 && with > without && with < 1.01, "{without}, {with}");
}

/// A place with all twelve coordinates displaced, tips among the contacts.
fn displaced(n: usize, phase: f64) -> DVector<f64> {
    let of = |i: usize| (1.7 * i as f64 + phase).sin();
    DVector::from_fn(n, |i, _| of(i))
}

/// Elastic forces are the slopes of the potential, and both tangents those of the forces: flanks, tip edges, tilted
/// gears.
#[test]
fn forces_are_slopes_of_the_potential_and_tangents_of_the_forces() {
    let mut model = model(|o| {
        free(o);
        o.slices = 9;
    });
    let n = model.coordinates().count();
    assert_eq!(n, 12);
    let scale = model.scale();
    let base = model.static_state().unwrap();
    for case in 0..6 {
        let t = 1e-4 * f64::from(case);
        let q = &base + 0.3 * displaced(n, f64::from(case)).component_mul(&scale);
        let v = 500.0 * displaced(n, 3.0 + f64::from(case)).component_mul(&scale);
        let mut at = |q: &DVector<f64>, v: &DVector<f64>| {
            let mut out = Forces::zeros(n);
            let Ok(()) = model.forces(t, q, v, &mut out);
            let Ok(potential) = model.potential(t, q);
            (out, potential)
        };
        let (here, _) = at(&q, &v);
        let size = here.conservative.component_mul(&scale).amax();
        for j in 0..n {
            let mut step = DVector::zeros(n);
            step[j] = 1e-5 * scale[j];
            let [(up, high), (down, low)] = [at(&(&q + &step), &v), at(&(&q - &step), &v)];
            let slope = -(high - low) / (2.0 * step[j]);
            let off = (here.conservative[j] - slope) * scale[j] / size;
            // A tip edge of the wheel is met at a height of the pinion, and slides along that edge when a gear moves.
            assert!(off.abs() < 1e-3, "case {case}, coordinate {j}: force {}, slope {slope}", here.conservative[j]);
            let [(fast, _), (slow, _)] = [at(&q, &(&v + 1e3 * &step)), at(&q, &(&v - 1e3 * &step))];
            for i in 0..n {
                let by_place = -(up.total(i) - down.total(i)) / (2.0 * step[j]);
                let off = (here.stiffness[(i, j)] - by_place) * scale[i] * scale[j] / size;
                // Levers and normals that turn with the gears are left out of the tangent.
                assert!(
                    off.abs() < 0.02,
                    "case {case}, stiffness {i}, {j}: {}, not {by_place}",
                    here.stiffness[(i, j)]
                );
                let by_rate = -(fast.total(i) - slow.total(i)) / (2e3 * step[j]);
                let off = (here.damping[(i, j)] - by_rate) * scale[i] * scale[j] * 1e3 / size;
                assert!(off.abs() < 1e-4, "case {case}, damping {i}, {j}: {}, not {by_rate}", here.damping[(i, j)]);
            }
        }
    }
}

/// Flanks press on both gears alike: forces cancel, moments balance about any point, and friction takes power from what
/// slides.
#[test]
fn both_gears_feel_the_same() {
    let mut model = model(free);
    let n = model.coordinates().count();
    let q = model.static_state().unwrap() + 0.2 * displaced(n, 1.0).component_mul(&model.scale());
    let d = model.coordinates().displacement(&q);
    let [driving, _] = model.flank_forces(0.0, &d, &SVector::zeros());
    let a = model.pair().centre_distance();
    let w = driving.wrench();
    let [f1, f2] = [0, 6].map(|at| nalgebra::Vector3::new(w[at], w[at + 1], w[at + 2]));
    let [m1, m2] = [3, 9].map(|at| nalgebra::Vector3::new(w[at], w[at + 1], w[at + 2]));
    let [c1, c2] = [0, 6].map(|at| nalgebra::Vector3::new(d[at] + if at == 6 { a } else { 0.0 }, d[at + 1], d[at + 2]));
    assert!((f1 + f2).norm() < 1e-9 * f1.norm(), "{f1} and {f2}");
    let about_origin = m1 + m2 + c1.cross(&f1) + c2.cross(&f2);
    assert!(about_origin.norm() < 1e-9 * m1.norm(), "{about_origin}");
    let speeds = model.speeds(0.0);
    let power = driving.friction[5] * speeds[0] + driving.friction[11] * speeds[1];
    let through = mill::LOAD * speeds[0].abs();
    println!("friction takes {:.3} % of the power", -100.0 * power / through);
    assert!(power < 0.0 && -power < 0.05 * through, "{power} of {through}");
}

/// After a million turns, across tooth z-1 to 0, nothing is different; other hand of rotation and other driver the same
/// in the mirror.
#[test]
fn turns_and_mirrors_change_nothing() {
    let rows = |change: &dyn Fn(&mut ImpactOptions)| {
        let mut model = model(|o| {
            o.slices = 9;
            o.drive = Drive::Speed(Speed::Constant(mill::SPEED));
            change(o);
        });
        impacts(&mut model, &run(1e-4, 0.0, 0.01)).unwrap().rows
    };
    let given = rows(&|o| o.start_cycles = 0.25);
    let later = rows(&|o| o.start_cycles = 0.25 + 41.0 * 30.0 * 1e4);
    let middle = rows(&|o| o.start_cycles = 0.25 + 29.0);
    let mirrored = rows(&|o| (o.start_cycles, o.sense) = (0.25, Sense::Cw));
    for (name, other, tolerance) in
        [("later", &later, 1e-6), ("other teeth", &middle, 1e-9), ("other sense", &mirrored, 1e-6)]
    {
        for (a, b) in given.iter().zip(other) {
            let off = a.transmission_error_um / b.transmission_error_um - 1.0;
            assert!(
                off.abs() < tolerance,
                "{name}, {} s: {} and {} um",
                a.time,
                a.transmission_error_um,
                b.transmission_error_um
            );
        }
    }
    let pinion = rows(&|o| (o.start_cycles, o.driver) = (0.25, Driver::Pinion));
    assert!(pinion.iter().all(|r| r.normal_force[0] > 0.0 && r.normal_force[1] == 0.0));
}

/// The load turns round: teeth leave the driving flanks, strike the coast flanks and carry there. No slice ever pulls,
/// and the ledger closes.
#[test]
fn torque_reversal_strikes_the_coast_flanks() {
    let mut model = model(|o| {
        o.slices = 7;
        o.drive = Drive::Speed(Speed::Constant(mill::SPEED));
        let (times, values) = (vec![0.01, 0.02], vec![mill::LOAD, -mill::LOAD]);
        o.load = Torque::Table { times, values };
    });
    let schemes = [(Scheme::Energy, 1e-4, 1e-8), (Scheme::GeneralisedAlpha { rho: 1.0 }, 5e-5, 2e-2)];
    for (scheme, h, tolerance) in schemes {
        let run = Recording { scheme, ..run(h, 0.0, 0.1) };
        let Recorded { rows, ledger, .. } = impacts(&mut model, &run).unwrap();
        let last = &rows[rows.len() - 1];
        let open = ledger.relative_residual();
        let struck = rows.iter().map(|r| r.normal_force[1]).fold(0.0, f64::max);
        println!(
            "{scheme:?}: coast flanks up to {struck:.0} N, {:.0} N at the end; energy open by {open:.1e}",
            last.normal_force[1]
        );
        assert!(
            rows.iter().all(|r| r.least_slice_force >= 0.0 && r.normal_force.iter().all(|f| *f >= 0.0)),
            "flanks pull"
        );
        assert!(rows[10].normal_force[1] == 0.0 && last.normal_force[0] == 0.0 && last.normal_force[1] > 0.0);
        assert!(rows.iter().any(|r| r.normal_force == [0.0, 0.0]) || struck > 1.2 * normal_force(), "no impact at all");
        assert!(open.abs() < tolerance, "{scheme:?}: energy open by {open:e}");
    }
}

/// Gears on bearings, the driver turned by a torque: twelve coordinates; forces hover about the static ones.
#[test]
fn twelve_coordinates_run() {
    let mut model = model(|o| {
        free(o);
        o.slices = 7;
    });
    let Recorded { rows, state, .. } = impacts(&mut model, &run(1e-4, 0.0, 0.03)).unwrap();
    let mean = rows.iter().map(|r| r.normal_force[0]).sum::<f64>() / rows.len() as f64;
    println!("mean {mean:.0} N; axial displacement {:.3} mm", state.q[2]);
    assert!((mean / normal_force() - 1.0).abs() < 0.05 && rows.iter().all(|r| r.normal_force[0] > 0.0), "{mean}");
    // The axial bearing carries F_a = F_bt tan b_b.
    let pair = mill::pair();
    let axial = normal_force() * pair.base_helix_angle().sin();
    let q = model.static_state().unwrap();
    let found = (1e6 * model.coordinates().displacement(&q)[2]).abs();
    assert!((found / axial - 1.0).abs() < 0.01, "{found} N on the axial bearing, not {axial}");
}

#[test]
fn nonsense_is_refused() {
    type Change = fn(&mut ImpactOptions);
    let cases: [(&str, Change); 14] = [
        ("mass", |o| o.bodies[0].mass = 0.0),
        ("inertia", |o| o.bodies[1].polar_inertia = f64::NAN),
        ("bearing", |o| o.bearings[0].stiffness[(0, 0)] = -1.0),
        ("bearing off the diagonal", |o| o.bearings[0].stiffness[(0, 1)] = f64::INFINITY),
        ("speed", |o| o.drive = Drive::Speed(Speed::Constant(f64::NAN))),
        ("ramp", |o| o.drive = Drive::Speed(Speed::Ramp { from: 0.0, to: 1.0, start: 0.0, duration: 0.0 })),
        ("load", |o| o.load = Torque::Constant(f64::NAN)),
        ("table", |o| o.load = Torque::Table { times: vec![0.0, 1.0], values: vec![1.0] }),
        ("stiffness", |o| o.law.stiffness = 0.0),
        ("exponent", |o| o.law.exponent = 0.5),
        ("depth", |o| o.law.depth = 0.0),
        ("friction", |o| o.friction.as_mut().unwrap().static_coefficient = -0.1),
        ("slip speeds", |o| o.friction.as_mut().unwrap().dynamic_speed = 0.05),
        ("slices", |o| o.slices = 0),
    ];
    for (name, change) in cases {
        let pair = mill::pair();
        let mut options = mill::options(&pair, 0.3);
        change(&mut options);
        let refused = ImpactMechanism::new(pair, options).expect_err(name);
        assert!(!refused.to_string().is_empty() && refused.hint().is_some(), "{name}");
    }
    let options = mill::options(&mill::pair(), 0.3);
    let text = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<ImpactOptions>(&text).unwrap(), options);
    assert!((6000.0 * PI / 180.0 - mill::SPEED).abs() < 1e-12);
}

/// The contact lines of seed 001 are longer under its load than those of rigid gears that just touch (581.1 mm in the
/// mean): its flanks overlap by 0.6 mm, and flanks that overlap reach beyond the path of contact at the tips, on lines
/// that no unloaded gears have. As the load goes to zero the length goes to the analytic one.
#[test]
fn lines_are_those_of_geometry_as_the_load_vanishes() {
    const PHASES: usize = 8;
    let mean = |share: f64| {
        let model = model(|o| {
            o.slices = 33;
            o.drive = Drive::Speed(Speed::Constant(mill::SPEED));
            o.load = Torque::Constant(share * mill::LOAD);
            o.friction = None;
        });
        let at = |k: usize| {
            let mut there = model.beginning_at(k as f64 / PHASES as f64).unwrap();
            let q = there.static_state().unwrap();
            let row = there.row(0.0, &q, &DVector::zeros(q.len()));
            [row.contact_line_length, row.overlap[0]]
        };
        let all: Vec<[f64; 2]> = (0..PHASES).map(at).collect();
        [0, 1].map(|i| all.iter().map(|x| x[i]).sum::<f64>() / PHASES as f64)
    };
    let mut last = f64::INFINITY;
    for share in [1.0, 1e-2, 1e-4, 1e-6, 1e-8] {
        let [length, overlap] = mean(share);
        println!("{share:e} of the load: {length:.1} mm, overlap {overlap:.2e} mm");
        assert!(length <= last, "{share} of the load: {length} mm, {last} mm under more");
        last = length;
    }
    // One slice of 33 is 11 mm; eight phases of its coming and going leave 2 %.
    assert!((last / 581.1 - 1.0).abs() < 0.02, "{last} mm, 581.1 mm by geometry");
}

/// The static transmission error is that of gears at rest: neither damping nor friction, nor the speed, has a part in it.
/// The balance of the rolling gears, where a run begins, goes with damping.
#[test]
fn gears_at_rest_know_no_damping() {
    let at = |damping: f64, speed: f64| {
        let mut model = model(|o| {
            o.slices = 9;
            o.law.damping = damping;
            o.drive = Drive::Speed(Speed::Constant(speed));
            if damping == 0.0 {
                o.friction = None;
            }
        });
        let lag = model.coordinates().lag();
        [model.static_state().unwrap()[lag], model.rolling_state().unwrap()[lag]]
    };
    let [still, _] = at(0.0, mill::SPEED);
    for (damping, speed) in [(50.0, mill::SPEED), (1e5, mill::SPEED), (1e5, 0.1 * mill::SPEED)] {
        let [found, _] = at(damping, speed);
        assert!((found / still - 1.0).abs() < 1e-12, "damping {damping}, {speed} rad/s: {found} mm, not {still}");
    }
    let [_, rolling] = at(1e5, mill::SPEED);
    assert!(
        (rolling / still - 1.0).abs() > 1e-2,
        "flanks that roll into contact are damped: {rolling} mm, {still} at rest"
    );
}
