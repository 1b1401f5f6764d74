//! Forces of the mesh orders at one speed, and the excitation lines of a Campbell diagram. Theory (90).

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::{Harmonic, Vibration, rms};

/// An excitation at a multiple of the input's speed.
#[derive(Debug, Clone, PartialEq)]
pub struct ExcitationLine {
    /// Name, as used in column names.
    pub name: String,
    /// Order: excitation frequency divided by the rotation frequency of the input.
    pub order: f64,
}

/// Forces caused by one order of one mesh at one speed; peaks of Re(x exp(i w t)), with t = 0 when the input is at its
/// start.
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

/// Root mean squares over all orders of all meshes together.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedRms {
    /// Root mean square of the dynamic normal force of every mesh, N.
    pub mesh_forces: Vec<f64>,
    /// Root mean square of the force of every bearing, x, y, z together, N.
    pub bearing_forces: Vec<f64>,
}

impl OrderForces {
    /// Forces of a harmonic, without the displacements.
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
    /// Root mean squares over all orders at one speed.
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
    /// Mesh orders and shaft orders as excitation lines; `ratios` are the shaft speeds divided by that of the input.
    /// Stationary shafts excite nothing.
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
