//! Rigid offsets of gears and axes. Theory (30).

use geometry::{GearPair, Side};

/// Rigid displacement of a gear from its nominal place: bearings, housing, shafts.
///
/// The gear turns about its own axis where it then is: levers and torques are about the displaced, tilted axis. Tilts
/// are about axes through the gear's centre at mid-face, parallel to the fixed x and y.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Offset {
    /// Along the line of centres, from pinion to wheel, mm.
    pub x: f64,
    /// Across it, mm.
    pub y: f64,
    /// Along the axis, mm.
    pub z: f64,
    /// About x, rad: the axis leans towards -y as z grows.
    pub tilt_x: f64,
    /// About y, rad: the axis leans towards +x as z grows.
    pub tilt_y: f64,
}

/// Deviation of the wheel's axis from the pinion's, as displacement over the face width from z = -b/2 to z = +b/2, mm, b the common
/// face width; the parts add up.
///
/// Terms after ISO/TR 10064-3, which gives the deviations over the bearing span; here they are over the **face width**.
///
/// ```text
/// d = f_Sigma_delta e_x + f_Sigma_beta e_y + f_in t + f_across m
/// t = (sin a_wt, s cos a_wt, 0),  m = (-s cos a_wt, sin a_wt, 0)      s = +1 left, -1 right flanks drive
/// tilt_x = -d_y / b,  tilt_y = d_x / b      of the wheel
/// ```
///
/// t is the direction in which the pinion's loaded flanks push the wheel, transverse, so f_in opens the gap at z = +b/2
/// by f_in cos b_b against z = -b/2: just as a lead slope C_Hbeta = f_in cos b_b of either flank would. f_across moves
/// the flanks along each other and has next to no effect.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Misalignment {
    /// f_Sigma_beta, across the plane of axes: the wheel's axis leans towards +y (positive) as z grows.
    pub deviation: f64,
    /// f_Sigma_delta, in the plane of axes: the distance of the axes grows (positive) with z.
    pub inclination: f64,
    /// f_in, in the plane of action of the driving flanks: the gap opens (positive) as z grows.
    pub in_plane_of_action: f64,
    /// f_across, across that plane.
    pub across_plane_of_action: f64,
}

impl Misalignment {
    /// Offset of the wheel that it amounts to when the flanks on `side` carry the load.
    pub fn wheel_offset(&self, pair: &GearPair, side: Side) -> Offset {
        let (sin, cos) = pair.working_pressure_angle().sin_cos();
        let s = side.sign();
        let (along, across) = (self.in_plane_of_action, self.across_plane_of_action);
        let dx = self.inclination + along * sin - across * s * cos;
        let dy = self.deviation + along * s * cos + across * sin;
        let width = pair.face_width();
        // 0.0 first: no misalignment is +0 and not -0.
        Offset { tilt_x: 0.0 - dy / width, tilt_y: dx / width, ..Offset::default() }
    }
}

impl Offset {
    /// Whether the gear's axis leans.
    pub fn is_tilted(&self) -> bool {
        self.tilt_x != 0.0 || self.tilt_y != 0.0
    }
}
