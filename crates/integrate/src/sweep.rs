//! A sweep over the values of a parameter: each answer starts where the one before ended.

use std::ops::ControlFlow;

use rayon::prelude::*;

/// Order in which a sweep goes through its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepDirection {
    /// Every value starts by itself.
    Independent,
    /// Sweep from the first value to the last, each beginning where the one before ended.
    Up,
    /// Sweep from the last value to the first.
    Down,
}

/// Answers at all values (ascending), one list a direction, in the order in which that goes through them. Directions, and
/// independent values, run in parallel; answers are the same for any number of threads.
///
/// `at` answers at a value from the end of another one, or from a start of its own; with the answer it gives its own end.
/// A value that cannot go on from its neighbour starts by itself, unless `final_failure` says that the start does not
/// matter. After a value without an answer the sweep goes on from the last one that has one. `seen` gets each answer and
/// may end its direction there.
pub fn sweep<V: Sync, P: Send, S, E: Send>(
    values: &[V],
    directions: &[SweepDirection],
    at: impl Fn(SweepDirection, &V, Option<&S>) -> Result<(P, S), E> + Sync,
    final_failure: impl Fn(&E) -> bool + Sync,
    seen: impl Fn(&V, &Result<P, E>) -> ControlFlow<()> + Sync,
) -> Vec<Vec<(usize, Result<P, E>)>> {
    let one = |way: SweepDirection, i: usize, from: Option<&S>| {
        let value = &values[i];
        let carried = from.map(|from| at(way, value, Some(from)));
        let (answer, end) = match carried {
            Some(Ok(found)) => Ok(found),
            Some(Err(error)) if final_failure(&error) => Err(error),
            Some(Err(_)) | None => at(way, value, None),
        }
        .map_or_else(|error| (Err(error), None), |(answer, end)| (Ok(answer), Some(end)));
        let goes_on = seen(value, &answer);
        ((i, answer), end, goes_on)
    };
    let along = |way: SweepDirection| {
        let mut order: Vec<usize> = (0..values.len()).collect();
        if way == SweepDirection::Down {
            order.reverse();
        }
        let mut last = None;
        let mut answers = Vec::with_capacity(order.len());
        for i in order {
            let (answer, end, goes_on) = one(way, i, last.as_ref());
            last = end.or(last);
            answers.push(answer);
            if goes_on.is_break() {
                break;
            }
        }
        answers
    };
    let of_direction = |&way: &SweepDirection| match way {
        SweepDirection::Independent => (0..values.len()).into_par_iter().map(|i| one(way, i, None).0).collect(),
        SweepDirection::Up | SweepDirection::Down => along(way),
    };
    directions.par_iter().map(of_direction).collect()
}
