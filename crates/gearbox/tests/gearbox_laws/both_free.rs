//! Both gears free, the speed of their common motion held: the motion of a pair that a torque drives in balance with
//! its load, without its drift.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{ops::ControlFlow, sync::OnceLock};

use dynamics::{Drive, MeshDamping, MotionOptions, Speed, Torque};
use gearbox::{
    GearboxError,
    motion::{PairInstant, PairModel, PairMotion, SteadyBy, SteadyOptions, SweepPlan, instants, sweep},
};
use integrate::{Mechanism, Scheme, SweepDirection};
use ltca::{StaticError, StaticOptions};
use testing::moving::{MovingPair, machine, peak_to_peak, rows, started, swept, worst};

const ROWS: usize = 32;
const TORQUE: f64 = 150e3;

/// The default pair on tiny meshes, a wheel of three times the inertia: neither gear's share of the motion is a half.
fn bench() -> &'static MovingPair {
    static BENCH: OnceLock<MovingPair> = OnceLock::new();
    BENCH.get_or_init(|| {
        let case = testing::generated(20.0, [2, 2, 2, 2, 1]);
        let contact = StaticOptions { torque: TORQUE, ..case.slice_options() };
        let mut pair = MovingPair::new(case, contact, 8);
        pair.bodies[1].polar_inertia *= 3.0;
        pair
    })
}

fn balanced(bench: &MovingPair, cycles_per_second: f64) -> impl FnOnce(&mut MotionOptions) + use<> {
    let speed = bench.speed(cycles_per_second);
    move |o| o.drive = Drive::Balanced(Speed::Constant(speed))
}

/// m_1 v_1 + m_2 v_2 of both gears on their base circles, forwards, t mm/s.
fn momentum(bench: &MovingPair, masses: [f64; 2], speeds: [f64; 2]) -> f64 {
    let base = [bench.case.pair.pinion.base_radius(), bench.case.pair.wheel.base_radius()];
    masses[0] * base[0] * speeds[0] - masses[1] * base[1] * speeds[1]
}

/// A torque of its own that balances the load, begun without momentum off the nominal one, moves the pair alike:
/// without friction nothing drifts.
#[test]
fn it_is_the_motion_of_a_balanced_torque() {
    let bench = bench();
    let hz = 1500.0;
    let system = bench.system(hz, balanced(bench, hz));
    let times = bench.times(&system, Scheme::Energy, ROWS);
    let of_driver = system.base_circle_masses();
    let mut held = bench.motion(system, times);
    let lag = held.state().clone();
    let of_driver = of_driver[1] / (of_driver[0] + of_driver[1]);
    let torque = bench.system(hz, |o| {
        o.drive = Drive::Torque { start: bench.speed(hz), torque: Torque::Constant(TORQUE) };
    });
    let times = bench.times(&torque, Scheme::Energy, ROWS);
    let (machine, mut state) = started(&torque, 0.0);
    let driver = torque.names().iter().position(|name| *name == "pinion turn").expect("a torque drives");
    let base = bench.case.pair.pinion.base_radius();
    for (all, one) in [(&mut state.q, &lag.q), (&mut state.v, &lag.v)] {
        all[torque.lag()] = one[0];
        all[driver] = of_driver * one[0] / base;
    }
    let mut free = PairMotion::new(machine, times, state);
    let (a, b) = (rows(&mut held, 6), rows(&mut free, 6));
    let off = worst(&a, &b) / peak_to_peak(&a);
    println!("peak to peak {:.4} um, off by {off:.1e} of it", 1e3 * peak_to_peak(&a));
    // Measured 7e-5: normal forces of bent flanks move the whole rotation a little, which a balanced torque does not let
    // them.
    assert!(off < 2e-4, "DTE differs by {off:e} of its peak to peak");
    let open = held.ledger().expect("a cycle is done").relative_residual();
    assert!(open.abs() < 1e-6, "energy open by {open:e}");
}

