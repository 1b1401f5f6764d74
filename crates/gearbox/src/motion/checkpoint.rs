//! What a motion goes on from.

use integrate::{Ledger, State};
use serde::{Deserialize, Serialize};

use super::GearboxMechanism;
use crate::GearboxError;

/// All that a motion is at a row, but for its rows so far: it goes on from here to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GearboxCheckpoint {
    /// Rows so far, the start among them.
    pub rows: u64,
    /// Cycles of the fastest mesh that are done.
    pub cycles: u64,
    /// Coordinates and what the integrator carries along.
    pub state: State,
    /// Energy of the deviations.
    pub ledger: Ledger,
    /// Steps taken, and those that were taken in parts.
    pub steps: [u64; 2],
    /// How often flanks of each mesh came apart: on the side that drives, and on the other one.
    pub separations: Vec<[u64; 2]>,
    /// How much of what each mesh holds the motion has used at most.
    pub reach: Vec<f64>,
}

impl GearboxCheckpoint {
    /// Whether its parts go together.
    pub fn is_consistent(&self) -> bool {
        let State { q, v, a, averaged, .. } = &self.state;
        [v, a, averaged].iter().all(|part| part.len() == q.len()) && self.separations.len() == self.reach.len()
    }
}

impl GearboxMechanism {
    /// Takes up what a checkpoint knows of the meshes.
    ///
    /// # Errors
    /// [`GearboxError::OtherCoordinates`] for a checkpoint of another gearbox.
    pub(super) fn restore(&mut self, from: &GearboxCheckpoint) -> Result<(), GearboxError> {
        let [checkpoint, motion] = [[from.state.q.len(), from.reach.len()], [self.count(), self.live.len()]];
        if checkpoint != motion || !from.is_consistent() {
            return Err(GearboxError::OtherCoordinates { checkpoint: checkpoint[0], motion: motion[0] });
        }
        self.reach.clone_from(&from.reach);
        self.forget();
        Ok(())
    }

    /// Has every mesh forget what it remembers of earlier places: what comes then depends on the state alone.
    pub(super) fn forget(&mut self) {
        self.live.iter_mut().for_each(super::live_mesh::LiveMesh::forget);
    }
}
