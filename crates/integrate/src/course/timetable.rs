//! Timetable of a motion: cycles, rows within them, and steps.

use nalgebra::DVector;

use crate::{Integrator, Mechanism, Scheme, State, StepControl};

/// Method of integration, but for the length of steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Method {
    /// Method of integration.
    pub scheme: Scheme,
    /// What counts as a large motion of each coordinate, > 0.
    pub scale: DVector<f64>,
    /// Ends a step wherever an event function changes its sign.
    pub stop_at_events: bool,
    /// Divides a step of given length where an explicit method would be unstable with the whole.
    pub keep_stable: bool,
}

impl Method {
    /// An integrator with steps of these lengths.
    pub fn integrator(self, control: StepControl) -> Integrator {
        let plain = Integrator::new(self.scheme, control, self.scale).stopping_at_events(self.stop_at_events);
        if self.keep_stable { plain.keeping_stable() } else { plain }
    }
}

/// A time at which a step ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Time, s.
    pub time: f64,
    /// Whether a row belongs to it.
    pub is_row: bool,
}

impl Stop {
    /// Stop with a row.
    pub fn row(time: f64) -> Self {
        Self { time, is_row: true }
    }
}

/// Place of rows in a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowPlace {
    /// Rows at the beginning of each stop with a row.
    Beginnings,
    /// Rows at each stop with a row.
    Ends,
    /// Behind every so many-th step, >= 1: steps of equal length meet the rows by themselves.
    Steps(u64),
}

/// Steps and rows of one cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleTimes {
    /// Times at which steps end, ascending; the last one ends the cycle. None: the cycle takes no time.
    pub stops: Vec<Stop>,
    /// Place of rows in the cycle.
    pub rows: RowPlace,
    /// Length of the steps between the stops.
    pub control: StepControl,
}

/// Cycles that come next in a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Ahead {
    /// Where they begin.
    pub state: State,
    /// Method of their steps.
    pub method: Method,
    /// Their times.
    pub cycles: Vec<CycleTimes>,
}

/// Divides the time of a motion.
pub trait Timetable<M: Mechanism> {
    /// Method of integration for a mechanism.
    fn method(&self, system: &M) -> Method;

    /// Times of cycle `cycle`, counted from 0, which begins at the time `begin` (s). `None` where the motion ends before
    /// this cycle is over.
    fn cycle(&self, system: &M, cycle: u64, begin: f64) -> Option<CycleTimes>;

    /// Whether all that mechanism and integrator remember is forgotten at the beginning of every cycle; else only where
    /// a motion can be taken up again.
    fn restarts(&self) -> bool {
        true
    }
}

/// A cycle without rows, of which a motion settles, then one with rows that are evenly spaced, at the beginning of each
/// interval.
#[derive(Debug, Clone, PartialEq)]
pub struct EvenRows {
    /// Method of integration.
    pub method: Method,
    /// Length of the steps; one ends at every row.
    pub control: StepControl,
    /// Time of the first row, s.
    pub first: f64,
    /// Time from row to row, s.
    pub spacing: f64,
    /// Rows.
    pub rows: usize,
}

impl<M: Mechanism> Timetable<M> for EvenRows {
    fn method(&self, _: &M) -> Method {
        self.method.clone()
    }

    fn cycle(&self, _: &M, cycle: u64, _: f64) -> Option<CycleTimes> {
        let stops = match cycle {
            0 => vec![Stop { time: self.first, is_row: false }],
            1 => (1..=self.rows).map(|k| Stop::row(self.first + k as f64 * self.spacing)).collect(),
            _ => return None,
        };
        Some(CycleTimes { stops, rows: RowPlace::Beginnings, control: self.control })
    }

    fn restarts(&self) -> bool {
        false
    }
}
