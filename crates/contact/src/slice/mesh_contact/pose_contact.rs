//! Contact rows at given poses, and their linearisation there.

use super::pose_bin::{BinSizes, PoseBin};
use crate::{
    ModalFlanks, Pose, SavedSolution, Vec3, compliance::ModalRows, local::LocalLaws, nodal::ContactRow,
    opening_by_motion, slice::Slice,
};

/// Rows and their compliance at some poses.
#[derive(Debug, Default)]
pub(super) struct PoseContact {
    /// The poses, once there are rows of them.
    pub at: Option<[Pose; 2]>,
    /// The bin whose centre the poses are; none for poses that were given.
    pub bin: Option<PoseBin>,
    /// Station of each row, counted over all pairs.
    pub keys: Vec<usize>,
    pub rows: Vec<ContactRow>,
    pub slices: Vec<Slice>,
    pub laws: LocalLaws,
    /// Gaps at these poses, mm. The gaps in `rows` follow small motions from there.
    pub gaps: Vec<f64>,
    /// Gap opening of each row per displacement and small turn of both gears.
    pub openings: Vec<[f64; 12]>,
    pub compliance: Vec<f64>,
    /// Openings of the rows by the modes.
    pub modal: ModalRows,
    /// Solution at the centre of the bin.
    pub saved: SavedSolution,
    /// Least gap of the neighbouring pairs outside the window, mm, once it was computed.
    pub neighbour_gap: Option<f64>,
    /// Tangent, once it was computed.
    pub tangent: Option<Box<Tangent>>,
}

/// df/dq of the rigid coordinates; and of rigid coordinates and modes together, row by row, empty without modes.
#[derive(Debug)]
pub(super) struct Tangent {
    pub rigid: [[f64; 12]; 12],
    pub all: Vec<f64>,
}

impl PoseContact {
    pub fn with_capacity(most: usize) -> Self {
        Self {
            keys: Vec::with_capacity(most),
            rows: Vec::with_capacity(most),
            slices: Vec::with_capacity(most),
            laws: LocalLaws::with_capacity(most),
            gaps: Vec::with_capacity(most),
            openings: Vec::with_capacity(most),
            compliance: Vec::with_capacity(most * most),
            ..Self::default()
        }
    }

    /// Displacements (mm) and small rotations (rad) of both gears from here to `poses`. `None` if the motion exceeds
    /// the linear range, or if modes open gaps by more than the bin permits.
    pub fn motion_to(&self, poses: &[Pose; 2], sizes: &BinSizes, modal: Option<&ModalFlanks>) -> Option<[f64; 12]> {
        let at = self.at.as_ref().filter(|_| modal.is_none_or(|modal| modal.largest() <= self.modal.largest))?;
        let mut motion = [0.0; 12];
        for g in 0..2 {
            let moved = poses[g].translation.vector - at[g].translation.vector;
            // Twice the vector part of the quaternion: its error is of third order in the turn.
            let turned = 2.0 * (poses[g].rotation * at[g].rotation.inverse()).into_inner();
            let turned = turned.w.signum() * turned.imag();
            motion[6 * g..6 * g + 3].copy_from_slice(moved.as_slice());
            motion[6 * g + 3..6 * g + 6].copy_from_slice(turned.as_slice());
            let way = moved.norm() + sizes.radius * turned.norm();
            if way > sizes.linear_range || way.is_nan() {
                return None;
            }
        }
        Some(motion)
    }

    /// Takes gaps and, if `wanted`, their derivatives by the motion of both gears from the rows. Called once the rows
    /// are complete.
    pub fn update_openings(&mut self, wanted: bool) {
        let Self { at, rows, gaps, openings, tangent, neighbour_gap, .. } = self;
        let centres = at.map_or([Vec3::zeros(); 2], |at| at.map(|p| p.translation.vector));
        gaps.clear();
        gaps.extend(rows.iter().map(|r| r.gap));
        openings.clear();
        let all = if wanted { &rows[..] } else { &[] };
        openings.extend(all.iter().map(|row| opening_by_motion(row, &row.normal, &centres)));
        (*tangent, *neighbour_gap) = (None, None);
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        let of_row = size_of::<ContactRow>() + size_of::<Slice>() + size_of::<[f64; 12]>();
        self.rows.len() * of_row + self.laws.bytes() + self.compliance.len() * size_of::<f64>() + self.saved.bytes()
    }

    /// Gaps after a small motion from here.
    pub fn follow(&mut self, motion: &[f64; 12]) {
        for ((row, gap), opening) in self.rows.iter_mut().zip(&self.gaps).zip(&self.openings) {
            row.gap = gap + opening.iter().zip(motion).map(|(j, d)| j * d).sum::<f64>();
        }
    }
}
