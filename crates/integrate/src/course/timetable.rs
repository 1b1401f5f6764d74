//! Timetable of a motion: cycles, rows within them, and steps.

use nalgebra::DVector;

use crate::{Integrator, Mechanism, Scheme, State, StepControl};

/// Integration method without the length of its steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Method {
    /// Scheme of the integration.
    pub scheme: Scheme,
    /// Magnitude of each coordinate that counts as large, > 0.
    pub scale: DVector<f64>,
    /// Whether a step ends wherever an event function changes its sign.
    pub stop_at_events: bool,
    /// Whether a step of given length is divided if an explicit method would be unstable with the whole step.
    pub keep_stable: bool,
}

impl Method {
    /// An integrator with this method and this step control.
    pub fn integrator(self, control: StepControl) -> Integrator {
        let plain = Integrator::new(self.scheme, control, self.scale).stopping_at_events(self.stop_at_events);
        if self.keep_stable { plain.keeping_stable() } else { plain }
    }
}

/// A time at which a step must end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Time, s.
    pub time: f64,
    /// Whether a row is written there.
    pub is_row: bool,
}

impl Stop {
    /// A stop with a row.
    pub fn row(time: f64) -> Self {
        Self { time, is_row: true }
    }
}

/// Positions of the rows in a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowPlace {
    /// Rows at the beginning of the interval of each stop with a row.
    Beginnings,
    /// Rows at each stop with a row.
    Ends,
    /// Rows after every n-th step, n >= 1; steps of equal length hit the rows exactly.
    Steps(u64),
}

/// Steps and rows of one cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleTimes {
    /// Times at which steps must end, ascending; the last one ends the cycle. Empty: the cycle takes no time.
    pub stops: Vec<Stop>,
    /// Positions of the rows in the cycle.
    pub rows: RowPlace,
    /// Length of the steps between the stops.
    pub control: StepControl,
}

/// The next cycles of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Ahead {
    /// State at their beginning.
    pub state: State,
    /// Integration method.
    pub method: Method,
    /// Times of the cycles.
    pub cycles: Vec<CycleTimes>,
}

/// Division of the time of a motion into cycles.
pub trait Timetable<M: Mechanism> {
    /// Method of integration for a mechanism.
    fn method(&self, system: &M) -> Method;

    /// Times of cycle `cycle`, counted from 0, which begins at the time `begin` (s). `None` if the motion ends before
    /// the end of this cycle.
    fn cycle(&self, system: &M, cycle: u64, begin: f64) -> Option<CycleTimes>;

    /// Whether the memory of mechanism and integrator is discarded at the beginning of every cycle. Otherwise it is
    /// discarded only where a motion can be continued from a checkpoint.
    fn restarts(&self) -> bool {
        true
    }
}

/// Two cycles: one without rows, in which the motion settles, then one with evenly spaced rows, each at the beginning
/// of its interval.
#[derive(Debug, Clone, PartialEq)]
pub struct EvenRows {
    /// Integration method.
    pub method: Method,
    /// Length of the steps; a step ends at every row.
    pub control: StepControl,
    /// Time of the first row, s.
    pub first: f64,
    /// Time between rows, s.
    pub spacing: f64,
    /// Number of rows.
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
