//! Normal modes beside the rigid bodies: the same at rest, exact forces, no trace of a tooth change, and where the low-frequency approximation ends.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

mod support;

use std::sync::Arc;

use dynamics::{
    Bulk, ElasticGear, StaticOptions, Station,
    motion::{Forces, Integrator, Mechanism, Scheme, State, StepControl},
    pair_motion::{
        Bearing, Drive, ElasticRatio, GearVibration, LOW_FREQUENCY_LIMIT, MeshDamping, MotionOptions, PairMechanism,
        RigidBody, Speed, Torque, quasi_static_start,
    },
};
use fem::ElementOptions;
use nalgebra::{DMatrix, DVector};
use reduction::ModeChoice;
use support::Case;

const TORQUE: f64 = 150e3;

fn coarse() -> Case {
    Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default())
}

fn bodies(case: &Case) -> [RigidBody; 2] {
    [0, 1].map(|i| {
        let m = fem::mass_properties(case.meshes[i].mesh(), &support::steel()).unwrap();
        RigidBody::of_tensor(m.mass_t, m.inertia_about_tmm2([0.0; 3]))
    })
}

fn options(case: &Case, contact: StaticOptions, speed: f64, zeta: f64) -> MotionOptions {
    MotionOptions {
        contact,
        bodies: bodies(case),
        bearings: [Bearing::default(); 2],
        free: [[false; 6]; 2],
        drive: Drive::Speed(Speed::Constant(speed)),
        load: Torque::Constant(TORQUE),
        damping: MeshDamping::Ratio(zeta),
        start_cycles: 0.0,
    }
}

/// STE (mm) at phase 0, mean tangent stiffness (N/mm) and line length (mm).
fn statics(case: &Case, contact: &StaticOptions) -> (f64, [f64; 2]) {
    let mut model = case.reduced(contact.clone());
    let p = model.solve(Station { cycle: 0, phase: 0.0 }).unwrap_or_else(|e| panic!("{e}"));
    (p.transmission_error, [p.tangent_stiffness, p.contact_line_length])
}

fn vibrations(gears: &[ElasticGear; 2], choice: ModeChoice, damping_ratio: f64) -> [GearVibration; 2] {
    gears.each_ref().map(|gear| {
        let ElasticGear::Reduced(reducer) = gear else { panic!("not a reduced gear") };
        GearVibration { modes: Arc::new(reducer.modes(choice).unwrap()), damping_ratio }
    })
}

/// The pair without and with modes.
fn both(case: &Case, options: MotionOptions, means: [f64; 2], choice: ModeChoice) -> [PairMechanism; 2] {
    let gears = case.reduced_gears(&options.contact);
    let modes = vibrations(&gears, choice, 0.01);
    let gears = Arc::new(gears);
    let make = || PairMechanism::new(case.pair.clone(), Arc::clone(&gears), None, options.clone(), means).unwrap();
    [make(), make().with_modes(modes).unwrap_or_else(|e| panic!("{e}"))]
}

fn scale(system: &PairMechanism) -> DVector<f64> {
    system.scales(&DVector::from_element(system.coordinates().count(), 1e-2), 1e-2)
}

/// At rest modes and residual make up the whole compliance: the same transmission error with modes as without, by tables and by matrices, with friction and without.
#[test]
fn modes_change_nothing_at_rest() {
    let case = coarse();
    let plain = case.slice_options();
    for (name, contact) in [
        ("tables", plain.clone()),
        ("matrices", StaticOptions { bulk: Bulk::Exact, ..plain.clone() }),
        ("friction", StaticOptions { friction: 0.06, ..plain }),
    ] {
        let (ste, means) = statics(&case, &contact);
        let systems = both(&case, options(&case, contact, 1e-6, 0.05), means, ModeChoice::Count(12));
        let [a, b] = systems.map(|mut system| {
            let s = scale(&system);
            quasi_static_start(&mut system, 0.0, ste, &s).unwrap_or_else(|e| panic!("{name}: {e}")).q[0]
        });
        println!("{name}: {:.6} um without, {:.2e} of it more with 24 modes", 1e3 * a, b / a - 1.0);
        assert!((b / a - 1.0).abs() < 1e-8, "{name}: {b} mm with modes, {a} mm without");
    }
}

