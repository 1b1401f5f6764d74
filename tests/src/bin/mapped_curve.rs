//! The resonance curve of the default pair at FE accuracy, around its folds: harmonic balance on a map of the contact.
//!
//! `mapped_curve [DAMPING_RATIO] [TORQUE_NM]` prints the curve over the speed as a share of that at which the mesh
//! frequency meets the mesh resonance, with what it cost.
#![allow(clippy::print_stdout, reason = "the curve is what it is for")]

use std::{ops::ControlFlow, time::Instant};

use dynamics::{MapRequest, MappedPair, MeshDamping, SpeedFamily};
use fem::ElementOptions;
use nalgebra::DVector;
use periodic::{BalanceOptions, BranchOptions, FourierSeries, Tracer};
use verification::{Case, moving::MovingPair};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let word = |i: usize, default: f64| std::env::args().nth(i).map_or(Ok(default), |word| word.parse());
    let (ratio, torque) = (word(1, 0.05)?, word(2, 150.0)?);
    let case = Case::read("coarse_hex20_pinion.msh", "coarse_hex20_wheel.msh", ElementOptions::default());
    let contact = ltca::StaticOptions { torque: 1e3 * torque, ..case.slice_options() };
    let pair = MovingPair::new(case, contact, 32);
    let resonance = pair.speed(pair.resonance_hz());
    let began = Instant::now();
    let system = pair.system(0.3 * pair.resonance_hz(), |o| o.damping = MeshDamping::Ratio(ratio));
    let map = MappedPair::new(system, &MapRequest { overload: 6.0, tolerance: 2e-4, worst: 2e-4, lag: pair.ste[0] })?;
    let of_map = began.elapsed().as_secs_f64();
    println!("map: {of_map:.2} s, {:?}", map.maps().next().map(|m| *m.certificate()));
    let began = Instant::now();
    let mut family = SpeedFamily::new(map, 1, pair.ste[0])?;
    let mean = pair.ste.iter().sum::<f64>() / pair.ste.len() as f64;
    let start = FourierSeries::at_rest(&DVector::from_element(1, mean), 8);
    let options = BalanceOptions { tail: 1e-4, samples_per_harmonic: 16, ..BalanceOptions::default() };
    let mut tracer = Tracer::new(&mut family, options, resonance)?;
    let range = [0.3 * resonance, 1.4 * resonance];
    let walk = BranchOptions { range, first_step: 0.005 * resonance, longest_step: 0.1, most: 600 };
    let branch = tracer.branch(range[0], &start, &walk, |_| ControlFlow::Continue(()))?;
    let of_curve = began.elapsed().as_secs_f64();
    println!("{:>9} {:>16} {:>11} {:>10} {:>5}", "speed", "peak to peak, um", "multiplier", "harmonics", "steps");
    for motion in &branch.motions {
        let peak_to_peak = 1e3 * motion.series.peak_to_peak(&DVector::from_element(1, 1.0));
        let (speed, harmonics) = (motion.parameter / resonance, motion.series.harmonics());
        let largest = motion.floquet.largest();
        println!("{speed:>9.5} {peak_to_peak:>16.5} {largest:>11.4} {harmonics:>10} {:>5}", motion.iterations);
    }
    for b in &branch.bifurcations {
        println!("{:?} at {:.5}", b.loss, b.motion.parameter / resonance);
    }
    println!(
        "{} motions, {} Newton steps: {of_curve:.2} s, the map {of_map:.2} s",
        branch.motions.len(),
        branch.iterations
    );
    Ok(())
}
