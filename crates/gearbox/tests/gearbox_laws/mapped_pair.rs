//! A pair as a machine with a map of its contact, beside the contact itself.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{sync::OnceLock, time::Instant};

use dynamics::{Bearing, Drive, MapRequest, MeshDamping, MotionOptions, Speed, Torque};
use gearbox::{
    GearboxError,
    motion::{GearboxMechanism, MappedMesh, PairModel},
};
use geometry::{Gear, GearModifications, GearPair};
use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use ltca::StaticOptions;
use mesh::Extent;
use nalgebra::{DVector, Matrix6};
use testing::{
    moving::{MovingPair, machine, peak_to_peak, rows, started, worst},
    of_order, planet_in_ring,
};

const TORQUE: f64 = 150e3;
/// Steps in a mesh cycle.
const STEPS: usize = 64;

fn bench() -> &'static MovingPair {
    static BENCH: OnceLock<MovingPair> = OnceLock::new();
    BENCH.get_or_init(|| {
        let case = testing::generated(20.0, [2, 2, 2, 2, 1]);
        let contact = StaticOptions { torque: TORQUE, ..case.slice_options() };
        MovingPair::new(case, contact, 8)
    })
}

/// The wheel on soft bearings, free in all its coordinates: three times its own inertia, so that it swings slowly.
fn on_bearings(o: &mut MotionOptions) {
    let diagonal = |values: [f64; 6]| Matrix6::from_diagonal(&values.into());
    o.free[1] = [true, true, true, true, true, false];
    o.bearings[1] = Bearing {
        stiffness: diagonal([2e5, 3e5, 1e5, 4e8, 5e8, 0.0]),
        damping: diagonal([20.0, 20.0, 20.0, 2e4, 2e4, 0.0]),
    };
}

/// What a map must hold of a pair, and the map.
fn map_of(system: &PairModel, tolerance: f64) -> Result<(MapRequest, MappedMesh), GearboxError> {
    let request = system.map_request(4.0, [tolerance; 2]).unwrap_or_else(|e| panic!("{e}"));
    let mesh = MappedMesh::new(system.flanks().expect("they are solved"), system.pair(), &request, &|_| {})?;
    Ok((request, mesh))
}

fn mapped(
    bench: &MovingPair,
    hz: f64,
    tolerance: f64,
    change: impl FnOnce(&mut MotionOptions),
) -> (GearboxMechanism, MappedMesh) {
    let system = bench.system(hz, change);
    let (_, mesh) = map_of(&system, tolerance).unwrap_or_else(|e| panic!("{e}"));
    (machine(&system.on_map(mesh.clone())), mesh)
}

