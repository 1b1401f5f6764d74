//! The one loop in time: cycle after cycle of any mechanism, with rows, counts, events and energy.
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

/// Counts of a motion since its energy is counted.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Steps taken.
    pub steps: u64,
    /// Steps taken back because their error was too large, or taken in parts.
    pub refused: u64,
    /// How often each event function went through zero: up, and down.
    pub crossings: Vec<[u64; 2]>,
}

impl Counts {
    /// How often event `event` went up through zero; 0 for an event that there is not.
    pub fn ups(&self, event: usize) -> u64 {
        self.crossings.get(event).map_or(0, |both| both[0])
    }

    /// How often event `event` went down through zero; 0 for an event that there is not.
    pub fn downs(&self, event: usize) -> u64 {
        self.crossings.get(event).map_or(0, |both| both[1])
    }
}

/// A motion of a mechanism under way, by a timetable.
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
    /// Course at the start of cycle 0 in a state.
    pub fn new(system: M, timetable: T, state: State) -> Self {
        let (counts, stage) = (Counts::default(), Stage::default());
        Self { system, timetable, state, ledger: None, cycle: 0, counts, stage, integrator: None }
    }

    /// The mechanism.
    pub fn system(&self) -> &M {
        &self.system
    }

    /// The mechanism, for a search that leaves it as it is.
    pub fn system_mut(&mut self) -> &mut M {
        &mut self.system
    }

    /// The mechanism, at the end of its motion.
    pub fn into_system(self) -> M {
        self.system
    }

    /// Cycles, rows and steps.
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

    /// Cycles done.
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// Counts so far.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Steps in a cycle with rows, on average; `None` before the first.
    pub fn steps_per_cycle(&self) -> Option<f64> {
        let Stage { recorded, steps_before, .. } = self.stage;
        (recorded > 0).then(|| self.counts.steps.saturating_sub(steps_before) as f64 / recorded as f64)
    }

    /// Stage of the motion: how far it has come.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// Whether there is a further cycle: a run-down may end before it.
    pub fn goes_on(&self) -> bool {
        self.timetable.cycle(&self.system, self.cycle, self.state.time).is_some()
    }

    /// What comes next: so many cycles from where the motion stands; `None` where it ends before.
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

    /// Goes on from another state at the same time, its own accelerations included; energy and counts begin anew.
    ///
    /// # Errors
    /// [`MotionError`] where it has no energy.
    pub fn replace(&mut self, state: State) -> Result<(), MotionError<M::Error>> {
        let time = state.time;
        let potential = self.system.potential(time, &state.q);
        let potential = potential.map_err(|source| MotionError::Mechanism { time, source })?;
        self.ledger = Some(Ledger::open(self.system.mass(), &state.v, potential));
        (self.state, self.counts, self.integrator) = (state, Counts::default(), None);
        Ok(())
    }
}
