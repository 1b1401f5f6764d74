//! Events within a step: sign changes of functions of the motion.

use nalgebra::DVector;

use crate::{Mechanism, MotionError, State};

/// Direction in which an event function crossed zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// Upwards, from below zero.
    Up,
    /// Downwards, from above zero.
    Down,
}

/// A located event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Index of the event function.
    pub event: usize,
    /// Time of the event, s.
    pub time: f64,
    /// Direction of the crossing.
    pub direction: Direction,
}

/// Coordinates and velocities within a step, by the cubic through both ends with their velocities.
pub(crate) fn interpolated(from: &State, to: &State, share: f64) -> (DVector<f64>, DVector<f64>) {
    let h = to.time - from.time;
    let (s, r) = (share, 1.0 - share);
    let q = (r * r * (1.0 + 2.0 * s)) * &from.q + (s * s * (1.0 + 2.0 * r)) * &to.q + (h * s * r * r) * &from.v
        - (h * s * s * r) * &to.v;
    // Velocities by the cubic through velocities and accelerations.
    let v = (r * r * (1.0 + 2.0 * s)) * &from.v + (s * s * (1.0 + 2.0 * r)) * &to.v + (h * s * r * r) * &from.a
        - (h * s * s * r) * &to.a;
    (q, v)
}

/// Share of the step at which `value` changes sign, given its values at both ends (of different sign): bisection and
/// false position in turns.
pub(crate) fn root<E>(ends: [f64; 2], mut value: impl FnMut(f64) -> Result<f64, E>) -> Result<f64, E> {
    let ([mut low, mut high], [mut at_low, mut at_high]) = ([0.0, 1.0], ends);
    for i in 0..60 {
        let slope = at_high - at_low;
        let secant = if slope == 0.0 { 0.5 } else { -at_low / slope };
        let share = if i % 3 == 2 || !(0.0..=1.0).contains(&secant) { 0.5 } else { secant };
        let middle = low + share * (high - low);
        let at = value(middle)?;
        if at == 0.0 {
            return Ok(middle);
        }
        if (at >= 0.0) == (at_low >= 0.0) {
            (low, at_low) = (middle, at);
        } else {
            (high, at_high) = (middle, at);
        }
        if high - low < 1e-13 {
            break;
        }
    }
    Ok(high)
}

/// Values of all events of a system at a state.
pub(crate) fn event_values<M: Mechanism>(
    system: &mut M,
    (time, q, v): (f64, &DVector<f64>, &DVector<f64>),
    values: &mut [f64],
) -> Result<(), MotionError<M::Error>> {
    if values.is_empty() {
        return Ok(());
    }
    system.event_values(time, q, v, values).map_err(|source| MotionError::Mechanism { time, source })
}

/// Events within a step between values `before` and `after`, in the order of time.
pub(crate) fn crossings<M: Mechanism>(
    system: &mut M,
    from: &State,
    to: &State,
    before: &[f64],
    after: &[f64],
) -> Result<Vec<Crossing>, MotionError<M::Error>> {
    let mut found = Vec::new();
    let mut values = Vec::new();
    for event in (0..before.len()).filter(|&i| (before[i] >= 0.0) != (after[i] >= 0.0)) {
        let h = to.time - from.time;
        let share = root([before[event], after[event]], |share| {
            let (q, v) = interpolated(from, to, share);
            values.resize(before.len(), 0.0);
            event_values(system, (from.time + share * h, &q, &v), &mut values)?;
            Ok(values[event])
        })?;
        let direction = if before[event] < 0.0 { Direction::Up } else { Direction::Down };
        found.push(Crossing { event, time: from.time + share * h, direction });
    }
    found.sort_by(|a, b| a.time.total_cmp(&b.time));
    Ok(found)
}
