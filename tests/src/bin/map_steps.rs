//! How fast a pair moves whose contact is a map: the default pair on its committed meshes, a mesh cycle in 64 steps.
//!
//! `map_steps CYCLES [RPM]` makes the map and tells its size and error, then the time of a step and how many times
//! faster than the gears that is.
#![allow(clippy::print_stdout, reason = "what was measured is told")]

use std::time::Instant;

use fem::ElementOptions;
use gearbox::motion::MappedMesh;
use integrate::{Integrator, Scheme, StepControl};
use testing::{
    Case,
    moving::{MovingPair, started},
};

const STEPS: usize = 64;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let cycles: usize = std::env::args().nth(1).ok_or("a number of mesh cycles is wanted")?.parse()?;
    let rpm: f64 = std::env::args().nth(2).map_or(Ok(1000.0), |word| word.parse())?;
    let case = Case::read("coarse_hex20_pinion.msh", "coarse_hex20_wheel.msh", ElementOptions::default());
    let contact = case.slice_options();
    let pair = MovingPair::new(case, contact, 32);
    let hz = rpm / 60.0 * f64::from(pair.case.pair.pinion.teeth());
    let system = pair.system(hz, |_| ());
    let (_, mut state) = started(&system, 0.0);
    let began = Instant::now();
    let request = system.map_request(4.0, [2e-4; 2])?;
    let flanks = system.flanks().ok_or("flanks that are solved are wanted")?;
    let mesh = MappedMesh::new(flanks, system.pair(), &request, &|_| {})?;
    println!("map in {:.2} s: {:?}", began.elapsed().as_secs_f64(), mesh.maps().next().map(|m| *m.certificate()));
    let mut map = system.on_map(mesh).machine()?;
    let control = StepControl::Fixed(1.0 / hz / STEPS as f64);
    let scale = system.scale(pair.ste[0]);
    let mut integrator = Integrator::new(Scheme::GeneralisedAlpha { rho: 0.8 }, control, scale);
    let began = Instant::now();
    integrator.advance(&mut map, &mut state, cycles as f64 / hz, |_, _| ())?;
    let spent = began.elapsed().as_secs_f64();
    println!(
        "{rpm} 1/min, {cycles} cycles: {:.3} us a step, {:.2} times real time, lag {:.6} um",
        1e6 * spent / (cycles * STEPS) as f64,
        cycles as f64 / hz / spent,
        1e3 * state.q[0]
    );
    Ok(())
}