/// Forces are the gradient of the potential in all coordinates, and tangents that of the forces; all rigid coordinates free, gears turned on.
#[test]
fn forces_and_tangents_are_derivatives() {
    let case = coarse();
    let contact = case.slice_options();
    let (ste, means) = statics(&case, &contact);
    let k = 1e5 * nalgebra::Matrix6::from_diagonal(&[1.0, 1.0, 1.0, 1e3, 1e3, 0.0].into());
    let bearing = Bearing { stiffness: k, ..Bearing::default() };
    let held = options(&case, contact, 1.0, 0.0);
    let free = MotionOptions { free: [[true; 6]; 2], bearings: [bearing; 2], start_cycles: 7.3, ..held };
    let [_, mut system] = both(&case, free, means, ModeChoice::Count(5));
    let n = system.count();
    let rigid = system.coordinates().scales(1e-2, 45.0);
    let s = system.scales(&rigid, 1e-2);
    let mut q = quasi_static_start(&mut system, 0.0, ste, &s).unwrap().q;
    // Anywhere near, so that no force vanishes.
    for i in 0..n {
        q[i] += 0.02 * s[i] * ((3 * i) as f64).sin();
    }
    let mut forces = Forces::zeros(n);
    let still = DVector::zeros(n);
    system.forces(0.0, &q, &still, &mut forces).unwrap();
    let (mut worst_force, mut worst_tangent) = (0.0f64, 0.0f64);
    // Over sizes of coordinates: work, which may be compared between forces and moments.
    let work = forces.conservative.component_mul(&s).amax();
    let stiff = (0..n).map(|i| forces.stiffness[(i, i)] * s[i] * s[i]).fold(0.0, f64::max);
    for i in 0..n {
        let step = 1e-4 * s[i];
        let [(up, f_up), (down, f_down)] = [0, 1].map(|side| {
            let mut moved = q.clone();
            moved[i] += if side == 0 { step } else { -step };
            let mut f = Forces::zeros(n);
            system.forces(0.0, &moved, &still, &mut f).unwrap();
            (system.potential(0.0, &moved).unwrap(), f.conservative)
        });
        let slope = -(up - down) / (2.0 * step);
        worst_force = worst_force.max((slope - forces.conservative[i]).abs() * s[i] / work);
        let change = f_up - f_down;
        for j in 0..n {
            let slope = -change[j] / (2.0 * step);
            worst_tangent = worst_tangent.max((slope - forces.stiffness[(j, i)]).abs() * s[i] * s[j] / stiff);
        }
    }
    println!("{n} coordinates: forces off by {worst_force:.1e}, tangents by {worst_tangent:.1e} of the largest");
    assert!(worst_force < 2e-3 && worst_tangent < 1e-2, "{worst_force:e}, {worst_tangent:e}");
}

/// Over tooth changes force goes on to round-off, mode coordinates are not touched at all, and the energy ledger closes.
#[test]
fn tooth_change_leaves_no_trace_in_the_modes() {
    let case = coarse();
    let contact = case.slice_options();
    let (ste, means) = statics(&case, &contact);
    // Mesh frequency 1 kHz.
    let speed = 1e3 * case.pair.pinion.pitch_angle();
    let [_, mut system] = both(&case, options(&case, contact, speed, 0.05), means, ModeChoice::Count(8));
    let s = scale(&system);
    let mut state = quasi_static_start(&mut system, 0.0, ste, &s).unwrap();
    let mut integrator = Integrator::new(Scheme::Energy, StepControl::Fixed(1e-3 / 48.0), s);
    let (mut largest, mut open, mut turnover) = (0.0f64, 0.0f64, 0.0f64);
    integrator
        .advance(&mut system, &mut state, 2.2e-3, |system, seen| {
            largest = largest.max(system.extremes().largest_force);
            open = open.max(seen.ledger.residual().abs());
            turnover = seen.ledger.turnover;
        })
        .unwrap_or_else(|e| panic!("{e}"));
    let changes = system.changes();
    println!(
        "{} changes, force jumps by {:.1e} of its largest, dropped {:.1e} N; energy open by {open:.1e} of {turnover:.1e} N mm",
        changes.count,
        changes.jump / largest,
        changes.dropped
    );
    assert!(changes.count >= 2 && changes.dropped == 0.0, "{changes:?}");
    assert!(changes.jump < 1e-9 * largest, "{changes:?}");
    assert!(open < 1e-9 * turnover, "energy open by {open:e} N mm");
}

/// Response of all coordinates to the mesh going on with frequency `hz`: (K + i w C - w^2 M) x = df/dt at held coordinates, as amplitude of the lag.
fn response(system: &mut PairMechanism, state: &State, hz: f64) -> f64 {
    let n = system.count();
    let still = DVector::zeros(n);
    let mut forces = Forces::zeros(n);
    let h = 1e-4 / system.nominal().cycles_per_second(system.pair(), &system.options().contact, 0.0);
    let mut at = |t: f64| {
        forces.clear();
        system.forces(t, &state.q, &still, &mut forces).unwrap();
        forces.clone()
    };
    let (after, before, now) = (at(h), at(-h), at(0.0));
    let drive = &after.conservative - &before.conservative;
    let w = std::f64::consts::TAU * hz;
    // [A -B; B A] of the real and imaginary parts.
    let (a, b) = (&now.stiffness - w * w * system.mass(), w * &now.damping);
    let mut all = DMatrix::zeros(2 * n, 2 * n);
    for (row, column, block) in [(0, 0, &a), (n, n, &a), (n, 0, &b)] {
        all.view_mut((row, column), (n, n)).copy_from(block);
    }
    all.view_mut((0, n), (n, n)).copy_from(&-&b);
    let mut rhs = DVector::zeros(2 * n);
    rhs.rows_mut(0, n).copy_from(&drive);
    let x = all.lu().solve(&rhs).unwrap();
    let lag = system.coordinates().lag();
    x[lag].hypot(x[n + lag])
}

