//! Whether a motion repeats itself.

use std::collections::VecDeque;

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::{Motion, PairMotionError, Swing};
use crate::motion::State;

/// Longest period that is looked for, mesh cycles.
pub const LONGEST_PERIOD: usize = 8;
/// A longer period must do this much better than a shorter one: what dies away in beats is nearer to itself after some cycles than after one.
const CLEARLY: f64 = 0.03;
/// Peak to peak below which a coordinate counts as still, over its scale.
const STILL: f64 = 1e-6;

/// How nearly a motion repeats itself.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Periodicity {
    /// Mesh cycles after which it does best: 1, or more where a subharmonic answer has been found.
    pub period: usize,
    /// Largest difference of a coordinate or a velocity after that many cycles, over its peak to peak in a cycle.
    pub residual: f64,
}

/// States at the beginnings of the last mesh cycles.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Returns {
    starts: VecDeque<[DVector<f64>; 2]>,
}

impl Returns {
    /// From a state on.
    pub fn from(state: &State) -> Self {
        Self { starts: VecDeque::from([[state.q.clone(), state.v.clone()]]) }
    }

    /// Takes the state at the end of a cycle. The shortest period wins that is within `tolerance`, else the best one; a longer one only where it does clearly better.
    ///
    /// `scale`: sizes of the coordinates that are looked at, from the first on ([`Motion::returning`]). A driver that a torque turns has no place to return to: of the coordinate `free`, only the velocity is looked at.
    pub fn judge(
        &mut self,
        state: &State,
        swing: &Swing,
        scale: &DVector<f64>,
        free: Option<usize>,
        tolerance: f64,
    ) -> Periodicity {
        let now = [state.q.clone(), state.v.clone()];
        let size = swing.peak_to_peak();
        let mut best = Periodicity { period: 1, residual: f64::INFINITY };
        for (i, before) in self.starts.iter().rev().enumerate() {
            let residual = difference([&now, before], &size, scale, free);
            if i == 0 || residual < CLEARLY * best.residual {
                best = Periodicity { period: i + 1, residual };
            }
            if best.residual <= tolerance {
                break;
            }
        }
        if self.starts.len() == LONGEST_PERIOD {
            self.starts.pop_front();
        }
        self.starts.push_back(now);
        best
    }
}

/// Largest difference of two states over peak to peak values; for what is still, over its scale.
pub(super) fn difference(
    [now, before]: [&[DVector<f64>; 2]; 2],
    size: &[DVector<f64>; 2],
    scale: &DVector<f64>,
    free: Option<usize>,
) -> f64 {
    let mut worst = 0.0f64;
    for k in 0..scale.len() {
        // A velocity is still when it belongs to a coordinate that is.
        let rate = if size[0][k] > 0.0 { size[1][k] / size[0][k] } else { 0.0 };
        let least = [STILL * scale[k], STILL * scale[k] * rate];
        for part in 0..2 {
            if part == 0 && free == Some(k) {
                continue;
            }
            let off = (now[part][k] - before[part][k]).abs();
            if off > 0.0 {
                worst = worst.max(off / size[part][k].max(least[part]).max(f64::MIN_POSITIVE));
            }
        }
    }
    worst
}

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
    let mut returns = Returns::from(motion.state());
    let mut last = Periodicity { period: 1, residual: f64::INFINITY };
    for _ in 0..most {
        let swing = motion.run_cycle(None)?;
        let free = motion.system().coordinates().driver_turn();
        last = returns.judge(motion.state(), &swing, &motion.returning(), free, tolerance);
        seen(motion, last);
        if last.residual <= tolerance {
            break;
        }
    }
    Ok(last)
}
