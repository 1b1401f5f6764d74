//! Results of contact: forces and moments on the gears, and the state of each loaded slice.

use geometry::Side;
use serde::{Deserialize, Serialize};

use crate::{
    Pose, Vec3,
    local::{LocalLaw, LocalState},
    nodal::ContactRow,
    slice::Slice,
};

/// Force and moment of the mesh on one gear, about its own displaced centre, global axes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Wrench {
    /// Force, N.
    pub force: [f64; 3],
    /// Moment, N mm; the second entry is the tilting moment.
    pub moment: [f64; 3],
}

/// Forces of the mesh on both gears at given poses, and their derivatives by the motion of the gears.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshForce {
    /// Force (N) and moment (N mm, about the gear's own centre) on pinion and wheel, common axes.
    pub wrench: [Wrench; 2],
    /// Tangent df/dq. f are forces and moments, q displacements (mm) and small rotations (rad) about the gears'
    /// centres, in common axes. The order is pinion x y z, rotations about x y z, then the same for the wheel. N/mm, N,
    /// N mm.
    ///
    /// ```text
    /// df/dq = -J_t' (S + diag delta')^-1 J      on the active rows
    /// ```
    /// Exact while the contact points stay fixed on the flanks; their motion along the flanks changes the tangent by
    /// about a thousandth of its largest entries. Symmetric and negative semi-definite without friction.
    pub tangent: [[f64; 12]; 12],
    /// Normal force of each pair of the window, N, in ascending running number.
    pub pair_forces: Vec<f64>,
    /// Number of Newton steps.
    pub iterations: usize,
    /// Largest violation of g >= 0, F >= 0, F g = 0 relative to the largest approach.
    pub residual: f64,
}

impl MeshForce {
    /// No contact; one 0 a pair of the window.
    pub(crate) fn none(pair_forces: Vec<f64>) -> Self {
        Self { wrench: Default::default(), tangent: [[0.0; 12]; 12], pair_forces, iterations: 0, residual: 0.0 }
    }
}

/// Part of the flanks that is in contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Site {
    /// Flank against flank.
    Flank,
    /// A slice at an end face of either gear.
    EndFace,
    /// The pinion's tip edge touches off the line of action, or cuts the band off.
    PinionTipEdge,
    /// The wheel's tip edge touches off the line of action, or cuts the band off.
    WheelTipEdge,
}

impl Site {
    /// All parts.
    pub const ALL: [Self; 4] = [Self::Flank, Self::EndFace, Self::PinionTipEdge, Self::WheelTipEdge];
}

/// One loaded slice of a contact line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SliceResult {
    /// Height on the pinion, mm.
    pub z: f64,
    /// Height on the wheel, mm; it differs if the wheel is displaced along its axis.
    pub wheel_z: f64,
    /// Side of the teeth in contact, the same on both gears.
    pub side: Side,
    /// Roll angle of the contact on pinion and wheel, rad.
    pub roll: [f64; 2],
    /// Line load, N per mm of contact line.
    pub line_load: f64,
    /// Half-width of the band, mm.
    pub half_width: f64,
    /// Largest pressure across the band, MPa.
    pub pressure: f64,
    /// Distance beyond a tip edge at which the smooth flanks would touch, mm of arc: the edge touches off the line of
    /// action. 0 for flank on flank.
    pub off_line: f64,
    /// Part of the flanks that is in contact here.
    pub site: Site,
}

impl SliceResult {
    /// Whether the pressure is larger than that of another slice by more than round-off. So equal slices of a symmetric
    /// pair have a definite order.
    pub fn is_harder(&self, other: &Self) -> bool {
        self.pressure > other.pressure * (1.0 + 1e-9)
    }

    /// The slice with the largest pressure; the first one if several are equal except for round-off.
    pub fn hardest<'a>(slices: impl IntoIterator<Item = &'a Self>) -> Option<&'a Self> {
        slices.into_iter().fold(None, |best, s| if best.is_none_or(|b: &Self| s.is_harder(b)) { Some(s) } else { best })
    }
}

/// Forces and moments on both gears, about their own centres, common axes.
pub fn wrenches(poses: &[Pose; 2], rows: &[ContactRow], forces: &[f64]) -> [Wrench; 2] {
    let centres = poses.map(|p| p.translation.vector);
    [0, 1].map(|i| {
        let sign = if i == 0 { 1.0 } else { -1.0 };
        let (mut force, mut moment) = (Vec3::zeros(), Vec3::zeros());
        for (row, &f) in rows.iter().zip(forces).filter(|(_, f)| **f != 0.0) {
            let f = sign * f * row.traction;
            force += f;
            moment += (row.position - centres[i]).cross(&f);
        }
        Wrench { force: force.into(), moment: moment.into() }
    })
}

/// State of a slice's local approach under its force; zero without a force.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SliceState {
    /// Approach, band and pressure.
    pub local: LocalState,
    /// Energy stored in the local approach minus half of force times approach, N mm.
    pub curved_energy: f64,
}

impl SliceState {
    /// State of a slice of a given length (mm) under a force (N).
    pub fn new(law: &LocalLaw, length: f64, force: f64) -> Self {
        if force <= 0.0 {
            return Self::default();
        }
        let load = force / length;
        Self { local: law.under(load), curved_energy: length * law.curved_energy(load) }
    }

    /// Part of the flanks that is in contact at its slice.
    pub fn site(&self, slice: &Slice) -> Site {
        site(slice, self.local.half_width)
    }
}

/// A loaded slice in the form of the results.
pub fn slice_result(slice: &Slice, side: Side, force: f64, state: &LocalState) -> SliceResult {
    let line_load = force / slice.length;
    SliceResult {
        z: slice.z,
        wheel_z: slice.at[1][1],
        side,
        roll: [slice.at[0][0], slice.at[1][0]],
        line_load,
        half_width: state.half_width,
        pressure: state.pressure,
        off_line: slice.local.off_line,
        site: site(slice, state.half_width),
    }
}

/// What part of the flanks a slice presses with: a tip edge that is off the line of action or within the band, an end
/// face that the slice ends at, or neither.
fn site(slice: &Slice, half_width: f64) -> Site {
    let [pinion, wheel] = slice.local.bodies.map(|b| b.tip_distance);
    // The edge that presses is that of the body whose tip is nearer.
    let tip = if pinion <= wheel { Site::PinionTipEdge } else { Site::WheelTipEdge };
    let nearest_face =
        slice.local.bodies.iter().flat_map(|b| b.ends).map(|end| end.distance).fold(f64::INFINITY, f64::min);
    if slice.local.off_line > 0.0 || pinion.min(wheel) <= half_width {
        tip
    } else if nearest_face <= 0.5 * slice.length * (1.0 + 1e-9) {
        Site::EndFace
    } else {
        Site::Flank
    }
}

/// Derivative of a contact point's position along `direction` by displacements and small turns of both gears about
/// their `centres`. Along the normal it is the derivative of the gap.
pub(crate) fn opening_by_motion(row: &ContactRow, direction: &Vec3, centres: &[Vec3; 2]) -> [f64; 12] {
    let mut j = [0.0; 12];
    for (body, sign) in [1.0, -1.0].into_iter().enumerate() {
        let force = sign * direction;
        let moment = (row.position - centres[body]).cross(&force);
        j[6 * body..6 * body + 3].copy_from_slice(force.as_slice());
        j[6 * body + 3..6 * body + 6].copy_from_slice(moment.as_slice());
    }
    j
}