/// Quasi-static elasticity against modes over speed (figure 7): one below the bound, two above it, and the warning in between.
#[test]
fn low_frequency_approximation_ends_where_the_warning_says() {
    let case = coarse();
    let contact = case.slice_options();
    let (ste, means) = statics(&case, &contact);
    let gears = case.reduced_gears(&contact);
    let lowest = gears.each_ref().map(|gear| {
        let ElasticGear::Reduced(reducer) = gear else { panic!("not a reduced gear") };
        reducer.lowest_frequencies().unwrap()
    });
    let elastic_hz = lowest.map(|l| l.flanks_free_hz);
    println!("lowest elastic frequencies: {lowest:.0?}");
    let mut systems = both(&case, options(&case, contact, 1e-6, 0.1), means, ModeChoice::Below { hz: 6e4 });
    println!("{} coordinates with modes; mesh resonance {:.0} Hz", systems[1].count(), systems[0].mesh_resonance_hz());
    let states = systems.each_mut().map(|system| {
        let s = scale(system);
        quasi_static_start(system, 0.0, ste, &s).unwrap()
    });
    let mut amplitude = |hz: f64| {
        let [a, b] = [0, 1].map(|i| response(&mut systems[i], &states[i], hz));
        b / a - 1.0
    };
    println!("harmonic / lowest elastic frequency, what modes change in the DTE, warning");
    let (mut below, mut above, mut most) = (0.0f64, f64::INFINITY, 0.0f64);
    for ratio in [0.02, 0.05, 0.1, 0.15, 0.2, 0.249, 0.251, 0.3, 0.4, 0.5, 0.6, 0.7, 1.0, 1.1] {
        let mesh_hz = ratio * elastic_hz[0];
        let off = amplitude(mesh_hz);
        let check = ElasticRatio { mesh_hz, harmonic: 1, elastic_hz };
        println!("{ratio:6.3} {:8.1} % {}", 100.0 * off, if check.warning().is_some() { "warns" } else { "" });
        assert_eq!(check.warning().is_some(), ratio > LOW_FREQUENCY_LIMIT, "{ratio}");
        match check.warning() {
            None => below = below.max(off.abs()),
            Some(_) => (above, most) = (above.min(off.abs()), most.max(off.abs())),
        }
    }
    assert!(below < 0.08, "modes change the DTE by {below} below the bound");
    assert!(above > 0.07 && most > 0.8, "modes change the DTE by {above} to {most} above the bound");
}

/// The same in time at two speeds: peak to peak of the last of some mesh cycles.
#[test]
fn time_says_the_same_as_linear_response() {
    let case = coarse();
    let contact = case.slice_options();
    let (ste, means) = statics(&case, &contact);
    let swing = |mesh_hz: f64| {
        let speed = mesh_hz * case.pair.pinion.pitch_angle();
        let systems = both(&case, options(&case, contact.clone(), speed, 0.3), means, ModeChoice::Count(12));
        let [a, b] = systems.map(|mut system| {
            let s = scale(&system);
            let mut state = quasi_static_start(&mut system, 0.0, ste, &s).unwrap();
            let rho = Scheme::GeneralisedAlpha { rho: 0.8 };
            let mut integrator = Integrator::new(rho, StepControl::Fixed(1.0 / (32.0 * mesh_hz)), s);
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            integrator
                .advance(&mut system, &mut state, 6.0 / mesh_hz, |_, seen| {
                    if seen.state.time > 5.0 / mesh_hz {
                        (low, high) = (low.min(seen.state.q[0]), high.max(seen.state.q[0]));
                    }
                })
                .unwrap_or_else(|e| panic!("{mesh_hz} Hz: {e}"));
            high - low
        });
        println!(
            "mesh frequency {mesh_hz:.0} Hz: {:.4} um peak to peak without modes, {:.4} um with",
            1e3 * a,
            1e3 * b
        );
        b / a - 1.0
    };
    let [slow, fast] = [2e3, 18e3].map(swing);
    assert!(slow.abs() < 0.05, "modes change the DTE by {slow} at 0.07 of the lowest elastic frequency");
    assert!(fast < -0.3, "modes change the DTE by {fast} at 0.6 of it");
}
