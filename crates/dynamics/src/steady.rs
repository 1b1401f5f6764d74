//! Waiting for a periodic answer.

use integrate::{Periodicity, Recurrence};

use crate::{Motion, PairMotionError};

/// Runs mesh cycles until the motion repeats itself within `tolerance`, `most` at the most; `seen` is told of each.
///
/// # Errors
/// [`PairMotionError`]. A motion that does not become periodic is none: its residual says so.
pub fn run_to_steady(
    motion: &mut Motion,
    tolerance: f64,
    most: u64,
    mut seen: impl FnMut(&Motion, Periodicity),
) -> Result<Periodicity, PairMotionError> {
    let mut returns = Recurrence::from(motion.state());
    let mut last = Periodicity { period: 1, residual: f64::INFINITY };
    for _ in 0..most {
        let envelope = motion.run_cycle(None)?;
        let free = motion.system().coordinates().driver_turn();
        last = returns.judge(motion.state(), &envelope, &motion.returning(), free, tolerance);
        seen(motion, last);
        if last.residual <= tolerance {
            break;
        }
    }
    Ok(last)
}
