//! Complete state of a motion at one time, from which it can be continued bit by bit.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

/// State of a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time of the state.
    pub time: f64,
    /// Coordinates.
    pub q: DVector<f64>,
    /// Velocities.
    pub v: DVector<f64>,
    /// Accelerations, from M a = f.
    pub a: DVector<f64>,
    /// The integrator's own acceleration (generalised-alpha); equal to `a` in an initial state.
    pub averaged: DVector<f64>,
    /// Powers of drives and loads, and of dampers, at this state, if the integrator computes work from them.
    pub powers: [f64; 2],
    /// Step that the step control would take next; 0 in an initial state.
    pub next_step: f64,
    /// Step that led here; 0 in an initial state.
    pub last_step: f64,
}

impl State {
    /// State with coordinates and velocities; the integrator computes the accelerations.
    pub fn new(time: f64, q: DVector<f64>, v: DVector<f64>) -> Self {
        let n = q.len();
        let rest = || DVector::zeros(n);
        Self { time, q, v, a: rest(), averaged: rest(), powers: [0.0; 2], next_step: 0.0, last_step: 0.0 }
    }

    /// Copies another state of as many coordinates into this one's memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        let Self { time, q, v, a, averaged, powers, next_step, last_step } = self;
        let copied = [(q, &other.q), (v, &other.v), (a, &other.a), (averaged, &other.averaged)];
        // Of few numbers: an iterator of nalgebra takes longer than they do.
        copied.into_iter().for_each(|(own, other)| own.as_mut_slice().copy_from_slice(other.as_slice()));
        (*time, *powers) = (other.time, other.powers);
        (*next_step, *last_step) = (other.next_step, other.last_step);
    }
}
