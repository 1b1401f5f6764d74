//! The static gearbox values for which bounds are given.

use gearbox::mesh_numbers::{MeshNumbers, mean_force};
use std::f64::consts::TAU;

use scene::{Quantity, gearbox::Gearbox};

use crate::gearbox::{GearboxResult, VibrationResult};
use gearbox::{Component, GearboxPosition};

/// Which number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Which {
    pub quantity: Quantity,
    /// Its mesh or bearing, from 0.
    pub place: usize,
}

impl Which {
    /// Name of its mesh or bearing; `None` for a value of the whole gearbox.
    pub fn name(self, file: &Gearbox) -> Option<String> {
        match self.quantity {
            Quantity::NaturalFrequency => None,
            Quantity::BearingForce => Some(file.bearings[self.place].name.clone()),
            _ => Some(file.meshes[self.place].name.clone()),
        }
    }
}

/// All numbers of a run at some positions, those of one gearbox in one order; NaN for what a run does not have.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sample(Vec<(Which, f64)>);

/// A number of every mesh, and how it is read off.
type OfMesh = (Quantity, fn(&MeshNumbers) -> f64);

impl Sample {
    /// Values of every `stride`-th position of a result, starting with position `first`.
    pub fn of(result: &GearboxResult, stride: usize, first: usize) -> Self {
        let positions: Vec<GearboxPosition> = result.positions.iter().skip(first).step_by(stride).cloned().collect();
        let slices = result.meshes.iter().map(|mesh| mesh.slices);
        let meshes: Vec<MeshNumbers> = slices.enumerate().map(|(i, n)| MeshNumbers::of(&positions, i, n)).collect();
        let of_meshes: [OfMesh; 5] = [
            (Quantity::MeanSte, |m| 1e3 * m.transmission_error[0]),
            (Quantity::PeakToPeakSte, |m| 1e3 * m.transmission_error[1]),
            (Quantity::MaxPressure, |m| m.max_pressure),
            (Quantity::MisalignmentInPlane, |m| 1e3 * m.misalignment[0]),
            (Quantity::FaceLoadFactor, |m| m.face_load_factor.unwrap_or(f64::NAN)),
        ];
        let of_mesh = |(quantity, value): OfMesh| {
            meshes.iter().enumerate().map(move |(place, m)| (Which { quantity, place }, value(m)))
        };
        let bearing = |place: usize| {
            let [x, y, z] = mean_force(&positions, place);
            (Which { quantity: Quantity::BearingForce, place }, x.hypot(y).hypot(z))
        };
        let frequency = |swings: &VibrationResult| {
            let hz = lowest(swings).map_or(f64::NAN, |(hz, _)| hz);
            (Which { quantity: Quantity::NaturalFrequency, place: 0 }, hz)
        };
        let all = of_meshes.into_iter().flat_map(of_mesh).chain((0..result.bearings.len()).map(bearing));
        Self(all.chain(result.vibration.as_ref().map(frequency)).collect())
    }

    /// All values in order.
    pub fn all(&self) -> impl Iterator<Item = (Which, f64)> + '_ {
        self.0.iter().copied()
    }

    /// The value; NaN if the run does not contain it.
    pub fn get(&self, which: Which) -> f64 {
        self.0.iter().find(|(own, _)| *own == which).map_or(f64::NAN, |(_, value)| *value)
    }

    /// Takes the values of a quantity from another sample.
    pub fn take(&mut self, quantity: Quantity, other: &Self) {
        let own = self.0.iter_mut().filter(|(which, _)| which.quantity == quantity);
        own.for_each(|(which, value)| *value = other.get(*which));
    }
}

/// The lowest natural frequency above zero at the lowest speed, Hz, and the share of its strain energy in every mesh.
pub(super) fn lowest(swings: &VibrationResult) -> Option<(f64, Vec<f64>)> {
    let mode = swings.modes.first()?.modes.first()?;
    let share = |i: usize| {
        let of = mode.energy.strain.iter().filter(|s| s.component == Component::Mesh(i));
        of.map(|s| s.share).sum()
    };
    Some((mode.frequency / TAU, (0..swings.mesh_stiffness.len()).map(share).collect()))
}
