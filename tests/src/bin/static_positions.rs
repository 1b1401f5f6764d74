//! The work of static positions, for a program that counts instructions: the default pair on its committed meshes.
//!
//! `static_positions N` reduces both gears, and solves N mesh cycles of 32 positions on one core. What two runs
//! differ by is the positions alone. `docs/performance.md` has the figures, `.ci/run` a limit.
#![allow(clippy::print_stdout, reason = "what was counted is told")]

use fem::ElementOptions;
use ltca::{StaticError, StaticHistory, StaticModel};
use testing::Case;

/// Positions of a mesh cycle in `scenes/default.toml`.
const POSITIONS: usize = 32;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let cycles: usize = std::env::args().nth(1).ok_or("a number of mesh cycles is wanted")?.parse()?;
    let case = Case::read("coarse_hex20_pinion.msh", "coarse_hex20_wheel.msh", ElementOptions::default());
    let mut model = case.reduced(case.slice_options());
    // All of it on one thread, from which `run` does not part: a counter that starts with it sees it whole.
    let core = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let history = core.install(|| solve_cycles(&mut model, cycles))?;
    let mean_um = 1e3 * history.positions.iter().map(|p| p.transmission_error).sum::<f64>()
        / history.positions.len().max(1) as f64;
    println!("{} positions, mean transmission error {mean_um:.6} um", history.positions.len());
    Ok(())
}

/// What is counted: a function of its own in every build, so that the counter finds its name.
#[inline(never)]
fn solve_cycles(model: &mut StaticModel, cycles: usize) -> Result<StaticHistory, StaticError> {
    model.run(POSITIONS, cycles, |_, _, _| ())
}
