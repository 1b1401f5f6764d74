//! How long the rest will take, from the pace of the last steps.

use std::collections::VecDeque;

/// Steps before anything is said.
const FIRST: usize = 5;
/// Steps that are remembered.
const KEPT: usize = 64;
/// What a step counts over the one after it.
const FADES: f64 = 0.95;

/// The pace of steps.
///
/// ```text
/// time of a step = sum over the last ones of 0.95^age times what each took, over sum of 0.95^age
/// ```
/// The time before the first step is not part of it: much of it prepares what serves all (the first case of a plan makes
/// the models of the others). A step under way that takes longer than the others counts as the newest one.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pace {
    /// When the last steps were done, s.
    ends: VecDeque<f64>,
}

impl Pace {
    /// One more step is done, `at` seconds into the work.
    pub fn step(&mut self, at: f64) {
        if self.ends.len() == KEPT {
            self.ends.pop_front();
        }
        self.ends.push_back(at);
    }

    /// Seconds for so many further steps, `now` seconds into the work; `None` while too little is known.
    pub fn rest(&self, steps: u64, now: f64) -> Option<f64> {
        let last = *self.ends.back().filter(|_| self.ends.len() >= FIRST)?;
        let (mut sum, mut weights, mut weight) = (0.0, 0.0, 1.0);
        for (before, after) in self.ends.iter().zip(self.ends.iter().skip(1)).rev() {
            sum += weight * (after - before);
            weights += weight;
            weight *= FADES;
        }
        let waited = (now - last).max(0.0);
        let mut each = sum / weights;
        if waited > each {
            each = (waited + FADES * sum) / (1.0 + FADES * weights);
        }
        // The step under way may end at any time once it has taken as long as others.
        Some(each * steps.saturating_sub(1) as f64 + (each - waited).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pace(ends: impl IntoIterator<Item = f64>) -> Pace {
        let mut pace = Pace::default();
        ends.into_iter().for_each(|at| pace.step(at));
        pace
    }

    /// The first case makes the models of all: 32 s of it say nothing on the other 111, of 0.25 s each.
    #[test]
    fn what_prepares_the_work_says_nothing_on_the_rest() {
        assert_eq!(pace([32.0]).rest(111, 32.0), None, "one step is no pace");
        let rest = pace((0..10).map(|i| 32.0 + 0.25 * f64::from(i))).rest(102, 34.25).unwrap();
        assert!((rest - 25.5).abs() < 1e-9, "{rest} s");
    }

    /// The last steps count most, a slow one under way as well, and between steps the rest goes down.
    #[test]
    fn the_rest_follows_the_last_steps() {
        let mut slower = pace((0..64).map(f64::from));
        assert_eq!(slower.rest(10, 63.0), Some(10.0));
        assert_eq!(slower.rest(10, 63.5), Some(9.5));
        for i in 1..=60 {
            slower.step(63.0 + 4.0 * f64::from(i));
        }
        let rest = slower.rest(10, 303.0).unwrap();
        assert!((38.0..40.0).contains(&rest), "{rest} s of 10 steps of 4 s");
        let stuck = slower.rest(10, 363.0).unwrap();
        assert!(stuck > 50.0, "a step of a minute is noticed: {stuck} s for 9 more");
    }
}
