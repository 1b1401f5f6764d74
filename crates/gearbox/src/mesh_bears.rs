//! Mean moments of the meshes of a gearbox, and the meshes that carry only round-off.

use crate::GearboxPosition;

/// Share of the largest moment on a gear of the gearbox below which a mesh bears nothing.
const NOTHING: f64 = 1e-6;

/// Mean moments of the meshes over several positions.
#[derive(Debug)]
pub struct MeshBears {
    /// About the axes of both gears of each mesh, N mm.
    moments: Vec<[f64; 2]>,
    least: f64,
}

impl MeshBears {
    /// Mean moments of all meshes.
    pub fn of(positions: &[GearboxPosition]) -> Self {
        let meshes = positions.first().map_or(0, |first| first.meshes.len());
        let mean = |i: usize, gear: usize| {
            positions.iter().map(|p| p.meshes[i].moment[gear][2]).sum::<f64>() / positions.len() as f64
        };
        let moments: Vec<[f64; 2]> = (0..meshes).map(|i| [0, 1].map(|gear| mean(i, gear))).collect();
        let largest = moments.iter().flatten().map(|moment| moment.abs()).fold(0.0, f64::max);
        Self { moments, least: NOTHING * largest }
    }

    /// Mean moment of a mesh about the axis of its gear 0 or 1, N mm about +z; 0 if it is only round-off.
    pub fn mean(&self, mesh: usize, gear: usize) -> f64 {
        let moment = self.moments[mesh][gear];
        if moment.abs() > self.least { moment } else { 0.0 }
    }
}
