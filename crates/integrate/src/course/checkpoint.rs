//! A motion as plain numbers: stored, and gone on from to the same bits.

use serde::{Deserialize, Serialize, de::DeserializeOwned};

use super::{Counts, Course, Stage, Timetable};
use crate::{Ledger, Mechanism, MotionError, State};

/// A mechanism whose motion can be stored.
pub trait Resumable: Mechanism {
    /// State beside coordinates and velocities, as numbers: teeth in a window, extremes so far.
    type Memory: Clone + std::fmt::Debug + PartialEq + Serialize + DeserializeOwned;

    /// Present state beside coordinates and velocities.
    fn memory(&self) -> Self::Memory;

    /// Restores a stored state; nothing of other places is remembered.
    ///
    /// # Errors
    /// The mechanism's own, also for a memory of another one.
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

/// All that a motion is at the end of a cycle: it goes on from here to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint<K> {
    /// Cycles done.
    pub cycle: u64,
    /// Coordinates and what integrator and step control carry along.
    pub state: State,
    /// Energy.
    pub ledger: Ledger,
    /// State of the mechanism beside coordinates and velocities.
    pub memory: K,
    /// Counts so far.
    pub counts: Counts,
    /// Stage of the motion: how far it has come.
    pub stage: Stage,
}

impl<K> Checkpoint<K> {
    /// Whether its vectors are of one length.
    pub fn is_consistent(&self) -> bool {
        let State { q, v, a, averaged, .. } = &self.state;
        [v, a, averaged].iter().all(|part| part.len() == q.len()) && self.stage.is_of(q.len())
    }
}

impl<M: Resumable, T: Timetable<M>> Course<M, T> {
    /// To go on from later; `None` before the first cycle.
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

    /// Course that goes on from a checkpoint.
    ///
    /// # Errors
    /// [`MotionError::OtherCoordinates`] for a checkpoint of another mechanism, [`MotionError::Mechanism`] where its
    /// memory cannot be taken up.
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
