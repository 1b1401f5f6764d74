//! Cells of a lattice over the poses: what was found in the middle of one serves the whole of it, and whoever comes
//! again finds it there.
//!
//! The middle depends on the cell alone and not on who came first. So what is kept is memory of a pure function: with
//! it or without, results are the same to the last bit.

use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::{ModalFlanks, Pose};

/// Displacement of a point of contact, mm, up to which what was found serves: the gap's second order, curvature times
/// its square over two, is a ten-thousandth of a um then.
pub(super) const LINEAR_RANGE: f64 = 1e-3;
/// Side of a cell as the flanks move over it, mm. Compliance differs by some 1e-9 of itself over it, gaps by less: what
/// a tooth change does to the sum of forces, whose frames have cells of their own, is below 1e-9 of it.
const BIN_SIZE: f64 = 1e-8;

/// Number of a cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PoseBin {
    /// Translation and quaternion of both gears.
    poses: [[i64; 7]; 2],
    /// Opening of gaps by modes that is reckoned with: a power of two times [`LINEAR_RANGE`].
    reach: i32,
    /// Amplitudes of the modes.
    amplitudes: Vec<i64>,
}

impl PoseBin {
    /// The cell that some poses are in; `radius` (mm) is that of the larger gear's tip.
    pub fn of(poses: &[Pose; 2], radius: f64, modal: Option<&ModalFlanks>) -> Self {
        let round = |x: f64| x.round() as i64;
        let poses = poses.each_ref().map(|pose| {
            let (t, r) = (pose.translation.vector / BIN_SIZE, pose.rotation.into_inner().coords * (radius / BIN_SIZE));
            [t.x, t.y, t.z, r.x, r.y, r.z, r.w].map(round)
        });
        let Some(modal) = modal else { return Self { poses, reach: 0, amplitudes: Vec::new() } };
        let reach = (modal.largest() / LINEAR_RANGE + 1.0).log2().ceil() as i32;
        let amplitudes =
            modal.amplitudes().iter().zip(modal.sizes()).map(|(a, size)| round(a * size / BIN_SIZE)).collect();
        Self { poses, reach, amplitudes }
    }

    /// Poses in the middle.
    pub fn middle(&self, radius: f64) -> [Pose; 2] {
        self.poses.map(|[x, y, z, i, j, k, w]| {
            let point = Vector3::new(x as f64, y as f64, z as f64) * BIN_SIZE;
            let [w, i, j, k] = [w, i, j, k].map(|c| c as f64 * (BIN_SIZE / radius));
            Pose::from_parts(Translation3::from(point), UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)))
        })
    }

    /// Amplitudes of the modes in the middle.
    pub fn amplitudes(&self, modal: &ModalFlanks) -> Vec<f64> {
        self.amplitudes.iter().zip(modal.sizes()).map(|(&n, size)| n as f64 * BIN_SIZE / size).collect()
    }

    /// Opening of gaps by modes, mm, that is reckoned with.
    pub fn reach(&self) -> f64 {
        LINEAR_RANGE * f64::from(self.reach).exp2()
    }
}
