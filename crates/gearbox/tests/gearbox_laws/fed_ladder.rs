//! The ladder of models on one pair: the lumped ones, fed by the reduced one, beside it in motion.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Station;
use dynamics::{RigidBody, equivalent_mass};
use fem::ElementOptions;
use gearbox::motion::PairModel;
use geometry::{Driver, Sense};
use integrate::{Integrator, Scheme, State, StepControl};
use lumped::{
    LumpedModel, LumpedPair, MeshCycle, Operation,
    lumped8::{Lumped8, MeshLaw, Support8},
    lumped12::{Lumped12, Support12},
    starting_state,
};
use nalgebra::DVector;
use testing::{
    Case,
    moving::{at_speed, machine, rigid_bodies},
};

const TORQUE: f64 = 150e3;
/// Positions a mesh cycle that the lumped models are fed with, and steps of every model.
const FED: usize = 32;
const STEPS: usize = 64;
const CYCLES: usize = 6;
const ZETA: f64 = 0.1;

/// Dynamic transmission error (mm) of the reduced model over the last of [`CYCLES`] mesh cycles, every other step.
fn reduced(case: &Case, bodies: [RigidBody; 2], speed: f64, start: f64, means: [f64; 2]) -> Vec<f64> {
    let contact = case.slice_options();
    let gears = case.reduced_gears(&contact);
    let options = at_speed(contact, bodies, speed, TORQUE, ZETA);
    let mut system = machine(&PairModel::new(case.pair.clone(), gears, None, options, means).unwrap());
    let mut state = State::new(0.0, DVector::from_element(1, start), DVector::zeros(1));
    let period = case.pair.pinion.pitch_angle() / speed;
    let scheme = Scheme::GeneralisedAlpha { rho: 0.9 };
    let step = StepControl::Fixed(period / STEPS as f64);
    let mut integrator = Integrator::new(scheme, step, DVector::from_element(1, 1e-3));
    let mut te = Vec::new();
    let mut until = |time: f64, te: &mut Vec<f64>| {
        te.push(state.q[0]);
        integrator.advance(&mut system, &mut state, time, |_, _| ()).unwrap_or_else(|e| panic!("{e}"));
    };
    until((CYCLES - 1) as f64 * period, &mut te);
    te.clear();
    for k in 1..=FED {
        until(((CYCLES - 1) as f64 + k as f64 / FED as f64) * period, &mut te);
    }
    te
}

/// The same of a lumped model.
fn lumped<M: LumpedModel>(mut model: M) -> Vec<f64> {
    let period = 1.0 / model.pair().clock.mesh_frequency();
    let step = StepControl::Fixed(period / STEPS as f64);
    let mut integrator = Integrator::new(Scheme::GeneralisedAlpha { rho: 0.9 }, step, model.scale());
    let mut state = starting_state(&model);
    let mut te = Vec::new();
    for k in 1..=CYCLES * FED {
        te.push(model.row(state.time, &state.q, &state.v).transmission_error);
        let Ok(()) = integrator.advance(&mut model, &mut state, k as f64 / FED as f64 * period, |_, _| ()) else {
            panic!("row {k}")
        };
    }
    te.split_off((CYCLES - 1) * FED)
}

/// Largest difference over the mean, and over the peak to peak, of the first.
fn apart(a: &[f64], b: &[f64]) -> [f64; 2] {
    let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let mean = a.iter().sum::<f64>() / a.len() as f64;
    let [low, high] = [f64::min, f64::max].map(|f| a.iter().copied().reduce(f).unwrap());
    [off / mean, off / (high - low)]
}

/// Issue of the ladder: fed by the reduced model (tangent stiffness, contact-line length, STE, inertia), `lumped12`'s
/// DTE stays within 5 % of it away from resonance, and within 5 % of its peak to peak; `lumped8`'s too. The driver's
/// speed is prescribed, bodies held but for the driven gear's turn; coarse meshes of the default pair.
#[test]
fn fed_models_follow_the_reduced_one() {
    let case = Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default());
    let bodies = rigid_bodies(&case.meshes);
    let mut model = case.reduced(case.slice_options());
    let all: Vec<_> = (0..FED)
        .map(|i| model.solve(Station { cycle: 0, phase: i as f64 / FED as f64 }).unwrap_or_else(|e| panic!("{e}")))
        .collect();
    let column = |f: fn(&ltca::StaticPosition) -> f64| all.iter().map(f).collect::<Vec<f64>>();
    let stiffness = column(|p| p.tangent_stiffness);
    let length = column(|p| p.contact_line_length);
    let ste = column(|p| p.transmission_error);
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let means = [mean(&stiffness), mean(&length)];
    let base = [case.pair.pinion.base_radius(), case.pair.wheel.base_radius()];
    let inertia = [0, 1].map(|i| bodies[i].polar_inertia / (base[i] * base[i]));
    let omega = (means[0] / equivalent_mass(inertia, Some(0))).sqrt();
    let cycle = MeshCycle::fed(&stiffness, &length, &ste, TORQUE / base[1]).unwrap();
    for share in [0.05, 0.3, 1.7] {
        let speed = share * omega / f64::from(case.pair.pinion.teeth());
        let wanted = reduced(&case, bodies, speed, ste[0], means);
        let operation = Operation { driver: Driver::Pinion, sense: Sense::Ccw, speed, torque: TORQUE, friction: 0.0 };
        let pair = LumpedPair::new(&case.pair, &operation, bodies, cycle.clone()).unwrap();
        // All held but the driven gear's turn.
        let held = |turn: f64| Support12 { stiffness: [1e12, 1e12, 1e12, 1e15, 1e15, turn] };
        // With the driver held the driven gear alone swings: damping refers to its mass.
        let twelve =
            Lumped12 { pair: pair.clone(), supports: [held(1e15), held(0.0)], rayleigh: [0.0, 2.0 * ZETA / omega] };
        let still =
            |turning_stiffness: f64| Support8 { stiffness: [1e12; 3], turning_stiffness, ..Support8::default() };
        let mesh_damping = 2.0 * ZETA * means[0] / omega;
        let eight = Lumped8 {
            pair,
            supports: [still(1e15), still(0.0)],
            mesh_damping,
            half_backlash: 0.0,
            law: MeshLaw::Normal,
        };
        let models = [("lumped12", lumped(twelve.motion().unwrap())), ("lumped8", lumped(eight.motion().unwrap()))];
        for (name, found) in models {
            let [of_mean, of_swing] = apart(&wanted, &found);
            println!(
                "{share} of the resonance, {name}: off by {:.3} % of the DTE, {:.1} % of its peak to peak",
                100.0 * of_mean,
                100.0 * of_swing
            );
            assert!(of_mean < 0.05 && of_swing < 0.05, "{name} at {share} of the resonance: {wanted:?}, {found:?}");
        }
    }
}
