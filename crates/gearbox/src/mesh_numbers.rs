//! Characteristic values of meshes and bearings over several positions.

use crate::{GearboxPosition, face_load_factor};

/// Values of a mesh over several positions by which a gearbox is assessed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshNumbers {
    /// Mean and peak to peak of the transmission error, mm.
    pub transmission_error: [f64; 2],
    /// Mean misalignment in the plane of action and perpendicular to it, mm over the face width.
    pub misalignment: [f64; 2],
    /// K_Hbeta from the solved load distribution.
    pub face_load_factor: Option<f64>,
    /// Largest pressure, MPa.
    pub max_pressure: f64,
}

impl MeshNumbers {
    /// Values of a mesh with `slices` slices.
    pub fn of(positions: &[GearboxPosition], mesh: usize, slices: usize) -> Self {
        let own = || positions.iter().map(move |p| &p.meshes[mesh]);
        let te = || own().map(|m| m.transmission_error);
        Self {
            transmission_error: [mean(te()), peak_to_peak(te())],
            misalignment: [mean(own().map(|m| m.misalignment_in_plane)), mean(own().map(|m| m.misalignment_across))],
            face_load_factor: face_load_factor(positions, mesh, slices),
            max_pressure: own().flat_map(|m| &m.slices).map(|s| s.pressure).fold(0.0, f64::max),
        }
    }
}

/// Mean force of a bearing on its shaft, N.
pub fn mean_force(positions: &[GearboxPosition], bearing: usize) -> [f64; 3] {
    std::array::from_fn(|k| mean(positions.iter().map(|p| p.bearings[bearing].force[k])))
}

/// The mean; 0 for an empty list.
pub fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0f64);
    for value in values {
        sum += value;
        count += 1.0;
    }
    sum / count.max(1.0)
}

/// Largest minus smallest value; 0 for an empty list.
pub fn peak_to_peak(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    if low <= high { high - low } else { 0.0 }
}
