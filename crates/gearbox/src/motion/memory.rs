//! State of a gearbox in motion beside coordinates and velocities.

use dynamics::FlankStates;
use integrate::Resumable;
use serde::{Deserialize, Serialize};

use super::{GearboxMechanism, TorqueMemory};
use crate::{GearboxError, static_gearbox::at_mesh};

/// What a mesh in motion is beside its displacements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshMemory {
    /// How much of what it holds the motion has used at most ([`super::MovingMesh::reach`]).
    pub reach: f64,
    /// Windows of teeth and tooth changes, of a mesh that has some.
    pub windows: Option<FlankStates>,
}

/// What a gearbox in motion is beside its coordinates and velocities.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GearboxMemory {
    /// Meshes in their order.
    pub meshes: Vec<MeshMemory>,
    /// Torques that change with time.
    pub torques: TorqueMemory,
}

impl Resumable for GearboxMechanism {
    type Memory = GearboxMemory;

    fn memory(&self) -> GearboxMemory {
        let all = self.live.iter().zip(&self.reach);
        let meshes = all.map(|(live, &reach)| MeshMemory { reach, windows: live.windows() }).collect();
        GearboxMemory { meshes, torques: self.varying.memory() }
    }

    fn restore(&mut self, memory: &GearboxMemory) -> Result<(), GearboxError> {
        let (found, wanted) = (memory.meshes.len(), self.live.len());
        if found != wanted {
            return Err(GearboxError::OtherMeshes { checkpoint: found, motion: wanted });
        }
        self.varying.restore(&memory.torques);
        for (i, MeshMemory { reach, windows }) in memory.meshes.iter().enumerate() {
            self.reach[i] = *reach;
            if let Some(windows) = windows {
                self.live[i].restore(windows).map_err(|source| at_mesh(&self.meshes[i], source))?;
            }
        }
        Ok(())
    }
}