/// Momentum of the common motion is the nominal one at every row, both gears move by their share, and the driver's
/// torque is that of the load.
#[test]
fn momentum_of_the_common_motion_is_held() {
    let bench = bench();
    let hz = 2000.0;
    let system = bench.system(hz, balanced(bench, hz));
    let masses = system.base_circle_masses();
    let nominal = [1.0, -1.0].map(|sense| sense * bench.speed(hz));
    let wanted = momentum(bench, masses, nominal);
    let times = bench.times(&system, Scheme::Energy, ROWS);
    let mut motion = bench.motion(system, times);
    let (mut worst, mut swings, mut torques) = (0.0f64, [0.0f64; 2], [f64::INFINITY, 0.0f64]);
    let look = |now: &PairInstant, _: &_, _: &_| {
        worst = worst.max((momentum(bench, masses, now.speeds) / wanted - 1.0).abs());
        for g in 0..2 {
            swings[g] = swings[g].max((now.speeds[g] - nominal[g]).abs());
        }
        torques = [torques[0].min(now.drive_torque), torques[1].max(now.drive_torque)];
    };
    let mut look = instants(look);
    for _ in 0..4 {
        motion.run_cycle(Some(&mut look)).unwrap_or_else(|e| panic!("{e}"));
    }
    drop(look);
    println!("momentum off by {worst:.1e}; speeds swing by {swings:?} rad/s; torque {torques:?} N mm");
    assert!(worst < 1e-12, "momentum off by {worst:e}");
    // Equal gears, the wheel with three times the inertia: it swings by a third.
    assert!((swings[0] / swings[1] - 3.0).abs() < 1e-6, "{swings:?} rad/s");
    // The same load, without friction; damping acts along the normals, which do no work on the common motion but for
    // the bent flanks.
    assert!(torques.iter().all(|t| (t / TORQUE - 1.0).abs() < 1e-3), "{torques:?} N mm");
}

/// A torque that balances while the speed rises accelerates both gears: the mesh carries what the driven one takes of it, as
/// it does where the driver's speed is given.
#[test]
fn a_balanced_torque_accelerates_the_driven_gear() {
    let bench = bench();
    let to = bench.speed(2000.0);
    // In the middle of a smooth step.
    let share = 0.2;
    let steepest = share * TORQUE / bench.bodies[1].polar_inertia;
    let duration = 1.5 * 0.5 * to / steepest;
    let ramp = Speed::Ramp { from: 0.5 * to, to, start: 0.0, duration };
    let means = [Drive::Balanced(ramp), Drive::Speed(ramp)].map(|drive| {
        let system = bench.system(2000.0, |o| o.drive = drive);
        let [first, last] = [0.4, 0.6].map(|part: f64| system.cycles_until(part * duration) as usize);
        let times = bench.times(&system, Scheme::GeneralisedAlpha { rho: 0.8 }, ROWS);
        let mut motion = bench.motion(system, times);
        let mut forces = Vec::new();
        let mut look = instants(|now: &PairInstant, _: &_, _: &_| forces.push(now.normal_forces()[0]));
        for _ in 0..last {
            motion.run_cycle(Some(&mut look)).unwrap_or_else(|e| panic!("{e}"));
        }
        drop(look);
        let middle = &forces[first * ROWS..];
        middle.iter().sum::<f64>() / middle.len() as f64
    });
    let wheel = &bench.case.pair.wheel;
    let alone = TORQUE / (wheel.base_radius() * wheel.base_helix_angle().cos());
    println!("{:.4} and {:.4} of the load's force", means[0] / alone, means[1] / alone);
    assert!((means[0] / means[1] - 1.0).abs() < 5e-3, "{means:?} N");
    // The smooth step is 4 % less steep a tenth of its duration off the middle.
    assert!((means[0] / alone - 1.0 - share).abs() < 0.1 * share, "{means:?} N, {alone} N of the load");
}

