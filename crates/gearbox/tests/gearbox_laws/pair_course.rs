//! Courses of a pair's motion: starts without a transient, periodic states by waiting and by shooting, sweeps, energy,
//! tooth changes, either sense.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::sync::OnceLock;

use dynamics::{Bearing, Drive, MeshDamping, MotionOptions, Torque};
use gearbox::{
    GearboxError,
    motion::{
        GearboxMemory, MotionTimes, PairModel, PairMotion, SteadyBy, SteadyOptions, SweepPlan, instants, run_to_steady,
        shoot,
    },
};
use geometry::{Driver, Gear, GearModifications, GearPair, Sense};
use integrate::{Checkpoint, Scheme, SweepDirection};
use ltca::StaticError;
use mesh::Extent;
use nalgebra::Matrix6;
use testing::moving::{MovingPair, machine, peak_to_peak, rows, started, swept, worst};

const TORQUE: f64 = 150e3;
const ROWS: usize = 32;

/// The default pair on tiny meshes: the same for all tests of a sense and a driver.
fn tiny(driver: Driver, sense: Sense) -> MovingPair {
    let case = testing::generated(20.0, [2, 2, 2, 2, 1]);
    let contact = case.slice_options().with_contact(|c| {
        c.driver = driver;
        c.sense = sense
    });
    MovingPair::new(case, contact, 8)
}

pub fn bench() -> &'static MovingPair {
    static BENCH: OnceLock<MovingPair> = OnceLock::new();
    BENCH.get_or_init(|| tiny(Driver::Pinion, Sense::Ccw))
}

fn times(bench: &MovingPair, system: &PairModel, scheme: Scheme) -> MotionTimes {
    bench.times_showing(system, scheme, [ROWS, 8])
}

fn motion(bench: &MovingPair, system: PairModel, scheme: Scheme) -> PairMotion {
    let times = times(bench, &system, scheme);
    bench.motion(system, times)
}

/// A slow, undamped motion that begins in quasi-static balance stays there: nothing rings that a later change of
/// contact has not set off.
#[test]
fn the_start_sets_nothing_off() {
    let bench = bench();
    let slow = |o: &mut MotionOptions| o.damping = MeshDamping::Ratio(0.0);
    let mut motion = motion(bench, bench.system(50.0, slow), Scheme::Energy);
    let (first, start) = (bench.ste[0], motion.state().clone());
    assert!((start.q[0] / first - 1.0).abs() < 1e-6, "begins at {} mm, STE is {first} mm", start.q[0]);
    let mut seen = Vec::new();
    motion.run_cycle(Some(&mut instants(|now, _, _| seen.push((now.time, now.mesh.transmission_error))))).unwrap();
    let still = bench.system(50.0, slow);
    // Later on slices that come into contact, one after the other, strike the undamped mesh near its resonance.
    let off = seen.iter().take(4).map(|(time, error)| {
        let (_, balance) = started(&still, *time);
        (balance.q[0] - error).abs()
    });
    let off = off.fold(0.0, f64::max) / first;
    println!("off the quasi-static error by {off:.1e} of it");
    assert!(off < 1e-3, "{off:e}");
}

