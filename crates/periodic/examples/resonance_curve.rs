//! The resonance curve of a mass on a spring with clearance, around its folds: what waiting shows, and the unstable
//! motions between.
//!
//! `cargo run --release -p periodic --example resonance_curve`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{convert::Infallible, error::Error, f64::consts::TAU, ops::ControlFlow};

use integrate::{Forces, Mechanism};
use nalgebra::{DMatrix, DVector, dvector};
use periodic::{BalanceOptions, BranchOptions, FourierSeries, PeriodicFamily, Tracer};

/// x'' + 0.1 x' + f(x) = 0.1 + 0.05 W^2 cos W t, f the part of x beyond 1 on either side; W is the parameter.
struct Clearance {
    mass: DMatrix<f64>,
    frequency: f64,
}

impl Mechanism for Clearance {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let beyond = q[0].signum() * (q[0].abs() - 1.0).max(0.0);
        out.conservative[0] = -beyond;
        out.other[0] = 0.1 + 0.05 * self.frequency.powi(2) * (self.frequency * t).cos() - 0.1 * v[0];
        (out.stiffness[(0, 0)], out.damping[(0, 0)]) = (f64::from(beyond != 0.0), 0.1);
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * (q[0].abs() - 1.0).max(0.0).powi(2))
    }
}

impl PeriodicFamily for Clearance {
    fn set_parameter(&mut self, value: f64) -> Result<(), Infallible> {
        self.frequency = value;
        Ok(())
    }

    fn period(&self) -> f64 {
        TAU / self.frequency
    }

    fn scale(&self) -> DVector<f64> {
        dvector![1.0]
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut system = Clearance { mass: DMatrix::identity(1, 1), frequency: 0.5 };
    let start = FourierSeries::at_rest(&dvector![1.1], 4);
    let mut tracer = Tracer::new(&mut system, BalanceOptions::default(), 1.0)?;
    let options = BranchOptions { range: [0.5, 1.1], first_step: 0.01, longest_step: 0.05, most: 200 };
    let branch = tracer.branch(0.5, &start, &options, |_| ControlFlow::Continue(()))?;
    println!("{:>8} {:>13} {:>11}", "W", "peak to peak", "multiplier");
    for motion in &branch.motions {
        let peak_to_peak = motion.series.peak_to_peak(&dvector![1.0]);
        println!("{:>8.4} {peak_to_peak:>13.4} {:>11.3}", motion.parameter, motion.floquet.largest());
    }
    branch.bifurcations.iter().for_each(|b| println!("{:?} at W = {:.5}", b.loss, b.motion.parameter));
    Ok(())
}