/// What vibrates is one equation in the lag: with both gears free it has the equivalent mass of both, and in units of
/// its own resonance the motion is the one with a driver whose angle is given.
#[test]
fn the_drive_changes_the_clock_only() {
    let bench = bench();
    let held = bench.system(1000.0, |_| ());
    let free = bench.system(1000.0, balanced(bench, 1000.0));
    let [both, driven] = free.mesh_resonances_hz();
    assert_eq!([free.mesh_resonance_hz(), held.mesh_resonance_hz()], [both, driven]);
    // m_e of m and 3 m is 3/4 m; the driven gear alone has 3 m.
    assert!((both / driven - 2.0).abs() < 1e-12, "{both} Hz, {driven} Hz");
    let at = |system: &PairModel| {
        let plan = SweepPlan {
            speeds: [0.5, 0.9, 1.1].map(|r| bench.speed(r * system.mesh_resonance_hz())).to_vec(),
            ways: vec![SweepDirection::Independent],
            times: bench.times(system, Scheme::GeneralisedAlpha { rho: 0.9 }, ROWS),
            steady: SteadyOptions { by: SteadyBy::Running, tolerance: 1e-7, most: 300, cycles: 1 },
        };
        swept(system, &plan)
    };
    for (a, b) in at(&held).iter().zip(&at(&free)) {
        let size = peak_to_peak(&a.transmission_error);
        let off = worst(&a.transmission_error, &b.transmission_error) / size;
        println!("{:.1} and {:.1} rad/s: peak to peak {:.4} um, off by {off:.1e} of it", a.speed, b.speed, 1e3 * size);
        // The driver's own share of the mean lag, some micrometres of a base pitch of 9 mm, moves the phase: 2 pi times
        // that, and twice it for the second order. Measured 4e-3.
        assert!(off < 1e-2, "{} rad/s: differs by {off:e}", a.speed);
        assert!((b.speed / a.speed - 2.0).abs() < 1e-12);
    }
}

/// Shooting needs no driver that is held.
#[test]
fn shooting_and_waiting_agree() {
    let bench = bench();
    let system = bench.system(2500.0, balanced(bench, 2500.0));
    let plan = |by| SweepPlan {
        speeds: vec![bench.speed(2500.0)],
        ways: vec![SweepDirection::Independent],
        times: bench.times(&system, Scheme::GeneralisedAlpha { rho: 0.9 }, ROWS),
        steady: SteadyOptions { by, tolerance: 1e-8, most: 400, cycles: 1 },
    };
    let [a, b] = [SteadyBy::Running, SteadyBy::Shooting].map(|by| swept(&system, &plan(by)));
    let off = worst(&a[0].transmission_error, &b[0].transmission_error) / peak_to_peak(&a[0].transmission_error);
    println!("waited {} and {} cycles, off by {off:.1e}", a[0].waited, b[0].waited);
    assert!(off < 1e-5 && b[0].waited < a[0].waited, "off by {off:e}, waited {} and {}", a[0].waited, b[0].waited);
}

/// A speed without an answer has a reason of its own, and the others have the answers they would have without it.
#[test]
fn one_speed_without_an_answer_leaves_the_others_alone() {
    let bench = bench();
    let system = bench.system(1000.0, |o| o.damping = MeshDamping::Ratio(0.3));
    let plan = |speeds: &[f64]| SweepPlan {
        speeds: speeds.iter().map(|f| bench.speed(*f)).collect(),
        ways: vec![SweepDirection::Up, SweepDirection::Down, SweepDirection::Independent],
        times: bench.times(&system, Scheme::GeneralisedAlpha { rho: 0.9 }, 16),
        steady: SteadyOptions { by: SteadyBy::Running, tolerance: 1e-3, most: 60, cycles: 1 },
    };
    let good = swept(&system, &plan(&[900.0, 1000.0]));
    // No mesh cycle ends at standstill.
    let all =
        sweep(&system, &plan(&[0.0, 900.0, 1000.0]), &|_| ControlFlow::Continue(())).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(all.len(), 9);
    let misses: Vec<_> = all.iter().filter_map(|o| o.as_ref().err()).collect();
    assert_eq!(
        misses.iter().map(|m| (m.way, m.speed)).collect::<Vec<_>>(),
        [(SweepDirection::Up, 0.0), (SweepDirection::Down, 0.0), (SweepDirection::Independent, 0.0)]
    );
    assert!(misses.iter().all(|m| m.error.to_string().contains("rotation stops")), "{misses:?}");
    let solved: Vec<_> = all.into_iter().filter_map(Result::ok).collect();
    assert!(solved == good, "a speed without an answer changed the others");
    let started: Vec<bool> = solved.iter().map(|p| p.own_start).collect();
    assert_eq!(started, [true, false, true, false, true, true]);
}

