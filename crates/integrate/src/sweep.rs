//! A sweep over the values of a parameter; each solution starts where the preceding one ended.

use std::ops::ControlFlow;

use rayon::prelude::*;

/// Order in which a sweep takes its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepDirection {
    /// Every value starts separately.
    Independent,
    /// From the first value to the last; each starts where the preceding one ended.
    Up,
    /// From the last value to the first; each starts where the preceding one ended.
    Down,
}

/// Results at all values (ascending), one list per direction, in the order of the sweep. Directions, and independent
/// values, run in parallel; the results are the same for any number of threads.
///
/// `at` solves at a value, from the final state of another one or from its own start, and returns the result with its
/// final state. A value that cannot continue from its neighbour starts separately, unless `final_failure` says that the
/// start does not matter. After a value without a result the sweep continues from the last value with a result. `seen`
/// receives each result and may end its direction there.
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
