//! Tests whether a motion is periodic.

use std::collections::VecDeque;

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::State;

/// Longest period that is searched, in periods of the excitation.
pub const LONGEST_PERIOD: usize = 8;
/// Largest ratio of residuals with which a longer period replaces a shorter one: decaying beats come nearer to
/// themselves after some cycles than after one.
const CLEARLY_SMALLER: f64 = 0.03;
/// Peak to peak below which a coordinate counts as still, over its scale.
const STILL_AMPLITUDE: f64 = 1e-6;

/// Smallest and largest coordinates and velocities over some time, such as a period.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Envelope {
    low: [DVector<f64>; 2],
    high: [DVector<f64>; 2],
}

impl Envelope {
    /// Envelope of one state: its smallest and largest values are those of that state.
    pub fn new(state: &State) -> Self {
        let both = [state.q.clone(), state.v.clone()];
        Self { low: both.clone(), high: both }
    }

    /// Extends the envelope to a further state.
    pub fn widen(&mut self, state: &State) {
        self.take_in([&state.q, &state.v], [&state.q, &state.v]);
    }

    /// Over this time and another one.
    pub(crate) fn joined(mut self, other: &Self) -> Self {
        self.take_in(other.low.each_ref(), other.high.each_ref());
        self
    }

    fn take_in(&mut self, lows: [&DVector<f64>; 2], highs: [&DVector<f64>; 2]) {
        for i in 0..2 {
            self.low[i].zip_apply(lows[i], |low, x| *low = low.min(x));
            self.high[i].zip_apply(highs[i], |high, x| *high = high.max(x));
        }
    }

    /// Whether the envelope is one of `n` coordinates.
    pub(crate) fn is_of(&self, n: usize) -> bool {
        self.low.iter().chain(&self.high).all(|part| part.len() == n)
    }

    /// Peak to peak of coordinates and velocities.
    pub fn peak_to_peak(&self) -> [DVector<f64>; 2] {
        [0, 1].map(|i| &self.high[i] - &self.low[i])
    }
}

/// Periodicity of a motion: how accurately it repeats.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Periodicity {
    /// Number of periods after which it repeats best: 1, or more for a subharmonic response.
    pub period: usize,
    /// Largest difference of a coordinate or a velocity after that number of periods, relative to its peak to peak in a
    /// period.
    pub residual: f64,
}

/// States at the beginnings of the last periods.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Recurrence {
    starts: VecDeque<[DVector<f64>; 2]>,
}

impl Recurrence {
    /// Starts the comparison at a state.
    pub fn from(state: &State) -> Self {
        Self { starts: VecDeque::from([[state.q.clone(), state.v.clone()]]) }
    }

    /// Whether its states have `n` coordinates.
    pub(crate) fn is_of(&self, n: usize) -> bool {
        self.starts.iter().flatten().all(|part| part.len() == n)
    }

    /// Takes the state at the end of a period. The result is the shortest period within `tolerance`, otherwise the best
    /// one. A longer period is chosen only if its residual is clearly smaller.
    ///
    /// `scale` has the magnitudes of the coordinates that are compared, starting with the first. The coordinate `free`
    /// need not return (the rotation of a driver that a torque drives); only its velocity is compared.
    pub fn judge(
        &mut self,
        state: &State,
        envelope: &Envelope,
        scale: &DVector<f64>,
        free: Option<usize>,
        tolerance: f64,
    ) -> Periodicity {
        let now = [state.q.clone(), state.v.clone()];
        let size = envelope.peak_to_peak();
        let mut best = Periodicity { period: 1, residual: f64::INFINITY };
        for (i, before) in self.starts.iter().rev().enumerate() {
            let residual = difference([&now, before], &size, scale, free);
            if i == 0 || residual < CLEARLY_SMALLER * best.residual {
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

/// Largest difference of two states relative to peak-to-peak values; for coordinates at rest, relative to their scale.
/// Coordinates with an infinite scale are not compared.
pub fn difference(
    [now, before]: [&[DVector<f64>; 2]; 2],
    size: &[DVector<f64>; 2],
    scale: &DVector<f64>,
    free: Option<usize>,
) -> f64 {
    let mut worst = 0.0f64;
    for k in (0..scale.len()).filter(|k| scale[*k].is_finite()) {
        // A velocity is still when it belongs to a coordinate that is.
        let rate = if size[0][k] > 0.0 { size[1][k] / size[0][k] } else { 0.0 };
        let least = [STILL_AMPLITUDE * scale[k], STILL_AMPLITUDE * scale[k] * rate];
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

/// Difference after one cycle, over the peak to peak, below which a motion dies out to period one rather than having a
/// longer period.
const SUBHARMONIC: f64 = 0.01;

/// One number of each row of the last cycles, to test whether a motion is periodic.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SignalRecurrence {
    cycles: VecDeque<Vec<f64>>,
}

impl SignalRecurrence {
    /// Takes the rows of one more cycle. A period of several cycles counts only if the motion clearly differs after one
    /// cycle, because a slowly decaying vibration may look similar after a few cycles by chance.
    ///
    /// Largest difference of a row from the row that number of cycles earlier. It is relative to the peak to peak of
    /// this cycle or, if larger, to a millionth of its largest value. So a signal without vibration counts as periodic.
    pub fn judge(&mut self, rows: Vec<f64>, tolerance: f64) -> Periodicity {
        let (low, high) = rows.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| (a.min(x), b.max(x)));
        let size = (high - low).max(1e-6 * low.abs().max(high.abs())).max(f64::MIN_POSITIVE);
        let mut once = f64::INFINITY;
        let mut best = Periodicity { period: 1, residual: f64::INFINITY };
        for (i, before) in self.cycles.iter().rev().enumerate() {
            // What is no number is never small.
            let worse = |a: f64, b: f64| if a.is_nan() || a >= b { a } else { b };
            let residual = rows.iter().zip(before).map(|(a, b)| (a - b).abs()).fold(0.0, worse) / size;
            if i == 0 {
                once = residual;
            }
            if i == 0 || (once > SUBHARMONIC && residual < best.residual) {
                best = Periodicity { period: i + 1, residual };
            }
            if residual <= tolerance {
                break;
            }
        }
        if self.cycles.len() == LONGEST_PERIOD {
            self.cycles.pop_front();
        }
        self.cycles.push_back(rows);
        best
    }
}
