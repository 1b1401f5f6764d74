//! Bins of poses: a lattice over the poses of both gears. Contact is set up and solved at the centre of a bin; this
//! solution serves every pose in the bin.
//!
//! The centre depends only on the bin, not on the pose that came first. A cached solution is therefore the value of a
//! pure function: results have the same bits with the cache and without it.

use geometry::GearPair;
use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::{ModalFlanks, Pose};

/// Sizes of a pair's bins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BinSizes {
    /// Tip radius of the larger gear, mm.
    pub radius: f64,
    /// Largest displacement of a contact point, mm, for which the linearisation at the centre of a bin serves: 1 um at
    /// a module of 3 mm. The second-order part of the gap, curvature times displacement squared over two, is then a
    /// ten-thousandth of a um.
    pub linear_range: f64,
    /// Edge of a bin, as motion of the flanks, mm. Within a bin compliance changes by some 1e-9 of itself, and gaps by
    /// less. A tooth change moves the frames and with them the bins; the sum of forces changes by less than 1e-9 of
    /// itself.
    edge: f64,
}

impl BinSizes {
    /// Bin sizes of a pair; lengths are fractions of its normal module.
    pub fn of(pair: &GearPair) -> Self {
        let module = pair.pinion.data().normal_module;
        let radius = pair.pinion.tip_radius().max(pair.wheel.tip_radius());
        Self { radius, linear_range: module / 3e3, edge: module / 3e8 }
    }
}

/// Index of a bin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PoseBin {
    /// Translation and quaternion of both gears.
    poses: [[i64; 7]; 2],
    /// Largest gap opening by modes that the bin allows for: a power of two times [`BinSizes::linear_range`].
    reach: i32,
    /// Amplitudes of the modes.
    amplitudes: Vec<i64>,
}

impl PoseBin {
    /// The bin of the given poses.
    pub fn of(poses: &[Pose; 2], sizes: &BinSizes, modal: Option<&ModalFlanks>) -> Self {
        let BinSizes { radius, linear_range, edge } = *sizes;
        let round = |x: f64| x.round() as i64;
        let poses = poses.each_ref().map(|pose| {
            let (t, r) = (pose.translation.vector / edge, pose.rotation.into_inner().coords * (radius / edge));
            [t.x, t.y, t.z, r.x, r.y, r.z, r.w].map(round)
        });
        let Some(modal) = modal else { return Self { poses, reach: 0, amplitudes: Vec::new() } };
        let reach = (modal.largest() / linear_range + 1.0).log2().ceil() as i32;
        let amplitudes = modal.amplitudes().iter().zip(modal.sizes()).map(|(a, size)| round(a * size / edge)).collect();
        Self { poses, reach, amplitudes }
    }

    /// Poses at the centre.
    pub fn middle(&self, sizes: &BinSizes) -> [Pose; 2] {
        let BinSizes { radius, edge, .. } = *sizes;
        self.poses.map(|[x, y, z, i, j, k, w]| {
            let point = Vector3::new(x as f64, y as f64, z as f64) * edge;
            let [w, i, j, k] = [w, i, j, k].map(|c| c as f64 * (edge / radius));
            Pose::from_parts(Translation3::from(point), UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)))
        })
    }

    /// Amplitudes of the modes at the centre.
    pub fn amplitudes(&self, sizes: &BinSizes, modal: &ModalFlanks) -> Vec<f64> {
        self.amplitudes.iter().zip(modal.sizes()).map(|(&n, size)| n as f64 * sizes.edge / size).collect()
    }

    /// Largest gap opening by modes that the bin permits, mm.
    pub fn reach(&self, sizes: &BinSizes) -> f64 {
        sizes.linear_range * f64::from(self.reach).exp2()
    }
}
