//! Killed runs end where undisturbed ones do. `kill_runs` does the same hundreds of times.

use testing::Random;
use verification::killed::tasks;

use crate::program;

#[test]
fn a_run_that_was_killed_ends_as_if_nobody_had() {
    let mut random = Random::new(11);
    let mut kills = 0;
    for task in tasks() {
        let whole = task.undisturbed(program()).unwrap();
        for _ in 0..2 {
            kills += task.disturbed(program(), &whole, &mut random).unwrap_or_else(|said| panic!("{said}"));
        }
    }
    assert!(kills >= 4, "{kills} kills met a living run");
}
