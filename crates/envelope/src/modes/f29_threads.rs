//! F29: sums whose order depends on the threads.

use std::sync::{Condvar, Mutex, PoisonError};

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

/// What a pool of so many threads finds.
struct Found {
    /// Everything, at rest and in motion, as text that has every bit.
    bits: String,
    /// Threads of the pool that have answered.
    threads: usize,
    /// Line loads of all slices at rest, N/mm.
    loads: Vec<f64>,
}

fn found_by(bench: &Bench, threads: usize) -> Result<Found, EnvelopeError> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().map_err(EnvelopeError::of("threads"))?;
    let answered = pool.broadcast(|_| std::thread::current().id());
    pool.install(|| {
        let rest = bench.at_rest(&AS_IT_IS)?.history;
        let motion = bench.in_motion(&MOTION)?.rows;
        let motion = motion.part(0..motion.len())?;
        let slices = rest.positions.iter().flat_map(|p| &p.pairs).flat_map(|pair| &pair.slices);
        Ok(Found {
            bits: format!("{rest:?} {motion:?}"),
            threads: answered.iter().enumerate().filter(|(i, id)| !answered[..*i].contains(id)).count(),
            loads: slices.map(|s| s.line_load).collect(),
        })
    })
}

/// Sum of terms that so many threads share, each adding its part to the total as it finishes. To be the same on every
/// machine they finish in an order that is given, the last one first: with a lock alone it would be any.
fn summed_as_they_finish(terms: &[f64], threads: usize) -> f64 {
    let parts = terms.chunks(terms.len().div_ceil(threads).max(1));
    let (total, next) = (Mutex::new((parts.len(), 0.0)), Condvar::new());
    std::thread::scope(|scope| {
        for (i, part) in parts.enumerate() {
            let (total, next) = (&total, &next);
            scope.spawn(move || {
                let own: f64 = part.iter().sum();
                let guard = total.lock().unwrap_or_else(PoisonError::into_inner);
                let turn = next.wait_while(guard, |(left, _)| *left != i + 1);
                let mut guard = turn.unwrap_or_else(PoisonError::into_inner);
                *guard = (i, guard.1 + own);
                next.notify_all();
            });
        }
    });
    total.into_inner().unwrap_or_else(PoisonError::into_inner).1
}

/// Number of answers that differ from the first.
fn differ<T: PartialEq>(all: &[T]) -> f64 {
    all.iter().skip(1).filter(|other| **other != all[0]).count() as f64
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let found = THREADS.map(|threads| found_by(bench, threads));
    let found: Vec<Found> = found.into_iter().collect::<Result<_, _>>()?;
    let bits: Vec<&String> = found.iter().map(|f| &f.bits).collect();
    let sums = THREADS.map(|threads| summed_as_they_finish(&found[0].loads, threads).to_bits());
    Ok(vec![
        Figure::new(
            "answers with 2, 7 and 16 threads that differ from that with one, in any bit; naive: sums of the same \
             answer's loads, shared by as many threads and added as these finish",
            Shown::at_most(differ(&bits), 0.0),
        )
        .beside(Shown::at_least(differ(&sums), 1.0)),
        Figure::new(
            "threads that took part, of all four pools",
            Shown::at_least(found.iter().map(|f| f.threads as f64).sum(), THREADS.iter().sum::<usize>() as f64),
        ),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One bit in one answer is seen; a sum by one thread is the plain one, and by more it is another.
    #[test]
    fn a_bit_is_seen() {
        assert_eq!(differ(&[1.0, 1.0, 1.0]), 0.0);
        assert_eq!(differ(&[1.0, 1.0, 1.0 + f64::EPSILON]), 1.0);
        let terms: Vec<f64> = (1..200).map(|i| 1.0 / f64::from(i)).collect();
        assert_eq!(summed_as_they_finish(&terms, 1), terms.iter().sum::<f64>());
        assert_ne!(summed_as_they_finish(&terms, 7), summed_as_they_finish(&terms, 1));
        assert_eq!(summed_as_they_finish(&terms, 7), summed_as_they_finish(&terms, 7));
    }
}
