//! Bins of poses: a lattice over the poses of both gears. Contact is set up and solved at the centre of a bin, and that
//! solution serves every pose in the bin.
//!
//! The centre depends on the bin alone, not on the pose that came first. A cached solution is therefore the value of a
//! pure function: with the cache or without it, results are the same to the last bit.

use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::{ModalFlanks, Pose};

/// Largest displacement of a contact point, mm, for which the linearisation at the centre of a bin serves. The
/// second-order part of the gap, curvature times displacement squared over two, is then a ten-thousandth of a um.
pub(super) const LINEAR_RANGE: f64 = 1e-3;
/// Edge of a bin, as motion of the flanks, mm. Within a bin compliance changes by some 1e-9 of itself, and gaps by
/// less. A tooth change moves the frames and with them the bins; the sum of forces changes by less than 1e-9 of itself.
const BIN_SIZE: f64 = 1e-8;

/// Index of a bin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PoseBin {
    /// Translation and quaternion of both gears.
    poses: [[i64; 7]; 2],
    /// Largest gap opening by modes that the bin allows for: a power of two times [`LINEAR_RANGE`].
    reach: i32,
    /// Amplitudes of the modes.
    amplitudes: Vec<i64>,
}

impl PoseBin {
    /// The bin of some poses; `radius` (mm) is the tip radius of the larger gear.
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

    /// Poses at the centre.
    pub fn middle(&self, radius: f64) -> [Pose; 2] {
        self.poses.map(|[x, y, z, i, j, k, w]| {
            let point = Vector3::new(x as f64, y as f64, z as f64) * BIN_SIZE;
            let [w, i, j, k] = [w, i, j, k].map(|c| c as f64 * (BIN_SIZE / radius));
            Pose::from_parts(Translation3::from(point), UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)))
        })
    }

    /// Amplitudes of the modes at the centre.
    pub fn amplitudes(&self, modal: &ModalFlanks) -> Vec<f64> {
        self.amplitudes.iter().zip(modal.sizes()).map(|(&n, size)| n as f64 * BIN_SIZE / size).collect()
    }

    /// Largest gap opening by modes, mm, that the bin allows for.
    pub fn reach(&self) -> f64 {
        LINEAR_RANGE * f64::from(self.reach).exp2()
    }
}
