//! State of a moving gearbox in addition to coordinates and velocities.

use dynamics::{Extremes, FlankStates};
use integrate::Resumable;
use serde::{Deserialize, Serialize};

use super::{GearboxMechanism, TorqueMemory, live_mesh::LiveMesh};
use crate::{GearboxError, train::at_mesh};

/// State of a moving mesh in addition to its displacements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshMemory {
    /// Largest used share of its valid range ([`super::MovingMesh::reach`]).
    pub reach: f64,
    /// Extremes of its flanks.
    pub extremes: Extremes,
    /// Windows of teeth and tooth changes, for a mesh with windows.
    pub windows: Option<FlankStates>,
}

/// State of a moving gearbox in addition to its coordinates and velocities.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GearboxMemory {
    /// Meshes in their order.
    pub meshes: Vec<MeshMemory>,
    /// State of the torques that change with time.
    pub torques: TorqueMemory,
    /// Work transmitted in the nominal motion, N mm ([`GearboxMechanism::throughput`]).
    pub throughput: f64,
}

impl GearboxMemory {
    /// Largest magnitude of the running numbers of a mesh's window.
    pub fn farthest_tooth(&self) -> u64 {
        let of_meshes = self.meshes.iter().filter_map(|own| own.windows.as_ref());
        of_meshes.map(FlankStates::farthest_tooth).fold(0, u64::max)
    }
}

impl Resumable for GearboxMechanism {
    type Memory = GearboxMemory;

    fn memory(&self) -> GearboxMemory {
        let all = self.live.iter().zip(self.reach.iter().zip(&self.extremes));
        let of = |(live, (&reach, &extremes)): (&LiveMesh, (&f64, &Extremes))| MeshMemory {
            reach,
            extremes,
            windows: live.windows(),
        };
        GearboxMemory { meshes: all.map(of).collect(), torques: self.varying.memory(), throughput: self.throughput }
    }

    fn restore(&mut self, memory: &GearboxMemory) -> Result<(), GearboxError> {
        let (found, wanted) = (memory.meshes.len(), self.live.len());
        if found != wanted {
            return Err(GearboxError::OtherMeshes { checkpoint: found, motion: wanted });
        }
        self.varying.restore(&memory.torques);
        self.throughput = memory.throughput;
        for (i, MeshMemory { reach, extremes, windows }) in memory.meshes.iter().enumerate() {
            (self.reach[i], self.extremes[i]) = (*reach, *extremes);
            if let Some(windows) = windows {
                self.live[i].restore(windows).map_err(|source| at_mesh(&self.meshes[i], source))?;
            }
        }
        Ok(())
    }
}
