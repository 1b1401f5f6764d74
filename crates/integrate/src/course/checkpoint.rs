//! A motion as plain numbers, which can be stored and continued to the same bits.

use serde::{Deserialize, Serialize, de::DeserializeOwned};

use super::{Counts, Course, Stage, Timetable};
use crate::{Ledger, Mechanism, MotionError, State};

/// A mechanism whose motion can be stored.
pub trait Resumable: Mechanism {
    /// State in addition to coordinates and velocities, as numbers: teeth in a window, extremes so far.
    type Memory: Clone + std::fmt::Debug + PartialEq + Serialize + DeserializeOwned;

    /// Current state in addition to coordinates and velocities.
    fn memory(&self) -> Self::Memory;

    /// Restores a stored state and discards the memory of other positions.
    ///
    /// # Errors
    /// The error of the mechanism, also for a memory of another mechanism.
    fn restore(&mut self, memory: &Self::Memory) -> Result<(), Self::Error>;
}

impl<M: Resumable> Resumable for &mut M {
    type Memory = M::Memory;

    fn memory(&self) -> M::Memory {
        (**self).memory()
    }

    fn restore(&mut self, memory: &M::Memory) -> Result<(), M::Error> {
        (**self).restore(memory)
    }
}

/// Complete state of a motion at the end of a cycle, from which it continues to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint<K> {
    /// Number of completed cycles.
    pub cycle: u64,
    /// Coordinates, and the internal state of integrator and step control.
    pub state: State,
    /// Energy ledger.
    pub ledger: Ledger,
    /// State of the mechanism in addition to coordinates and velocities.
    pub memory: K,
    /// Counts so far.
    pub counts: Counts,
    /// Stage of the motion.
    pub stage: Stage,
}

impl<K> Checkpoint<K> {
    /// Whether its vectors have the same length.
    pub fn is_consistent(&self) -> bool {
        let State { q, v, a, averaged, .. } = &self.state;
        [v, a, averaged].iter().all(|part| part.len() == q.len()) && self.stage.is_of(q.len())
    }
}

impl<M: Resumable, T: Timetable<M>> Course<M, T> {
    /// Checkpoint from which the motion can be continued later; `None` before the first cycle.
    pub fn checkpoint(&self) -> Option<Checkpoint<M::Memory>> {
        Some(Checkpoint {
            cycle: self.cycle,
            state: self.state.clone(),
            ledger: self.ledger?,
            memory: self.system.memory(),
            counts: self.counts.clone(),
            stage: self.stage.clone(),
        })
    }

    /// Continues a motion from a checkpoint.
    ///
    /// # Errors
    /// [`MotionError::OtherCoordinates`] for a checkpoint of another mechanism, [`MotionError::Mechanism`] if its
    /// memory cannot be restored.
    pub fn resume(mut system: M, timetable: T, from: Checkpoint<M::Memory>) -> Result<Self, MotionError<M::Error>> {
        let (checkpoint, motion) = (from.state.q.len(), system.mass().nrows());
        if checkpoint != motion || !from.is_consistent() {
            return Err(MotionError::OtherCoordinates { checkpoint, motion });
        }
        let Checkpoint { cycle, state, ledger, memory, counts, stage } = from;
        let time = state.time;
        system.restore(&memory).map_err(|source| MotionError::Mechanism { time, source })?;
        system.forget();
        Ok(Self { system, timetable, state, ledger: Some(ledger), cycle, counts, stage, integrator: None })
    }
}
