//! The time loop: cycle after cycle of any mechanism, with rows, counts, events and energy.
//!
//! | module | what it does |
//! |---|---|
//! | `timetable` | [`Timetable`]: cycles, rows and steps of a motion |
//! | `cycle` | one cycle: the only place that advances a motion |
//! | `stage` | [`Stage`]: how far a motion has come; what is compared from cycle to cycle |
//! | `run` | settle, then rows; checkpoints on the way; who is told ([`Follower`]) |
//! | `checkpoint` | [`Checkpoint`]: a motion as numbers, gone on from to the same bits |

mod checkpoint;
mod cycle;
mod run;
mod stage;
mod timetable;

use serde::{Deserialize, Serialize};

pub use checkpoint::{Checkpoint, Resumable};
pub use cycle::{Row, RowReader};
pub use run::{Follower, Goal, OnlyRows};
pub use stage::{Compared, Settle, Stage};
pub use timetable::{Ahead, CycleTimes, EvenRows, Method, RowPlace, Stop, Timetable};

use crate::{Integrator, Ledger, Mechanism, MotionError, State};

/// Counts of a motion since its energy balance started.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Number of steps taken.
    pub steps: u64,
    /// Number of steps that were rejected because their error was too large, or that were divided.
    pub refused: u64,
    /// Number of zero crossings of each event function: upwards, and downwards.
    pub crossings: Vec<[u64; 2]>,
}

impl Counts {
    /// Number of upward zero crossings of event `event`; 0 for an event that does not exist.
    pub fn ups(&self, event: usize) -> u64 {
        self.crossings.get(event).map_or(0, |both| both[0])
    }

    /// Number of downward zero crossings of event `event`; 0 for an event that does not exist.
    pub fn downs(&self, event: usize) -> u64 {
        self.crossings.get(event).map_or(0, |both| both[1])
    }
}

/// A motion of a mechanism in progress, according to a timetable.
#[derive(Debug)]
pub struct Course<M, T> {
    system: M,
    timetable: T,
    state: State,
    ledger: Option<Ledger>,
    cycle: u64,
    counts: Counts,
    stage: Stage,
    /// What goes on from one cycle to the next; none where all is forgotten in between.
    integrator: Option<Integrator>,
}

impl<M: Mechanism, T: Timetable<M>> Course<M, T> {
    /// A motion at the start of cycle 0 in a given state.
    pub fn new(system: M, timetable: T, state: State) -> Self {
        let (counts, stage) = (Counts::default(), Stage::default());
        Self { system, timetable, state, ledger: None, cycle: 0, counts, stage, integrator: None }
    }

    /// The mechanism.
    pub fn system(&self) -> &M {
        &self.system
    }

    /// Access to the mechanism, for a search that leaves it unchanged.
    pub fn system_mut(&mut self) -> &mut M {
        &mut self.system
    }

    /// Returns the mechanism at the end of its motion.
    pub fn into_system(self) -> M {
        self.system
    }

    /// The timetable: cycles, rows and steps.
    pub fn timetable(&self) -> &T {
        &self.timetable
    }

    /// State at the end of the last cycle.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Energy so far; `None` before the first cycle.
    pub fn ledger(&self) -> Option<&Ledger> {
        self.ledger.as_ref()
    }

    /// Number of completed cycles.
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// Counts so far.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Average number of steps per cycle with rows; `None` before the first.
    pub fn steps_per_cycle(&self) -> Option<f64> {
        let Stage { recorded, steps_before, .. } = self.stage;
        (recorded > 0).then(|| self.counts.steps.saturating_sub(steps_before) as f64 / recorded as f64)
    }

    /// Stage of the motion.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// Whether there is a further cycle; a run-down may end before it.
    pub fn goes_on(&self) -> bool {
        self.timetable.cycle(&self.system, self.cycle, self.state.time).is_some()
    }

    /// Times of the next `count` cycles; `None` if the motion ends before.
    pub fn ahead(&self, count: u64) -> Option<Ahead> {
        let mut begin = self.state.time;
        let one = |k| {
            let times = self.timetable.cycle(&self.system, self.cycle + k, begin)?;
            begin = times.stops.last().map_or(begin, |stop| stop.time);
            Some(times)
        };
        let cycles = (0..count).map(one).collect::<Option<_>>()?;
        Some(Ahead { state: self.state.clone(), method: self.timetable.method(&self.system), cycles })
    }

    /// Continues from another state at the same time, with its accelerations. Energy balance and counts restart.
    ///
    /// # Errors
    /// [`MotionError`] if the energy of the state cannot be computed.
    pub fn replace(&mut self, state: State) -> Result<(), MotionError<M::Error>> {
        let time = state.time;
        let potential = self.system.potential(time, &state.q);
        let potential = potential.map_err(|source| MotionError::Mechanism { time, source })?;
        self.ledger = Some(Ledger::open(self.system.mass(), &state.v, potential));
        (self.state, self.counts, self.integrator) = (state, Counts::default(), None);
        Ok(())
    }
}
