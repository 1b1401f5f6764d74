//! A mass on a spring with clearance, shaken: any mechanism goes through the same integrators, and its energy is
//! booked.
//!
//! `cargo run --release -p integrate --example clearance`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{convert::Infallible, error::Error, f64::consts::TAU};

use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use nalgebra::{DMatrix, DVector, dvector};

/// m x'' + c x' + k f(x) = F + A cos(w t), f the part of x beyond 1 mm on either side; t, s, N, mm.
struct Clearance {
    mass: DMatrix<f64>,
}

const STIFFNESS: f64 = 1e5;
const DAMPING: f64 = 5.0;
const FREQUENCY: f64 = TAU * 40.0;

impl Mechanism for Clearance {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let drive = 200.0 + 1500.0 * (FREQUENCY * t).cos();
        out.conservative[0] = -STIFFNESS * beyond(q[0]);
        out.other[0] = drive - DAMPING * v[0];
        out.stiffness[(0, 0)] = if beyond(q[0]) == 0.0 { 0.0 } else { STIFFNESS };
        out.damping[(0, 0)] = DAMPING;
        (out.supplied, out.dissipated) = (drive * v[0], DAMPING * v[0] * v[0]);
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * STIFFNESS * beyond(q[0]).powi(2))
    }
}

fn beyond(x: f64) -> f64 {
    x.signum() * (x.abs() - 1.0).max(0.0)
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("{:>32} {:>10} {:>16}", "scheme", "x [mm]", "energy lost [%]");
    for scheme in [Scheme::Energy, Scheme::GeneralisedAlpha { rho: 0.9 }, Scheme::DormandPrince] {
        let mut mass = Clearance { mass: DMatrix::from_element(1, 1, 1e-3) };
        let mut integrator = Integrator::new(scheme, StepControl::Fixed(2e-5), dvector![1.0]);
        let mut state = State::new(0.0, dvector![1.0], dvector![0.0]);
        integrator.advance(&mut mass, &mut state, 0.25, |_, _| ())?;
        let lost = integrator.ledger().map_or(0.0, |ledger| 100.0 * ledger.relative_residual());
        println!("{:>32} {:>10.5} {lost:>16.1e}", format!("{scheme:?}"), state.q[0]);
    }
    Ok(())
}
