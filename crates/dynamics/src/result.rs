//! What a quasi-static analysis hands on, position by position.

use geometry::Side;
use serde::Serialize;

use crate::FilletStress;

/// Force and moment of the mesh on one gear, about its own centre (where it then is), global axes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Wrench {
    /// Force, N.
    pub force: [f64; 3],
    /// Moment, N mm; the second entry is the tilting moment.
    pub moment: [f64; 3],
}

/// What part of the flanks presses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Site {
    /// Flank against flank.
    Flank,
    /// A slice that ends at an end face of either gear.
    EndFace,
    /// The pinion's tip edge presses, off the line of action, or cuts the band off.
    PinionTipEdge,
    /// The wheel's tip edge.
    WheelTipEdge,
}

impl Site {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Flank, Self::EndFace, Self::PinionTipEdge, Self::WheelTipEdge];
}

/// One loaded slice of a contact line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SliceResult {
    /// Height on the pinion, mm.
    pub z: f64,
    /// Height on the wheel, mm: another one where the wheel is displaced along its axis.
    pub wheel_z: f64,
    /// Side of the teeth that touches, the same on both gears.
    pub side: Side,
    /// Roll angle of the contact on pinion and wheel, rad.
    pub roll: [f64; 2],
    /// Line load, N per mm of contact line.
    pub line_load: f64,
    /// Half-width of the band, mm.
    pub half_width: f64,
    /// Largest pressure across the band, MPa.
    pub pressure: f64,
    /// How far past a tip edge the smooth flanks would touch, mm of arc: the edge presses, off the line of action; 0 for flank on flank.
    pub off_line: f64,
    /// What part of the flanks presses here.
    pub site: Site,
}

impl SliceResult {
    /// Whether the pressure is larger than another's, by more than round-off: equal slices of a symmetric pair have an order.
    pub fn is_harder(&self, other: &Self) -> bool {
        self.pressure > other.pressure * (1.0 + 1e-9)
    }

    /// The slice with the largest pressure, the first of those that have it but for round-off.
    pub fn hardest<'a>(slices: impl IntoIterator<Item = &'a Self>) -> Option<&'a Self> {
        slices.into_iter().fold(None, |best, s| if best.is_none_or(|b: &Self| s.is_harder(b)) { Some(s) } else { best })
    }
}

/// One tooth pair of the window at one position.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairResult {
    /// Running number of the pair; grows by one from pair to pair in the sense of rotation, never wraps.
    pub pair: i64,
    /// Pinion tooth, 0 .. z1-1.
    pub pinion_tooth: u32,
    /// Wheel tooth, 0 .. z2-1.
    pub wheel_tooth: u32,
    /// Sum of the normal forces, N.
    pub normal_force: f64,
    /// Largest contact pressure, MPa.
    pub max_pressure: f64,
    /// Length of this pair's contact line, mm.
    pub contact_line_length: f64,
    /// Slices or quadrature points that carry load.
    pub points_in_contact: usize,
    /// The loaded slices, ascending in z; none where points touch.
    pub slices: Vec<SliceResult>,
}

/// How well a position is solved.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Certificate {
    /// |contact torque - applied torque| / applied torque.
    pub torque_residual: f64,
    /// Largest violation of g >= 0, p >= 0, p g = 0, relative to the largest approach and pressure.
    pub complementarity_residual: f64,
    /// Largest component of (force on pinion + force on wheel) / largest force.
    pub action_reaction_residual: f64,
    /// Newton (active-set) iterations.
    pub iterations: usize,
    /// Largest error of the interpolated bulk compliance between two slices, relative to the largest self-compliance; 0 where it is exact.
    pub bulk_compliance_error: f64,
    /// Force on the teeth at the window's ends relative to the total: how close the window is to being too small.
    pub window_edge_load: f64,
}

/// Everything known of one solved position.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StaticPosition {
    /// Pinion angle, rad, in the sense of rotation, from the middle position of pair 0.
    pub pinion_angle: f64,
    /// Mesh phase, 0 .. 1.
    pub mesh_phase: f64,
    /// Transmission error, mm on the transverse line of action; positive when the driven gear lags.
    pub transmission_error: f64,
    /// Transmission error without load, mm: that of the micro-geometry and the misalignment alone. It counts, as the transmission
    /// error does, from where the unmodified flanks would touch with the axes parallel through the gears' centres.
    pub kinematic_transmission_error: f64,
    /// F_bt / (te - kinematic te), N/mm; NaN without load.
    pub secant_stiffness: f64,
    /// d F_bt / d te, N/mm.
    pub tangent_stiffness: f64,
    /// Sum over the pairs, mm.
    pub contact_line_length: f64,
    /// Analytic length of the unloaded pair's contact lines, mm.
    pub geometric_line_length: f64,
    /// Pairs of the window, ascending.
    pub pairs: Vec<PairResult>,
    /// Mesh force on pinion and wheel.
    pub wrench: [Wrench; 2],
    /// Largest contact pressure, MPa.
    pub max_pressure: f64,
    /// Stress in the root fillets of the window's teeth on pinion and wheel, tooth by tooth counter-clockwise; empty when not
    /// asked for.
    pub root_stress: [Vec<FilletStress>; 2],
    /// Work of friction per radian of pinion rotation, N mm, >= 0; times the pinion's speed it is the power loss.
    pub friction_work: f64,
    /// Elastic energy of both gears and the contact, N mm.
    pub strain_energy: f64,
    /// Tooth changes since the start of the run.
    pub tooth_changes: u64,
    /// How well it is solved.
    pub certificate: Certificate,
}

/// A whole quasi-static run.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct StaticHistory {
    /// Positions in the order of the rotation.
    pub positions: Vec<StaticPosition>,
    /// What the user should know: neglected, doubtful, adjusted.
    pub warnings: Vec<String>,
}
