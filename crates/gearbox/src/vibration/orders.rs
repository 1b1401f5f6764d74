//! What orders of meshes do at one speed, and the lines of excitation in a Campbell diagram. Theory (90).

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::{Harmonic, Vibration, rms};

/// What excites: a multiple of the input's speed.
#[derive(Debug, Clone, PartialEq)]
pub struct ExcitationLine {
    /// Name, as columns have it.
    pub name: String,
    /// Order, turns of the input.
    pub order: f64,
}

/// What one order of one mesh does at one speed; peaks of Re(x exp(i w t)), t = 0 where the input is at its start.
#[derive(Debug, Clone, PartialEq)]
pub struct OrderForces {
    /// Mesh that excites.
    pub mesh: usize,
    /// Order of its frequency.
    pub order: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Dynamic normal force of every mesh, N.
    pub mesh_forces: Vec<Complex<f64>>,
    /// Force and moment of every bearing on the housing: N, N mm.
    pub bearing_forces: Vec<[Complex<f64>; 6]>,
}

/// Root mean squares of all orders of all meshes together.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedRms {
    /// Of the dynamic normal force of every mesh, N.
    pub mesh_forces: Vec<f64>,
    /// Of the force of every bearing, x, y, z together, N.
    pub bearing_forces: Vec<f64>,
}

impl OrderForces {
    /// Of a harmonic, without the displacements.
    pub fn of(harmonic: &Harmonic) -> Self {
        let six = |i: usize| std::array::from_fn(|k| harmonic.bearing_forces[6 * i + k]);
        Self {
            mesh: harmonic.mesh,
            order: harmonic.order,
            frequency_hz: harmonic.frequency / TAU,
            mesh_forces: harmonic.mesh_forces.clone(),
            bearing_forces: (0..harmonic.bearing_forces.len() / 6).map(six).collect(),
        }
    }
}

impl SpeedRms {
    /// Of all orders at one speed.
    pub fn of(orders: &[OrderForces]) -> Self {
        let (meshes, bearings) = orders.first().map_or((0, 0), |o| (o.mesh_forces.len(), o.bearing_forces.len()));
        let mesh = |i: usize| rms(orders.iter().map(|o| (o.frequency_hz, o.mesh_forces[i])));
        let axis = |i: usize, k: usize| rms(orders.iter().map(|o| (o.frequency_hz, o.bearing_forces[i][k])));
        Self {
            mesh_forces: (0..meshes).map(mesh).collect(),
            bearing_forces: (0..bearings).map(|i| axis(i, 0).hypot(axis(i, 1)).hypot(axis(i, 2))).collect(),
        }
    }
}

impl Vibration {
    /// Mesh orders and turns of shafts, of these spins over that of the input, as lines of excitation; what stands excites
    /// nothing.
    pub fn lines(&self, ratios: &[f64], orders: u32) -> Vec<ExcitationLine> {
        let meshes = self.mesh_orders().into_iter().enumerate().flat_map(move |(i, order)| {
            (1..=orders)
                .map(move |k| ExcitationLine { name: format!("mesh_{}_order_{k}", i + 1), order: f64::from(k) * order })
        });
        let shafts = ratios.iter().enumerate();
        let shafts = shafts.filter(|(_, ratio)| **ratio != 0.0);
        let shafts = shafts.map(|(i, ratio)| ExcitationLine { name: format!("shaft_{}", i + 1), order: ratio.abs() });
        meshes.chain(shafts).collect()
    }
}
