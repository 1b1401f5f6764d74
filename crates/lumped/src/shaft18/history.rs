//! Shafts in motion at one time.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::ShaftMechanism;

/// One instant of one mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShaftRow {
    /// Time, s.
    pub time: f64,
    /// Phase of the mesh, 0 .. 1.
    pub mesh_phase: f64,
    /// Dynamic transmission error on the transverse line of action, um: from the turns of the gears, positive when the
    /// driven gear lags; 0 where the driving flanks of the error-free, unloaded pair touch, half the backlash off the
    /// middle of the clearance.
    pub transmission_error_um: f64,
    /// Compression of the mesh along the normal, mm: everything that moves the flanks against each other.
    pub compression: f64,
    /// Rate of the compression, mm/s.
    pub compression_rate: f64,
    /// Mesh stiffness along the normal, N/mm.
    pub stiffness: f64,
    /// Normal force, N; below zero on the coast flanks, or where oil in the clearance holds the flanks together.
    pub normal_force: f64,
    /// Forces x, y, z (N) and moments about x, y, z (N mm) of the mesh on gear 1 and gear 2, about their centres.
    pub wrench: [[f64; 6]; 2],
}

impl ShaftMechanism {
    /// Rows of mesh `mesh` at one state.
    pub fn row(&self, mesh: usize, time: f64, q: &DVector<f64>, v: &DVector<f64>) -> Option<ShaftRow> {
        let live = self.meshes.get(mesh)?;
        let state = live.state(time, q, v);
        let normal_force = state.stiffness[0] * state.beyond.value + live.damping * state.compression[1];
        let phase = live.rate * time / std::f64::consts::TAU;
        Some(ShaftRow {
            time,
            mesh_phase: phase - phase.floor(),
            transmission_error_um: 1e3 * (live.turns.dot(q) - live.zone.half_width) / live.line.cos_base_helix,
            compression: state.compression[0],
            compression_rate: state.compression[1],
            stiffness: state.stiffness[0],
            normal_force,
            wrench: live.line.levers.map(|h| std::array::from_fn(|i| -normal_force * h[i])),
        })
    }

    /// What counts as a large motion of each coordinate, for an integrator: a fiftieth of the largest base radius, or the
    /// turn that moves a flank by as much; a millimetre where there is no mesh.
    pub fn scale(&self) -> DVector<f64> {
        let largest = self.meshes.iter().flat_map(|m| m.line.base_radii).reduce(f64::max);
        let [length, radius] = largest.map_or([1.0; 2], |radius| [radius / 50.0, radius]);
        let all = self.coordinates();
        DVector::from_fn(all.len(), |i, _| if all[i].2 < 3 { length } else { length / radius })
    }

    /// Period of mesh `mesh`, s; infinite at rest, `None` where there is no such mesh.
    pub fn mesh_period(&self, mesh: usize) -> Option<f64> {
        self.meshes.get(mesh).map(|m| std::f64::consts::TAU / m.rate)
    }
}
