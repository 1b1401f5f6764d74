//! One contact solve: how does a crowned flank share a load over its face width?
//!
//! Slices of 1 mm, each with the Hertzian dent of two cylinders, on a tooth that carries load along to its neighbours.
//!
//! `cargo run -p contact --example crowned_flank`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::PI;

use contact::{
    ContactError,
    complementarity::{Balance, DenseProblem, DenseSolver},
    line::hertz,
};
use faer::Mat;

const SLICES: usize = 21;
const SLICE_MM: f64 = 1.0;
const RADIUS_MM: f64 = 8.0;
/// Depth to which the dent is counted, mm; deeper down it is bending of the tooth.
const DEPTH_MM: f64 = 2.5;

fn main() -> Result<(), ContactError> {
    let steel = (2.06e5, 0.3);
    let modulus = hertz::effective_modulus([steel, steel]);
    let z = |i: usize| (i as f64 - 0.5 * (SLICES - 1) as f64) * SLICE_MM;
    let gaps: Vec<f64> = (0..SLICES).map(|i| 0.010 * (z(i) / 10.0).powi(2)).collect(); // 10 um at the ends
    let compliance = Mat::from_fn(SLICES, SLICES, |i, j| 2e-6 * (-(z(i) - z(j)).abs() / 6.0).exp());
    let levers = vec![-42.0; SLICES]; // base radius: turning by dtheta closes every gap by 42 mm dtheta

    // Dent of both flanks under a line load F/h, and its slope: 2 (1 - nu^2)/(pi E) F/h (2 ln(2t/a) - nu/(1-nu)).
    let dent = |_: usize, force: f64| {
        let load = (force / SLICE_MM).max(1e-3);
        let half_width = hertz::half_width(load, RADIUS_MM, modulus);
        let c = 2.0 * (1.0 - steel.1 * steel.1) / (PI * steel.0);
        let depth = 2.0 * (2.0 * DEPTH_MM / half_width).ln() - steel.1 / (1.0 - steel.1);
        (c * force.max(0.0) / SLICE_MM * depth, c / SLICE_MM * (depth - 1.0))
    };
    let problem = DenseProblem {
        compliance: compliance.as_ref(),
        symmetric: true,
        gaps: &gaps,
        levers: &levers,
        torque_levers: &levers,
        balance: Balance::Moment(-80e3),
    };
    let mut solver = DenseSolver::new(SLICES);
    solver.solve(&problem, dent, |_| 0.0)?;

    println!(
        "80 N m on 42 mm: approach {:.3} um, {} of {SLICES} slices press, {} Newton steps, conditions hold to {:.0e}",
        42e3 * solver.rotation().abs(),
        solver.active().len(),
        solver.iterations(),
        solver.residual()
    );
    println!("{:>6} {:>12} {:>10} {:>16}", "z, mm", "load, N/mm", "p0, MPa", "half-width, mm");
    for (i, force) in solver.forces().iter().enumerate() {
        let load = force / SLICE_MM;
        let [p0, a] = [hertz::line_pressure(load, RADIUS_MM, modulus), hertz::half_width(load, RADIUS_MM, modulus)];
        println!("{:>6.1} {load:>12.2} {p0:>10.1} {a:>16.4}", z(i));
    }
    Ok(())
}