/// Waiting and shooting find the same periodic answer; shooting in fewer periods where damping is weak. It leads to the
/// accelerations of the motion as well: the cycles that follow are alike from the first one on.
#[test]
fn shooting_finds_what_waiting_finds() {
    let bench = bench();
    let weak = |o: &mut MotionOptions| o.damping = MeshDamping::Ratio(0.02);
    for scheme in [Scheme::Energy, Scheme::GeneralisedAlpha { rho: 0.8 }] {
        let mut waited = motion(bench, bench.system(1500.0, weak), scheme);
        let found = run_to_steady(&mut waited, 1e-7, 2000).unwrap();
        let cycles = waited.cycle();
        assert!(found.residual <= 1e-7, "{scheme:?}: off by {found:?} after {cycles} cycles");
        let mut shot_at = motion(bench, bench.system(1500.0, weak), scheme);
        let shot = shoot(&mut shot_at, 1, 1e-8).unwrap();
        let [a, b] = [rows(&mut waited, 1), rows(&mut shot_at, 1)];
        let off = worst(&a, &b) / bench.ste[0];
        let again = worst(&b, &rows(&mut shot_at, 1)) / peak_to_peak(&b);
        println!(
            "{scheme:?}: {cycles} cycles waited, {} shot ({} steps); multiplier {:.4}; off by {off:.1e}; the first two cycles {again:.1e} of the peak to peak apart",
            shot.periods, shot.steps, shot.multiplier
        );
        assert!(shot.residual <= 1e-8 && shot.multiplier < 1.0, "{shot:?}");
        assert!((shot.periods as u64) < cycles, "{} periods, waiting took {cycles}", shot.periods);
        assert!(again < 1e-6, "{scheme:?}: the first two cycles differ by {again:e} of the peak to peak");
        assert!(off < 1e-5, "{scheme:?}: the answers differ by {off:e} of the transmission error");
    }
}

/// A pair of so many teeth which stand off their places: on the pinion, on the wheel.
fn with_pitch_errors(teeth: [u32; 2], of: [bool; 2]) -> MovingPair {
    let [mut pinion, mut wheel] = testing::default_data(20.0);
    (pinion.teeth, wheel.teeth) = (teeth[0], teeth[1]);
    (pinion.bore_diameter, wheel.bore_diameter) = (30.0, 30.0);
    let mut case = testing::of_order(1, [pinion, wheel], None, 150e3, [2, 2, 2, 2, 1], Extent::Whole);
    let wrong = |gear: &Gear, phase: f64| {
        let error = |i: u32| 2e-3 * (phase + 2.4 * f64::from(i * i)).sin();
        let pitch_errors = (0..gear.teeth()).map(error).collect();
        gear.clone().with_modifications(GearModifications { pitch_errors, ..GearModifications::default() }).unwrap()
    };
    let gears = [(&case.pair.pinion, of[0]), (&case.pair.wheel, of[1])];
    let [pinion, wheel] = gears.map(|(gear, has)| if has { wrong(gear, 0.3) } else { gear.clone() });
    case.pair = GearPair::new(pinion, wheel, None).unwrap();
    let contact = case.slice_options();
    MovingPair::new(case, contact, 8)
}

/// Teeth that stand off their places come back after a turn of their gear, and so does the motion: waiting ends after few
/// of its turns, and shooting over a turn finds the same answer.
#[test]
fn pitch_errors_are_waited_for_by_turns() {
    let bench = with_pitch_errors([20, 30], [true, false]);
    let teeth = 20;
    let scheme = Scheme::GeneralisedAlpha { rho: 0.8 };
    let mut waited = motion(&bench, bench.system(1500.0, |_| ()), scheme);
    let found = run_to_steady(&mut waited, 1e-7, 1000).unwrap_or_else(|e| panic!("{e}"));
    println!("{found:?} after {} cycles", waited.cycle());
    assert!(found.residual <= 1e-7, "{found:?} after {} cycles", waited.cycle());
    assert_eq!(found.period as u64, teeth, "{found:?}: not a turn of the pinion");
    assert!(waited.cycle() <= 4 * teeth, "{} cycles for a period of {teeth}", waited.cycle());
    let model = bench.system(1500.0, |_| ());
    let mut shot_at = motion(&bench, model, scheme);
    let shot = shoot(&mut shot_at, teeth, 1e-8).unwrap_or_else(|e| panic!("{e}"));
    let [a, b] = [rows(&mut waited, teeth), rows(&mut shot_at, teeth)];
    let off = worst(&a, &b) / bench.ste[0];
    assert!(shot.residual <= 1e-8 && off < 1e-5, "{shot:?}: the answers differ by {off:e} of the transmission error");
}

