//! How far a motion has come, and what is compared from cycle to cycle.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::{Envelope, Mechanism, Periodicity, Recurrence, SignalRecurrence, State};

/// Stage of a motion: before its rows, or among them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// Whether rows are written: the motion has settled, or need not.
    pub recording: bool,
    /// Cycles with rows.
    pub recorded: u64,
    /// Rows.
    pub rows: u64,
    /// Steps that were taken before the first of these cycles, of those that are counted.
    pub(super) steps_before: u64,
    /// How nearly the last period repeated an earlier one; its period is counted in cycles.
    pub periodicity: Option<Periodicity>,
    /// States at the beginnings of the last periods, where states are compared.
    pub(super) states: Option<Recurrence>,
    /// Rows of the last periods, where a signal is compared, and of the present one so far.
    pub(super) signal: SignalRecurrence,
    pub(super) rows_of_period: Vec<f64>,
    /// Least and largest coordinates of the present period.
    pub(super) envelope: Option<Envelope>,
    /// Cycles after which a nearer state is sought next.
    pub(super) next_shot: u64,
}

impl Stage {
    /// Whether all states in it have `n` coordinates.
    pub(super) fn is_of(&self, n: usize) -> bool {
        self.states.as_ref().is_none_or(|all| all.is_of(n)) && self.envelope.as_ref().is_none_or(|e| e.is_of(n))
    }
}

/// Comparison that decides whether a motion repeats itself.
pub enum Compared<M: Mechanism> {
    /// States at the ends of periods.
    States {
        /// Sizes of the coordinates; infinite of those that are not compared.
        scale: DVector<f64>,
        /// A coordinate that need not return: of it, only the velocity is compared.
        free: Option<usize>,
        /// Cycles of a period, >= 1: as many as it takes until all that excites the mechanism comes back.
        period: u64,
    },
    /// One number of each row of a period.
    Signal {
        /// The number.
        of: fn(&mut M, &State) -> Result<f64, M::Error>,
        /// Cycles of a period, as of states.
        period: u64,
    },
}

impl<M: Mechanism> std::fmt::Debug for Compared<M> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::States { period, .. } => f.debug_struct("States").field("period", period).finish_non_exhaustive(),
            Self::Signal { period, .. } => f.debug_struct("Signal").field("period", period).finish_non_exhaustive(),
        }
    }
}

impl<M: Mechanism> Compared<M> {
    /// Cycles of a period.
    pub(super) fn period(&self) -> u64 {
        let (Self::States { period, .. } | Self::Signal { period, .. }) = self;
        (*period).max(1)
    }
}

/// What is asked of a motion before its rows begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settle {
    /// Difference after a period over the peak to peak that counts as none.
    pub tolerance: f64,
    /// Cycles at the most.
    pub most: u64,
}

impl Stage {
    /// Takes in a cycle of which states are compared; whether a period is complete.
    pub(super) fn judge_states(
        &mut self,
        (state, envelope): (&State, Envelope),
        (scale, free): (&DVector<f64>, Option<usize>),
        (period, is_period, tolerance): (u64, bool, f64),
    ) {
        let whole = match self.envelope.take() {
            Some(before) => before.joined(&envelope),
            None => envelope,
        };
        if !is_period {
            self.envelope = Some(whole);
            return;
        }
        if let Some(states) = &mut self.states {
            let found = states.judge(state, &whole, scale, free, tolerance);
            self.periodicity = Some(Periodicity { period: found.period * period as usize, ..found });
        }
    }

    /// The same of a cycle of which a signal is compared.
    pub(super) fn judge_signal(&mut self, rows: Vec<f64>, (period, is_period, tolerance): (u64, bool, f64)) {
        self.rows_of_period.extend(rows);
        if is_period {
            let found = self.signal.judge(std::mem::take(&mut self.rows_of_period), tolerance);
            self.periodicity = Some(Periodicity { period: found.period * period as usize, ..found });
        }
    }
}
