//! Stage of a motion, and the quantities that are compared from cycle to cycle.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::{Envelope, Mechanism, Periodicity, Recurrence, SignalRecurrence, State};

/// Stage of a motion: before its rows, or while rows are written.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// Whether rows are written, because the motion has settled or need not settle.
    pub recording: bool,
    /// Number of cycles with rows.
    pub recorded: u64,
    /// Number of rows.
    pub rows: u64,
    /// Steps that were taken before the first of these cycles, of those that are counted.
    pub(super) steps_before: u64,
    /// How accurately the last period repeated an earlier one; its period is counted in cycles.
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

/// Comparison that decides whether a motion repeats.
pub enum Compared<M: Mechanism> {
    /// Compares states at the ends of periods.
    States {
        /// Magnitudes of the coordinates; infinite for coordinates that are not compared.
        scale: DVector<f64>,
        /// A coordinate that need not return; only its velocity is compared.
        free: Option<usize>,
        /// Number of cycles in a period, >= 1, after which all excitations repeat.
        period: u64,
    },
    /// Compares one number per row of a period.
    Signal {
        /// Function that gives the number.
        of: fn(&mut M, &State) -> Result<f64, M::Error>,
        /// Number of cycles in a period, as for states.
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

/// Requirement on a motion before its rows begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settle {
    /// Difference over a period, relative to the peak to peak, that counts as periodic.
    pub tolerance: f64,
    /// Largest number of cycles.
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
