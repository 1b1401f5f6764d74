//! Skips a point that would take too long or too much memory, as predicted from the preceding point of the same series.

use study::Work;

/// Growth of a sparse 3-D factorisation with the degrees of freedom: work n^2, fill n^(4/3), by nested dissection.
const WORK_EXPONENT: f64 = 2.0;
const MEMORY_EXPONENT: f64 = 4.0 / 3.0;
/// Share of the free memory that a point may take: the estimate is one, and others use the machine too.
const SHARE: f64 = 0.8;

/// Why a mesh of `dof` degrees of freedom should not be tried in this way, after what a smaller one took; `None` when
/// it may be.
pub(super) fn refusal(smaller: &Work, dof: usize, limit_s: f64, free_mb: Option<f64>) -> Option<String> {
    let ratio = dof as f64 / smaller.dof_before.max(1) as f64;
    if let (Some(used), Some(free)) = (smaller.peak_memory_mb, free_mb) {
        let needed = used * ratio.powf(MEMORY_EXPONENT);
        if needed > SHARE * free {
            return Some(format!("too big for memory: {dof} DOF would take about {needed:.0} of {free:.0} MB free"));
        }
    }
    let run = smaller.cycle_s * smaller.positions_run as f64 / smaller.positions_asked.max(1) as f64;
    // Positions of a reduced gear go with its flanks, those of a whole one with a factorisation each.
    let online = if smaller.dof_after < smaller.dof_before { 1.0 } else { WORK_EXPONENT };
    let seconds = smaller.offline_s * ratio.powf(WORK_EXPONENT) + run * ratio.powf(online);
    (seconds > limit_s)
        .then(|| format!("{dof} DOF would take about {seconds:.0} s, the limit is {limit_s:.0} s a point"))
}
