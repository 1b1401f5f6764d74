//! State of a gearbox in motion beside coordinates and velocities.

use dynamics::FlankStates;
use integrate::Resumable;
use serde::{Deserialize, Serialize};

use super::GearboxMechanism;
use crate::{GearboxError, static_gearbox::at_mesh};

/// What a mesh in motion is beside its displacements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshMemory {
    /// How much of what it holds the motion has used at most ([`super::MovingMesh::reach`]).
    pub reach: f64,
    /// Windows of teeth and tooth changes, of a mesh that has some.
    pub windows: Option<FlankStates>,
}

impl Resumable for GearboxMechanism {
    type Memory = Vec<MeshMemory>;

    fn memory(&self) -> Vec<MeshMemory> {
        let all = self.live.iter().zip(&self.reach);
        all.map(|(live, &reach)| MeshMemory { reach, windows: live.windows() }).collect()
    }

    fn restore(&mut self, memory: &Vec<MeshMemory>) -> Result<(), GearboxError> {
        if memory.len() != self.live.len() {
            return Err(GearboxError::OtherMeshes { checkpoint: memory.len(), motion: self.live.len() });
        }
        for (i, MeshMemory { reach, windows }) in memory.iter().enumerate() {
            self.reach[i] = *reach;
            if let Some(windows) = windows {
                self.live[i].restore(windows).map_err(|source| at_mesh(&self.meshes[i], source))?;
            }
        }
        Ok(())
    }
}
