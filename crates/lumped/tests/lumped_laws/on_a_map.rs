//! The limit in which a map of the contact is a cheaper model: teeth whose compliance does not depend on the force.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{convert::Infallible, f64::consts::TAU};

use contact_map::{ContactMap, ContactSample, LoadedSlice, MapPlan, PhaseContact};
use integrate::{Forces, Integrator, Mechanism, MotionError, Scheme, State, StepControl};
use lumped::{
    DeadZone, Fourier, FourierTorque, LumpedModel, MeshClock,
    lumped8::{Lumped8, MeshLaw, Motion8},
    starting_state,
};
use nalgebra::{DMatrix, DVector};
use study::{Lyapunov, LyapunovPlan, largest_lyapunov};

use crate::{common::seed_004, lumped8::MOTOR};

/// Stiffness of the teeth at a phase, behind half of the backlash.
struct Teeth {
    stiffness: f64,
    gap: f64,
}

impl PhaseContact for Teeth {
    type Error = Infallible;

    fn overlap(&mut self, approach: f64, _: f64) -> f64 {
        approach - self.gap
    }

    fn sample(&mut self, approach: f64, _: f64) -> Result<ContactSample, Infallible> {
        let force = self.stiffness * (approach - self.gap).max(0.0);
        let stiffness = if force > 0.0 { self.stiffness } else { 0.0 };
        Ok(ContactSample {
            force,
            stiffness,
            slices: vec![LoadedSlice { force, length: 10.0, lever: 0.0, pair: 0, friction: [0.0; 3] }],
        })
    }
}

/// Eight coordinates with the springs of the teeth from a map.
struct OnMap {
    model: Motion8,
    map: ContactMap,
}

impl OnMap {
    fn new(parameters: &Lumped8, force: f64) -> Self {
        let (model, pair) = (parameters.motion().unwrap(), &parameters.pair);
        let cos = pair.frame.local_helix().cos();
        let plan = MapPlan {
            mean_force: force,
            largest_force: 400.0 * force,
            tilt: None,
            width: 10.0,
            half_path: None,
            tolerance: 1e-7,
            worst: 1e-7,
        };
        let at = |phase: f64| {
            let time = (phase - pair.clock.start) / pair.clock.mesh_frequency();
            let stiffness = pair.excitation(time)[0] / (cos * cos);
            Ok::<_, Infallible>(Teeth { stiffness, gap: parameters.half_backlash })
        };
        Self { model, map: ContactMap::build(&plan, &|_| {}, at).unwrap() }
    }
}

impl Mechanism for OnMap {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        self.model.mass()
    }

    /// The model's own, its springs taken out and the map's put in.
    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        self.model.forces(t, q, v, out)?;
        let Lumped8 { pair, half_backlash, .. } = self.model.parameters();
        let (sin, cos) = pair.frame.local_helix().sin_cos();
        let [r, big_r] = pair.base_radii;
        let normal = [0.0, cos, -sin, r * cos, 0.0, -cos, sin, big_r * cos];
        let [k, error, _] = pair.excitation(t);
        let apart = normal.iter().zip(q).map(|(a, x)| a * x).sum::<f64>() - error * cos;
        let spring = k / (cos * cos) * DeadZone::new(*half_backlash).at(apart).value;
        let place = self.map.place(pair.clock.cycles(t), 0.0);
        let mapped = self.map.force(&place, apart) - self.map.force(&place, -apart);
        for (f, a) in out.conservative.iter_mut().zip(normal) {
            *f += (spring - mapped) * a;
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        self.model.potential(t, q)
    }
}

/// The state a mesh cycle after another.
fn advance<M: Mechanism>(
    motion: &mut M,
    (scale, period): (&DVector<f64>, f64),
    x: &[f64],
) -> Result<Vec<f64>, MotionError<M::Error>> {
    let mut state = State::new(0.0, DVector::from_row_slice(&x[..8]), DVector::from_row_slice(&x[8..]));
    let step = StepControl::Fixed(period / 64.0);
    let mut integrator = Integrator::new(Scheme::GeneralisedAlpha { rho: 0.9 }, step, scale.clone());
    integrator.advance(motion, &mut state, period, |_, _| ())?;
    Ok(state.q.iter().chain(state.v.iter()).copied().collect())
}

/// Exponents of a map whose compliance is constant are those of the spring with backlash that it is, to 1 %: of a motion
/// that repeats itself, and of chaos for as long as both follow one orbit; later they are two samples of one average.
#[test]
fn a_map_of_springs_has_the_exponents_of_springs() {
    let mut model = seed_004(MeshLaw::Normal, 0.0);
    for support in &mut model.supports {
        (support.stiffness, support.damping) = ([1e7; 3], [100.0; 3]);
    }
    (model.supports[0].turning_stiffness, model.supports[0].turning_damping) = MOTOR;
    let force = 0.02 * model.pair.cycle.stiffness.mean * 0.1;
    model.pair.torques = model.pair.base_radii.map(|r| FourierTorque::constant(force * r));
    model.pair.cycle.error = Fourier::first_order(0.0, 0.02, 0.0);
    let mut model = Lumped8::new(model.pair, model.supports, 0.03, 0.1, MeshLaw::Normal).unwrap();
    let omega = model.pair.natural_frequency();
    for (w, chaotic) in [(0.4, false), (1.2, true)] {
        model.pair.clock = MeshClock::steady(30, w * omega / 30.0);
        let mut springs = model.motion().unwrap();
        let mut mapped = OnMap::new(&model, force);
        let period = 1.0 / model.pair.clock.mesh_frequency();
        let start = starting_state(&springs);
        let mut x: Vec<f64> = start.q.iter().chain(start.v.iter()).copied().collect();
        let scale = springs.scale();
        let both: Vec<f64> = scale.iter().copied().chain(scale.iter().map(|s| s * TAU / period)).collect();
        for _ in 0..300 {
            x = advance(&mut springs, (&scale, period), &x).unwrap();
        }
        let mut exponents = |stretches: usize| -> [Lyapunov; 2] {
            let plan = LyapunovPlan { stretch: period, settling: 5, stretches, distance: 1e-7 };
            [
                largest_lyapunov(&x, &both, &plan, |x, _| advance(&mut springs, (&scale, period), x)).unwrap(),
                largest_lyapunov(&x, &both, &plan, |x, _| advance(&mut mapped, (&scale, period), x)).unwrap(),
            ]
        };
        let [of_springs, of_map] = exponents(25);
        let apart = of_map.exponent / of_springs.exponent - 1.0;
        println!("W {w}: {:.4} and {:.4} a cycle", of_springs.exponent * period, of_map.exponent * period);
        assert!(apart.abs() < 0.01, "W {w}: {of_springs:?} and on the map {of_map:?}, {:.2} % apart", 100.0 * apart);
        assert_eq!(of_springs.exponent > 0.0, chaotic, "W {w}: {of_springs:?}");
        if chaotic {
            let [of_springs, of_map] = exponents(600);
            let sigma = of_springs.error.hypot(of_map.error);
            println!("W {w}, 600 cycles: {of_springs:?}, {of_map:?}");
            let apart = (of_map.exponent - of_springs.exponent).abs();
            assert!(apart < 3.5 * sigma, "W {w}: {of_springs:?} and on the map {of_map:?}");
        }
    }
}
