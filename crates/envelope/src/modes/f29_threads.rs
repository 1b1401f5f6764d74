//! F29: sums whose order depends on the threads.

use rayon::ThreadPoolBuilder;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 29,
    name: "results that depend on threads",
    file: "F29-threads",
    scene: scene_text!("F29-threads"),
    fails: "Sums in the order in which threads finish: the last digits change from run to run, and chaotic motions with them.",
    does: "Sums have a fixed order; the same bits for any number of threads.",
    naive: &[],
    look,
};

const THREADS: [usize; 4] = [1, 2, 7, 16];
const MOTION: [&str; 5] = [
    "analysis.kind=dynamic",
    "analysis.cycles=2",
    "operation.speed_rpm=6000",
    "motion.run=span",
    "motion.steps_per_mesh_cycle=16",
];

/// Everything that was found, at rest and in motion, as text that has every bit.
fn all_bits(bench: &Bench, threads: usize) -> Result<String, EnvelopeError> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().map_err(EnvelopeError::of("threads"))?;
    pool.install(|| {
        let rest = bench.at_rest(&AS_IT_IS)?.history;
        let motion = bench.in_motion(&MOTION)?.rows;
        Ok(format!("{rest:?} {motion:?}"))
    })
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let mut found = Vec::new();
    for threads in THREADS {
        found.push(all_bits(bench, threads)?);
    }
    let others = found.iter().filter(|f| **f != found[0]).count();
    // Adding the same numbers in another order is what differs: the forces of the first position, forwards and back.
    let position = &bench.at_rest(&AS_IT_IS)?.history.positions[0];
    let forces: Vec<f64> = position.pairs.iter().flat_map(|p| p.slices.iter().map(|s| s.line_load)).collect();
    let (ahead, back): (f64, f64) = (forces.iter().sum(), forces.iter().rev().sum());
    Ok(vec![
        Figure::new(
            "answers with 2, 7 and 16 threads that differ from that with one, in any bit",
            Shown::at_most(others as f64, 0.0),
        ),
        Figure::new(
            "sum of a position's forces in the other order, last bits off",
            Shown::at_most(ahead.to_bits().abs_diff(ahead.to_bits()) as f64, 0.0),
        )
        .beside(Shown::at_least(ahead.to_bits().abs_diff(back.to_bits()) as f64, 1.0)),
    ])
}