/// A step that leaps over a tooth ends in a state like any other: it is refused there, with where it happened. Teeth
/// are half a base pitch thick on their line of action, whichever coordinates bring them together, and flanks that part
/// have the backlash besides.
#[test]
fn a_step_over_a_tooth_is_refused_as_soon_as_it_is_done() {
    let bench = bench();
    let hz = 1000.0;
    let fresh = bench.system(hz, |o| {
        o.drive = Drive::Torque { start: bench.speed(hz), torque: Torque::Constant(TORQUE) };
        o.free[1][1] = true;
    });
    let names = fresh.names();
    let named = |wanted: &str| names.iter().position(|n| *n == wanted).unwrap();
    let (lag, y, turn) = (fresh.lag(), named("wheel y"), named("pinion turn"));
    let pair = &bench.case.pair;
    let (half, backlash) = (0.5 * pair.transverse_base_pitch(), pair.backlash());
    let towards = pair.working_pressure_angle().cos();
    assert!(backlash > 0.01, "{backlash} mm");
    let time = 0.3 / hz;
    let end = |place: &[(usize, f64)]| {
        let mut q = nalgebra::DVector::zeros(names.len());
        place.iter().for_each(|&(i, x)| q[i] = x);
        let v = nalgebra::DVector::zeros(names.len());
        machine(&fresh).accepted(time, &q, &v).map_err(|e| match e {
            GearboxError::Contact(source) => source,
            other => panic!("{other}"),
        })
    };
    for place in [
        vec![(lag, 1.01 * half)],
        vec![(y, -1.01 * half / towards)],
        vec![(lag, 0.51 * half), (y, -0.5 * half / towards)],
        vec![(lag, -backlash - 1.01 * half)],
        vec![(lag, 1e4)],
    ] {
        let error = end(&place).unwrap_err();
        let wanted: f64 = place.iter().map(|&(i, x)| if i == y { -x * towards } else { x }).sum();
        let StaticError::PassedThrough { cycle: 0, phase, distance_mm, .. } = error else {
            panic!("{place:?}: {error}")
        };
        assert!((phase - 0.3).abs() < 1e-9 && (distance_mm / wanted - 1.0).abs() < 1e-9, "{place:?}: {error}");
        assert!(error.hint().is_some_and(|h| h.contains("smaller steps")), "{error}");
    }
    // Loss of contact as it happens, with the gears apart or with the way of the one taken back by the other.
    for place in [vec![(lag, -0.9 * half)], vec![(lag, -0.9 * half - backlash)], vec![(lag, half), (y, half / towards)]]
    {
        end(&place).unwrap_or_else(|e| panic!("{place:?}: {e}"));
    }
    // Gears that turn by a million teeth in a step are not followed tooth by tooth.
    for teeth in [4.5, -4.5, 1e6, 1e300] {
        let error = end(&[(turn, teeth * pair.pinion.pitch_angle())]).unwrap_err();
        assert!(matches!(error, StaticError::Window(ale::AleError::Leapt { window: 3, .. })), "{teeth} teeth: {error}");
    }
    end(&[(turn, 1.5 * pair.pinion.pitch_angle())]).unwrap_or_else(|e| panic!("{e}"));
}
