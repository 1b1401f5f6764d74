//! A map of the contact in place of the contact itself.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{sync::OnceLock, time::Instant};

use dynamics::{MapRequest, MappedPair};
use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use ltca::StaticOptions;
use nalgebra::DVector;
use verification::moving::{MovingPair, peak_to_peak, rows, worst};

const TORQUE: f64 = 150e3;
/// Steps in a mesh cycle.
const STEPS: usize = 64;

fn bench() -> &'static MovingPair {
    static BENCH: OnceLock<MovingPair> = OnceLock::new();
    BENCH.get_or_init(|| {
        let case = verification::generated(20.0, [2, 2, 2, 2, 1]);
        let contact = StaticOptions { torque: TORQUE, ..case.slice_options() };
        MovingPair::new(case, contact, 8)
    })
}

fn mapped(bench: &MovingPair, hz: f64, tolerance: f64) -> MappedPair {
    let system = bench.system(hz, |_| ());
    let request = MapRequest { overload: 4.0, tolerance, lag: bench.ste[0] };
    MappedPair::new(system, &request).unwrap_or_else(|e| panic!("{e}"))
}

/// Forces and damping of the map are those of the contact, at loads around the one it was made for.
#[test]
fn a_map_has_the_forces_of_the_contact() {
    let bench = bench();
    let mut map = mapped(bench, 1000.0, 3e-4);
    let n = map.mass().nrows();
    let [mut a, mut b] = [Forces::zeros(n), Forces::zeros(n)];
    for i in 0..12 {
        // Within the first window: nothing moves it here.
        let (t, share) = (4e-5 * f64::from(i), 0.7 + 0.05 * f64::from(i));
        let mut exact = bench.system(1000.0, |_| ());
        let (q, v) = (DVector::from_element(n, bench.ste[0] * share), DVector::from_element(n, 1.0));
        a.clear();
        b.clear();
        exact.forces(t, &q, &v, &mut a).unwrap_or_else(|e| panic!("{e}"));
        let Ok(()) = map.forces(t, &q, &v, &mut b);
        let off = b.conservative[0] / a.conservative[0] - 1.0;
        let [k, c] = [b.stiffness[0] / a.stiffness[0] - 1.0, b.damping[0] / a.damping[0] - 1.0];
        println!("{:.3} N: {off:+.1e}, stiffness {k:+.1e}, damping {c:+.1e}", a.conservative[0]);
    }
}

fn map_rows(map: &mut MappedPair, hz: f64, cycles: usize, start: State) -> (Vec<f64>, f64) {
    let n = map.mass().nrows();
    let mut state = start;
    let step = 1.0 / hz / STEPS as f64;
    let mut integrator = Integrator::new(
        Scheme::GeneralisedAlpha { rho: 0.8 },
        StepControl::Fixed(step),
        DVector::from_element(n, 1e-3),
    );
    let mut out = Vec::new();
    let began = Instant::now();
    integrator
        .advance(map, &mut state, cycles as f64 / hz, |_, progress| out.push(progress.state.q[0]))
        .unwrap_or_else(|e| panic!("{e}"));
    (out, began.elapsed().as_secs_f64())
}

#[test]
fn a_map_moves_as_the_contact() {
    let bench = bench();
    for share in [0.1, 0.25, 0.35, 0.5, 0.6, 0.8, 0.9, 1.0, 1.1, 1.5, 2.0] {
        let hz = share * bench.resonance_hz();
        let mut map = mapped(bench, hz, 2e-4);
        let system = bench.system(hz, |_| ());
        let mut settings = bench.settings(&system, Scheme::GeneralisedAlpha { rho: 0.8 }, STEPS);
        settings.steps_per_resonance = 0;
        let mut exact = bench.motion(system, settings);
        let start = exact.state().clone();
        let cycles = 40;
        let began = Instant::now();
        let a = rows(&mut exact, cycles as u64);
        let of_exact = began.elapsed().as_secs_f64();
        let (b, of_map) = map_rows(&mut map, hz, cycles, start);
        let last = a.len() - STEPS;
        let off = worst(&a[last..], &b[last..]) / peak_to_peak(&a[last..]);
        let real = cycles as f64 / hz;
        println!(
            "{share} of the resonance: p-p {:.4} um, off {off:.1e}, p-p off {:+.1e}; real time {:.3} and {:.1}, {:.2} us a step",
            1e3 * peak_to_peak(&a[last..]),
            peak_to_peak(&b[last..]) / peak_to_peak(&a[last..]) - 1.0,
            real / of_exact,
            real / of_map,
            1e6 * of_map / b.len() as f64
        );
    }
}