/// Where the same teeth meet again later than a motion may wait, it does not begin.
#[test]
fn a_period_beyond_the_wait_is_told_at_once() {
    let bench = with_pitch_errors([31, 37], [true, true]);
    let mut motion = motion(&bench, bench.system(1500.0, |_| ()), Scheme::GeneralisedAlpha { rho: 0.8 });
    let error = run_to_steady(&mut motion, 1e-7, 1000).expect_err("the teeth meet again after more than 1000 cycles");
    // 31 times 37.
    assert!(error.to_string().contains("1147"), "{error}");
    let hint = error.hint().unwrap_or_default();
    assert!(hint.contains("warm_up_cycles") && motion.cycle() == 0, "{hint}");
}

/// A motion that is written down after a cycle and taken up again goes the same way to the last bit.
#[test]
fn a_checkpoint_holds_all_there_is() {
    let bench = bench();
    for scheme in [Scheme::Energy, Scheme::GeneralisedAlpha { rho: 0.6 }] {
        let mut whole = motion(bench, bench.system(700.0, |_| ()), scheme);
        rows(&mut whole, 3);
        let text = serde_json::to_string(&whole.checkpoint().unwrap()).unwrap();
        let back: Checkpoint<GearboxMemory> = serde_json::from_str(&text).unwrap();
        let system = bench.system(700.0, |_| ());
        let times = times(bench, &system, scheme);
        let mut resumed = PairMotion::resume(machine(&system), times, back).unwrap();
        assert!(rows(&mut whole, 2) == rows(&mut resumed, 2), "{scheme:?}: the rows differ");
        assert!(whole.checkpoint() == resumed.checkpoint(), "{scheme:?}: the states differ");
    }
}

/// Six coordinates a gear on bearings: energy closes, no flank pulls, and the bearings carry the load.
#[test]
fn energy_closes_with_bearings_and_friction() {
    let bench = bench();
    let bearing = |k: f64, tilt: f64| Bearing {
        stiffness: Matrix6::from_diagonal(&[k, k, 0.5 * k, tilt, tilt, 0.0].into()),
        damping: Matrix6::from_diagonal(&[0.2, 0.2, 0.1, 200.0, 200.0, 0.0].into()),
    };
    let system = bench.system(900.0, |o| {
        o.bearings = [bearing(2e5, 5e7), bearing(3e5, 8e7)];
        o.free = [[true, true, true, true, true, false]; 2];
        o.statics.contact.friction = 0.04;
    });
    assert_eq!(system.names().len(), 11);
    let mut motion = motion(bench, system, Scheme::Energy);
    let mut bearings = [0.0; 2];
    let mut driven = 0.0;
    for _ in 0..2 {
        motion
            .run_cycle(Some(&mut instants(|now, _, _| {
                for (sum, at) in bearings.iter_mut().zip([1, 7]) {
                    *sum += now.bearings[at / 6].force[1] / (2.0 * ROWS as f64);
                }
                driven += now.mesh.wrench[7] / (2.0 * ROWS as f64);
            })))
            .unwrap_or_else(|e| panic!("{e}"));
    }
    let ledger = *motion.ledger().unwrap();
    println!("{ledger:?}: open by {:.1e} of the turnover", ledger.relative_residual());
    assert!(ledger.relative_residual().abs() < 1e-6, "{ledger:?}");
    assert!(motion.system().extremes(0).least_force.unwrap() >= 0.0);
    assert!((bearings[1] / -driven - 1.0).abs() < 0.02, "bearing {} N against mesh {driven} N", bearings[1]);
    assert!((bearings[0] / bearings[1] + 1.0).abs() < 0.02, "{bearings:?} N");
}

