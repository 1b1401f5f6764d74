//! F24: explicit steps beyond their limit.

use std::convert::Infallible;

use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use nalgebra::{DMatrix, DVector, dvector};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 24,
    name: "explicit stability limit",
    file: "F24-explicit-limit",
    scene: scene_text!("F24-explicit-limit"),
    fails: "An explicit method with steps beyond its limit grows without bounds; a contact that opens hides it for a while.",
    does: "The limit is computed from the tangents of the pair and the method's stability polynomial; longer steps are refused.",
    naive: &["motion.steps_per_mesh_cycle=8", "motion.steps_per_resonance=0"],
    look,
};

/// A mass on a spring, both 1.
struct Oscillator {
    mass: DMatrix<f64>,
}

impl Mechanism for Oscillator {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        out.conservative[0] = -q[0];
        out.stiffness[(0, 0)] = 1.0;
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * q[0] * q[0])
    }
}

/// Largest displacement of a free vibration of amplitude 1 in 400 steps of `share` times the limit.
fn growth(scheme: Scheme, share: f64) -> Result<f64, EnvelopeError> {
    let one = DMatrix::from_element(1, 1, 1.0);
    let limit = scheme.step_limit(&one, &one, &DMatrix::zeros(1, 1));
    let h = share * limit.ok_or_else(|| EnvelopeError::piece("oscillator", "the method has no limit"))?.step;
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(h), dvector![1.0]);
    let (mut state, mut sizes) = (State::new(0.0, dvector![1.0], dvector![0.0]), Vec::new());
    integrator
        .advance(&mut Oscillator { mass: one }, &mut state, 400.0 * h, |_, p| sizes.push(p.state.q[0].abs()))
        .map_err(EnvelopeError::of("oscillator"))?;
    Ok(largest(sizes))
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let mut figures = Vec::new();
    // Beyond its limit Dormand-Prince grows slowly: in 400 steps it takes more to show.
    for (name, scheme, beyond) in
        [("Runge-Kutta 4", Scheme::RungeKutta4, 1.1), ("Dormand-Prince", Scheme::DormandPrince, 2.0)]
    {
        figures.push(
            Figure::new(
                format!("{name}: largest displacement at 0.9 of the limit; naive: at {beyond}"),
                Shown::at_most(growth(scheme, 0.9)?, 1.01),
            )
            .beside(Shown::at_least(growth(scheme, beyond)?, 1e3)),
        );
    }
    let refused = bench.in_motion(&bench.naive(&[]));
    bench.in_motion(&AS_IT_IS)?;
    figures.push(Figure::new("pair with steps beyond the limit", Shown::refused(&refused, "stable up to")));
    Ok(figures)
}