fn forces<M: Mechanism>(system: &mut M, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Forces
where
    M::Error: std::fmt::Display,
{
    let mut out = Forces::zeros(q.len());
    system.forces(t, q, v, &mut out).unwrap_or_else(|e| panic!("{e}"));
    out
}

/// A pinion in a ring.
fn ring() -> MovingPair {
    let case = of_order(1, planet_in_ring(15.0), None, 300e3, [2, 2, 2, 2, 1], Extent::Whole);
    let contact = case.slice_options();
    MovingPair::new(case, contact, 16)
}

/// Forces, stiffness and damping of the map are those of the contact, at loads around the one it was made for.
#[test]
fn a_map_has_the_forces_of_the_contact() {
    has_the_forces_of_the_contact(bench());
    has_the_forces_of_the_contact(&ring());
}

fn has_the_forces_of_the_contact(bench: &MovingPair) {
    let (mut map, _) = mapped(bench, 1000.0, 3e-4, |_| ());
    let n = map.count();
    for i in 0..12 {
        // Within the first window: nothing moves it here.
        let (t, share) = (4e-5 * f64::from(i), 0.7 + 0.05 * f64::from(i));
        let mut exact = machine(&bench.system(1000.0, |_| ()));
        let (q, v) = (DVector::from_element(n, bench.ste[0] * share), DVector::from_element(n, 1.0));
        let [a, b] = [forces(&mut exact, t, &q, &v), forces(&mut map, t, &q, &v)];
        let off = b.conservative[0] / a.conservative[0] - 1.0;
        let [k, c] = [b.stiffness[0] / a.stiffness[0] - 1.0, b.damping[0] / a.damping[0] - 1.0];
        println!("{:.3} N: {off:+.1e}, stiffness {k:+.1e}, damping {c:+.1e}", a.conservative[0]);
        assert!(off.abs() < 1.5e-3, "{} N: the map's force is off by {off:e}", a.conservative[0]);
        assert!(k.abs() < 1e-2 && c.abs() < 3e-2, "stiffness is off by {k:e}, damping by {c:e}");
    }
}

/// The same with a gear that moves along and about all axes: forces and moments within a hundredth of the largest, by
/// twelve places off the one that the map was made about.
#[test]
fn a_map_has_the_forces_of_gears_that_tilt() {
    let bench = bench();
    let (mut map, mesh) = mapped(bench, 1000.0, 1e-3, on_bearings);
    let certificate = *mesh.maps().next().expect("driving flanks").certificate();
    assert!(certificate.tilts > 1, "a gear on bearings tilts: {certificate:?}");
    let mut worst: f64 = 0.0;
    for i in 0..12 {
        let t = 4e-5 * f64::from(i);
        let system = bench.system(1000.0, on_bearings);
        let scale = system.scale(bench.ste[0]);
        let (mut exact, mut start) = started(&system, t);
        for k in 0..start.q.len() {
            let part = ((7 * i + 3 * k as i32) % 5 - 2) as f64 / 20.0;
            start.q[k] += part * scale[k];
        }
        let still = DVector::zeros(start.q.len());
        let [a, b] = [forces(&mut exact, t, &start.q, &still), forces(&mut map, t, &start.q, &still)];
        let sized = |f: &Forces| (&f.conservative + &f.other).component_mul(&scale);
        let bearing = a.conservative.component_mul(&scale).amax();
        let load = (bench.contact.torque / bench.case.pair.wheel.base_radius() * scale[scale.len() - 1]).max(bearing);
        let off = (sized(&a) - sized(&b)).amax() / load;
        worst = worst.max(off);
    }
    println!("forces are off by {worst:.1e}, {certificate:?}");
    assert!(worst < 1e-2, "forces of gears that tilt are off by {worst:e}");
}

fn map_rows(map: &mut GearboxMechanism, hz: f64, cycles: usize, start: &State) -> (Vec<f64>, f64) {
    let scale = DVector::from_element(map.count(), 1e-3);
    let mut state = State::new(start.time, start.q.clone(), start.v.clone());
    let control = StepControl::Fixed(1.0 / hz / STEPS as f64);
    let mut integrator = Integrator::new(Scheme::GeneralisedAlpha { rho: 0.8 }, control, scale);
    let mut out = Vec::new();
    let began = Instant::now();
    integrator
        .advance(map, &mut state, cycles as f64 / hz, |_, progress| out.push(progress.state.q[0]))
        .unwrap_or_else(|e| panic!("{e}"));
    (out, began.elapsed().as_secs_f64())
}

/// The motion on a map is that on the contact, from slow to twice the resonance: two thousandths of its peak to peak.
#[test]
fn a_map_moves_as_the_contact() {
    let bench = bench();
    for share in [0.1, 0.35, 0.5, 0.9, 1.0, 1.1, 2.0] {
        let hz = share * bench.resonance_hz();
        let (mut map, _) = mapped(bench, hz, 2e-4, |_| ());
        let system = bench.system(hz, |_| ());
        let times = bench.times_showing(&system, Scheme::GeneralisedAlpha { rho: 0.8 }, [STEPS, 0]);
        let mut exact = bench.motion(system, times);
        let start = exact.state().clone();
        let cycles = 24;
        let began = Instant::now();
        let a = rows(&mut exact, cycles as u64);
        let of_exact = began.elapsed().as_secs_f64();
        let (b, of_map) = map_rows(&mut map, hz, cycles, &start);
        assert!(map.reach()[0] <= 1.0, "the motion leaves its map: {:?}", map.reach());
        let last = a.len() - STEPS;
        let off = worst(&a[last..], &b[last..]) / peak_to_peak(&a[last..]);
        println!(
            "{share} of the resonance: p-p {:.4} um, off by {off:.1e} of it; {:.0} times faster, {:.2} us a step",
            1e3 * peak_to_peak(&a[last..]),
            of_exact / of_map,
            1e6 * of_map / b.len() as f64
        );
        assert!(off < 2e-3, "at {share} of the resonance the map moves off by {off:e} of the peak to peak");
    }
}

/// With pitch errors of both gears, over more than a turn of either: the motion on the map is that on the contact, to the
/// error that is told of it.
#[test]
fn a_map_moves_as_the_contact_of_teeth_with_pitch_errors() {
    let mut case = testing::generated(20.0, [2, 2, 2, 2, 1]);
    let wrong = |gear: &Gear, phase: f64| {
        let error = |i: u32| 1.5e-3 * (phase + 2.4 * f64::from(i * i)).sin();
        let pitch_errors = (0..gear.teeth()).map(error).collect();
        gear.clone().with_modifications(GearModifications { pitch_errors, ..GearModifications::default() }).unwrap()
    };
    case.pair = GearPair::new(wrong(&case.pair.pinion, 0.3), wrong(&case.pair.wheel, 1.1), None).unwrap();
    let contact = StaticOptions { torque: TORQUE, ..case.slice_options() };
    let bench = MovingPair::new(case, contact, 8);
    for share in [0.35, 1.0] {
        let hz = share * bench.resonance_hz();
        let system = bench.system(hz, |_| ());
        let (request, mesh) = map_of(&system, 2e-4).unwrap_or_else(|e| panic!("{e}"));
        let flanks = system.flanks().expect("they are solved");
        let told = mesh.pitch_error(flanks, system.pair(), &request).unwrap_or_else(|e| panic!("{e}"));
        let mut map = machine(&system.on_map(mesh));
        let told = told.expect("there are pitch errors");
        let times = bench.times_showing(&system, Scheme::GeneralisedAlpha { rho: 0.8 }, [STEPS, 0]);
        let mut exact = bench.motion(system, times);
        let start = exact.state().clone();
        let a = rows(&mut exact, 34);
        let (b, of_map) = map_rows(&mut map, hz, 34, &start);
        let rms = (a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt();
        let (off, most) = (rms / peak_to_peak(&a), worst(&a, &b) / peak_to_peak(&a));
        println!(
            "{share} of the resonance: p-p {:.4} um, off by {off:.1e}, {most:.1e} of it; {:.2} us a step; {told:?}",
            1e3 * peak_to_peak(&a),
            1e6 * of_map / b.len() as f64
        );
        assert!(off < 1e-2, "at {share} of the resonance the map moves off by {off:e} of the peak to peak");
        assert!(told.rms_mm < 1e-2 * bench.ste[0], "{told:?}");
    }
}

/// A million steps of free vibration at a phase that stands still, contact lost in each: energy stays what it is.
#[test]
fn energy_stays_on_a_map() {
    let bench = bench();
    let (mut map, _) = mapped(bench, 1000.0, 1e-3, |o| {
        o.drive = Drive::Speed(Speed::Constant(0.0));
        o.damping = MeshDamping::PerLength(0.0);
    });
    let step = 1.0 / bench.resonance_hz() / 23.7;
    let scale = DVector::from_element(1, 1e-3);
    let mut integrator = Integrator::new(Scheme::Energy, StepControl::Fixed(step), scale);
    let mut state = State::new(0.0, DVector::from_element(1, 2.5 * bench.ste[0]), DVector::zeros(1));
    let (mut least, steps) = (f64::INFINITY, 1e6);
    integrator
        .advance(&mut map, &mut state, steps * step, |_, progress| least = least.min(progress.state.q[0]))
        .unwrap_or_else(|e| panic!("{e}"));
    let ledger = *integrator.ledger().expect("steps were taken");
    let drift = ledger.residual() / ledger.initial;
    println!("lag down to {:.3} um, energy drifts by {drift:.1e} of {:.3e} N mm", 1e3 * least, ledger.initial);
    assert!(least < 0.0, "contact was never lost: the lag stays above {least:e} mm");
    assert!(drift.abs() < 1e-9, "energy drifts by {drift:e}");
}

/// What a map does not hold is refused, by name.
#[test]
fn what_no_map_holds_is_refused() {
    let bench = bench();
    let idle = bench.system(1000.0, |o| o.load = Torque::Constant(0.0));
    let error = idle.map_request(4.0, [1e-3; 2]).expect_err("no load says what forces occur");
    assert!(error.to_string().contains("load"), "{error}");
}
