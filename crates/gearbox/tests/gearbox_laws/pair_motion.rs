//! A pair in motion: slow running is quasi-static, heavy load is linear, energy is accounted for.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Station;
use dynamics::{MotionOptions, equivalent_mass};
use fem::ElementOptions;
use gearbox::motion::PairModel;
use integrate::{Integrator, Scheme, State, StepControl};
use ltca::StaticOptions;
use nalgebra::DVector;
use testing::{
    Case,
    moving::{at_speed, machine, rigid_bodies},
};

const TORQUE: f64 = 150e3;

fn options(case: &Case, contact: StaticOptions, speed: f64, zeta: f64) -> MotionOptions {
    at_speed(contact, rigid_bodies(&case.meshes), speed, TORQUE, zeta)
}

/// STE (mm) at phases i / n, mean tangent stiffness (N/mm) and line length (mm).
fn statics(case: &Case, contact: &StaticOptions, n: usize) -> (Vec<f64>, [f64; 2]) {
    let mut model = case.reduced(contact.clone());
    let all: Vec<_> = (0..n)
        .map(|i| model.solve(Station { cycle: 0, phase: i as f64 / n as f64 }).unwrap_or_else(|e| panic!("{e}")))
        .collect();
    let mean = |f: fn(&ltca::StaticPosition) -> f64| all.iter().map(f).sum::<f64>() / n as f64;
    let means = [mean(|p| p.tangent_stiffness), mean(|p| p.contact_line_length)];
    (all.iter().map(|p| p.transmission_error).collect(), means)
}

fn coarse() -> Case {
    Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default())
}

/// Speed to zero: DTE = STE at every phase.
#[test]
fn slow_running_is_quasi_static() {
    let case = coarse();
    let contact = case.slice_options();
    let n = 16;
    let (ste, means) = statics(&case, &contact, n);
    let gears = case.reduced_gears(&contact);
    // 2 mesh cycles a second against a resonance of some kHz.
    let speed = 2.0 * case.pair.pinion.pitch_angle();
    let system = PairModel::new(case.pair.clone(), gears, None, options(&case, contact, speed, 0.1), means).unwrap();
    let mut system = machine(&system);
    let mut state = State::new(0.0, DVector::from_element(1, ste[0]), DVector::zeros(1));
    let h = 0.5 / n as f64;
    // Large steps: what is faster than them is damped away in one.
    let mut integrator = Integrator::new(
        Scheme::GeneralisedAlpha { rho: 0.0 },
        StepControl::Fixed(h / 4.0),
        DVector::from_element(1, 1e-3),
    );
    let mut dte = Vec::new();
    integrator
        .advance(&mut system, &mut state, 0.5 * 2.0, |_, seen| dte.push((seen.state.time, seen.state.q[0])))
        .unwrap_or_else(|e| panic!("{e}"));
    let mut worst = 0.0f64;
    for (t, q) in dte.iter().filter(|(t, _)| *t > 0.49) {
        let phase = (t / 0.5).fract();
        let i = (phase * n as f64).round() as usize % n;
        if (phase * n as f64 - i as f64).abs() > 1e-6 {
            continue;
        }
        worst = worst.max((q / ste[i] - 1.0).abs());
    }
    println!("{} steps, DTE off STE by {:.2e} at most", dte.len(), worst);
    assert!(worst < 1e-3, "{worst}");
}

/// Free vibration about the loaded equilibrium rings where sqrt(k / m) says.
#[test]
fn resonance_is_where_stiffness_and_inertia_say() {
    let case = coarse();
    let contact = case.slice_options();
    let (ste, means) = statics(&case, &contact, 1);
    let gears = case.reduced_gears(&contact);
    let still = options(&case, contact, 1e-9, 0.0);
    let inertia = [0, 1].map(|i| {
        let base = [case.pair.pinion.base_radius(), case.pair.wheel.base_radius()][i];
        still.bodies[i].polar_inertia / (base * base)
    });
    let expected = (means[0] / equivalent_mass(inertia, Some(0))).sqrt();
    let mut system = machine(&PairModel::new(case.pair.clone(), gears, None, still, means).unwrap());
    let amplitude = 1e-3 * ste[0];
    let mut state = State::new(0.0, DVector::from_element(1, ste[0] + amplitude), DVector::zeros(1));
    let period = std::f64::consts::TAU / expected;
    let mut integrator =
        Integrator::new(Scheme::Energy, StepControl::Fixed(period / 200.0), DVector::from_element(1, 1e-3));
    let (mut ups, mut last, mut open) = (Vec::new(), amplitude, 0.0f64);
    integrator
        .advance(&mut system, &mut state, 5.25 * period, |_, seen| {
            let x = seen.state.q[0] - ste[0];
            if last < 0.0 && x >= 0.0 {
                ups.push(seen.state.time - period / 200.0 * x / (x - last));
            }
            last = x;
            open = open.max(seen.ledger.residual().abs());
        })
        .unwrap_or_else(|e| panic!("{e}"));
    let found = std::f64::consts::TAU * (ups.len() - 1) as f64 / (ups[ups.len() - 1] - ups[0]);
    println!(
        "{:.1} Hz, {:.1} expected; energy open by {open:.1e} N mm",
        found / std::f64::consts::TAU,
        expected / std::f64::consts::TAU
    );
    assert!((found / expected - 1.0).abs() < 5e-3, "{found} rad/s, not {expected}");
    assert!(open < 1e-7, "{open:e} N mm");
}