/// Torque drives, a little too strong: the pair speeds up by what torque and inertia say, and the windows follow the
/// teeth that are really there.
#[test]
fn a_torque_that_is_too_strong_speeds_the_pair_up() {
    let bench = bench();
    let excess = 0.1 * TORQUE;
    let start = 500.0 * bench.case.pair.pinion.pitch_angle();
    let system = bench.system(500.0, |o| {
        o.drive = Drive::Torque { start, torque: Torque::Constant(TORQUE + excess) };
    });
    let inertia: f64 = bench.bodies.iter().map(|b| b.polar_inertia).sum();
    let mut motion = motion(bench, system, Scheme::Energy);
    let (mut last, mut turned) = ([0.0; 2], 0.0);
    for _ in 0..6 {
        motion
            .run_cycle(Some(&mut instants(|now, _, _| (last, turned) = ([now.time, now.speeds[0]], now.mesh.cycles))))
            .unwrap_or_else(|e| panic!("{e}"));
    }
    let expected = start + excess / inertia * last[0];
    let cycles = (start * last[0] + 0.5 * excess / inertia * last[0].powi(2)) / bench.case.pair.pinion.pitch_angle();
    println!("{:.2} rad/s, {expected:.2} expected; {turned:.4} mesh cycles, {cycles:.4} expected", last[1]);
    assert!((last[1] / expected - 1.0).abs() < 5e-3, "{} rad/s, not {expected}", last[1]);
    assert!((turned - cycles).abs() < 0.05, "{turned} mesh cycles, not {cycles}");
    assert!(turned > 7.0 && motion.system().changes(0).count as f64 > turned - 2.0, "{:?}", motion.system().changes(0));
}

/// Either driver, either sense: the same motion, mirrored.
#[test]
fn either_sense_and_either_driver_move_alike() {
    let dte = |bench: &MovingPair| {
        let mut motion = motion(bench, bench.system(1200.0, |_| ()), Scheme::Energy);
        rows(&mut motion, 2)
    };
    let reference = dte(bench());
    for (driver, sense) in [(Driver::Pinion, Sense::Cw), (Driver::Wheel, Sense::Ccw)] {
        let off = worst(&reference, &dte(&tiny(driver, sense))) / reference[0];
        println!("{driver:?} {sense:?}: off by {off:.1e}");
        // Meshes of either flank differ by what the mesher makes of left and right.
        assert!(off < 1e-3, "{driver:?} {sense:?}: off by {off:e}");
    }
}

/// Up, down and apart meet where there is one answer only, and threads change nothing.
#[test]
fn a_sweep_is_the_same_from_either_side() {
    let bench = bench();
    let system = bench.system(1000.0, |_| ());
    let pitch = bench.case.pair.pinion.pitch_angle();
    let plan = SweepPlan {
        speeds: [800.0, 1100.0].map(|f| f * pitch).to_vec(),
        ways: vec![SweepDirection::Up, SweepDirection::Down, SweepDirection::Independent],
        times: times(bench, &system, Scheme::GeneralisedAlpha { rho: 0.9 }),
        steady: SteadyOptions { by: SteadyBy::Running, tolerance: 1e-6, most: 300, cycles: 1 },
    };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| swept(&system, &plan))
    };
    let points = with(1);
    assert!(points == with(2), "the number of threads shows");
    let [up, down, apart] = [0, 2, 4].map(|i| &points[i..i + 2]);
    for (up, other) in [(&up[0], &down[1]), (&up[1], &down[0]), (&up[0], &apart[0]), (&up[1], &apart[1])] {
        assert_eq!(up.speed, other.speed);
        let off = worst(&up.transmission_error, &other.transmission_error) / bench.ste[0];
        assert!(off < 1e-4, "{} rad/s: {:?} and {:?} differ by {off:e}", up.speed, up.way, other.way);
    }
}

/// A load that brings teeth beside the window into contact ends the motion with a message that names them: no force is
/// missed in silence.
#[test]
fn a_starved_window_is_an_error() {
    let bench = bench();
    let mut motion = motion(bench, bench.system(500.0, |o| o.load = Torque::Constant(1e7)), Scheme::Energy);
    let error =
        (0..2).find_map(|_| motion.run_cycle::<GearboxError>(None).err()).expect("two cycles with teeth missing");
    println!("{error}");
    let starved = matches!(error.contact_error(), Some(StaticError::Window(ale::AleError::Starved { window: 3, .. })));
    assert!(starved, "{error}");
}
