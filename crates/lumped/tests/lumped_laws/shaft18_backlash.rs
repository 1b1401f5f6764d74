//! Lumped shafts with and without backlash: bifurcations, chaos, sidebands (seed 002).
//!
//! The seed reports chaos without backlash as well. Its equations cannot have any: without a clearance they are linear
//! with periodic coefficients, so that all motions tend to one, or grow without bounds where the stiffness excites
//! them. What is reproduced is the rest: with backlash period-one windows alternate with chaos, the more the faster.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use integrate::{Scheme, State, StepControl};
use lumped::LumpedError;
use lumped::shaft18::ShaftMechanism;
use nalgebra::DVector;
use study::{Branch, Lyapunov, LyapunovPlan, Window};

use crate::{
    gearbox::light,
    recording::{Recording, shafts, strobe},
};

/// Half of a backlash of 40 um, mm.
const HALF_BACKLASH: f64 = 0.02;
/// Steps a mesh period.
const STEPS: u32 = 64;

struct Settled {
    model: ShaftMechanism,
    state: State,
}

impl Settled {
    /// At `speed` (rad/s), after `periods` of the mesh.
    fn new(speed: f64, half_backlash: f64, periods: usize) -> Result<Self, LumpedError> {
        let model = ShaftMechanism::new(&light(speed, half_backlash))?;
        let q = model.static_state(0.0)?;
        let n = q.len();
        let mut settled = Self { model, state: State::new(0.0, q, DVector::zeros(n)) };
        settled.points(periods);
        Ok(settled)
    }

    /// Compression once a mesh period, um.
    fn points(&mut self, periods: usize) -> Vec<f64> {
        let Self { model, state } = self;
        (0..periods).map(|_| 1e3 * strobe(model, STEPS, state).compression).collect()
    }

    fn lyapunov(mut self, stretches: usize) -> Lyapunov {
        let n = self.state.q.len();
        let stretch = self.model.mesh_period(0).unwrap();
        let start: Vec<f64> = self.state.q.iter().chain(&self.state.v).copied().collect();
        // Ten microns, and what goes that far in a period.
        let place = 0.01 * self.model.scale();
        let scale: Vec<f64> = place.iter().copied().chain(place.iter().map(|s| s / stretch)).collect();
        let plan = LyapunovPlan { stretch, settling: 150, stretches, distance: 1e-6 };
        study::largest_lyapunov(&start, &scale, &plan, |x, k| {
            let (q, v) = (DVector::from_column_slice(&x[..n]), DVector::from_column_slice(&x[n..]));
            let mut state = State::new(k as f64 * stretch, q, v);
            strobe(&mut self.model, STEPS, &mut state);
            Ok::<_, LumpedError>(state.q.iter().chain(&state.v).copied().collect())
        })
        .unwrap()
    }
}

fn diagram(speeds: &[f64], half_backlash: f64) -> Vec<Branch> {
    let points = |speed| Settled::new(speed, half_backlash, 240).map(|mut settled| settled.points(48));
    let all: Vec<Branch> =
        speeds.iter().map(|&value| Branch { value, points: points(value).unwrap_or_else(|e| panic!("{e}")) }).collect();
    for branch in &all {
        let [low, high] = branch.extent().unwrap();
        let points = branch.distinct(0.05);
        println!(
            "2 b_n = {} um, {} rad/s: {points} points in {low:.2} .. {high:.2} um",
            2e3 * half_backlash,
            branch.value
        );
    }
    all
}

/// Without backlash one point at every speed, and every difference dies out.
#[test]
fn without_backlash_every_motion_repeats_with_the_mesh() {
    for branch in diagram(&[350.0, 600.0, 850.0, 1250.0, 1600.0], 0.0) {
        assert_eq!(branch.distinct(0.05), 1, "{} rad/s", branch.value);
    }
    let found = Settled::new(1250.0, 0.0, 240).unwrap().lyapunov(150);
    println!("1250 rad/s without backlash: {:.1} +- {:.1} 1/s", found.exponent, found.error);
    assert!(found.exponent + found.error < 0.0, "{found:?}");
}

