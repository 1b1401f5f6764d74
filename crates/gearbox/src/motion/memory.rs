//! What a gearbox in motion is beside coordinates and velocities.

use integrate::Resumable;

use super::GearboxMechanism;
use crate::GearboxError;

impl Resumable for GearboxMechanism {
    /// How much of what each mesh holds the motion has used at most.
    type Memory = Vec<f64>;

    fn memory(&self) -> Vec<f64> {
        self.reach.clone()
    }

    fn restore(&mut self, reach: &Vec<f64>) -> Result<(), GearboxError> {
        if reach.len() != self.live.len() {
            return Err(GearboxError::OtherMeshes { checkpoint: reach.len(), motion: self.live.len() });
        }
        self.reach.clone_from(reach);
        Ok(())
    }
}