/// With backlash: windows of one point with a negative exponent between bands of many points with a positive one; most
/// of the upper range is chaotic.
#[test]
fn with_backlash_chaos_and_windows_alternate() {
    let speeds = [250.0, 350.0, 450.0, 500.0, 550.0, 600.0, 650.0, 750.0, 850.0, 950.0, 1100.0, 1250.0, 1400.0, 1600.0];
    let all = diagram(&speeds, HALF_BACKLASH);
    let many = |b: &&Branch| b.distinct(0.05) > 20;
    let [slow, fast] =
        [250.0..700.0, 800.0..1700.0].map(|range| all.iter().filter(|b| range.contains(&b.value)).filter(many).count());
    assert!((2..6).contains(&slow) && fast >= 5, "{slow} of 7 speeds below and {fast} of 6 above the mesh resonance");
    for (speed, chaotic) in [(500.0, false), (600.0, true), (750.0, false), (1250.0, true)] {
        let found = Settled::new(speed, HALF_BACKLASH, 240).unwrap().lyapunov(200);
        let points = all.iter().find(|b| b.value == speed).unwrap().distinct(0.05);
        println!("{speed} rad/s: {points} points, {:.1} +- {:.1} 1/s", found.exponent, found.error);
        if chaotic {
            assert!(found.is_chaotic() && found.exponent > 50.0 && points > 20, "{speed} rad/s: {found:?}, {points}");
        } else {
            assert!(found.exponent + found.error < 0.0 && points == 1, "{speed} rad/s: {found:?}, {points}");
        }
    }
}

/// Backlash of 50 um, shaft at 50 Hz, little load, run-out of 20 um: teeth separate once a turn more than on the other
/// side of it, and lines stand one shaft frequency beside the multiples of the mesh frequency about the mesh's natural
/// one (3.5 kHz). Without backlash there is next to nothing of them.
#[test]
fn backlash_brings_sidebands_at_shaft_frequency() {
    let [without, with] = [0.0, 0.025].map(|half_backlash| {
        let mut system = light(TAU * 50.0, half_backlash);
        system.torques[0].torque = 5e3;
        system.torques[1].torque = 5e3 * 46.0 / 30.0;
        system.meshes[0].run_out[0].eccentricity = 0.02;
        let mut model = ShaftMechanism::new(&system).unwrap();
        let step = model.mesh_period(0).unwrap() / f64::from(STEPS);
        let (control, rows) = (StepControl::Fixed(step), (0.3 / step).round() as usize);
        let plan = Recording { scheme: Scheme::RungeKutta4, control, settle: 0.2, duration: 0.6, rows };
        let rows = shafts(&mut model, 0, &plan).rows;
        let forces: Vec<f64> = rows.iter().map(|r| r.normal_force).collect();
        study::spectrum(&forces, 0.5 * f64::from(STEPS) * 1500.0, Window::BlackmanHarris).unwrap()
    });
    for carrier in [3000.0, 4500.0] {
        let [a, b] = [&without, &with].map(|s| s.sidebands(carrier, 50.0, 1).unwrap());
        for (a, line) in a.pairs[0].iter().zip(&b.pairs[0]) {
            let (place, with, without) = (line.frequency, line.amplitude, a.amplitude);
            println!("{place:.2} Hz: {without:.3} N without, {with:.3} N with backlash, floor {:.3} N", b.floor);
            assert!(((place - carrier).abs() - 50.0).abs() < 1.7, "{place} Hz beside {carrier} Hz");
            assert!(
                with > 10.0 * without && with > 3.0 * b.floor,
                "{place} Hz: {without} N, {with} N, floor {} N",
                b.floor
            );
        }
    }
}
