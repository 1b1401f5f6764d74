//! Rigid offsets of gears and axes. Theory (30).

use geometry::{GearPair, Side};

/// Rigid displacement of a gear from its nominal position, by bearings, housing or shafts.
///
/// The gear rotates about its own displaced and tilted axis, and levers and torques refer to this axis. Tilts are about
/// axes through the gear's centre at mid-face, parallel to the fixed x and y.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Offset {
    /// Displacement along the line of centres, from pinion to wheel, mm.
    pub x: f64,
    /// Displacement across the line of centres, mm.
    pub y: f64,
    /// Displacement along the axis, mm.
    pub z: f64,
    /// Tilt about x, rad: the axis leans towards -y with increasing z.
    pub tilt_x: f64,
    /// Tilt about y, rad: the axis leans towards +x with increasing z.
    pub tilt_y: f64,
}

/// Deviation of the wheel's axis from the pinion's, as displacement over the face width from z = -b/2 to z = +b/2, mm,
/// where b is the common face width. The parts add up.
///
/// Terms follow ISO/TR 10064-3. That report gives the deviations over the bearing span; here they are over the **face
/// width**.
///
/// ```text
/// d = f_Sigma_delta e_x + f_Sigma_beta e_y + f_in t + f_across m
/// t = (sin a_wt, s cos a_wt, 0),  m = (-s cos a_wt, sin a_wt, 0)      s = +1 left, -1 right flanks drive
/// tilt_x = -d_y / b,  tilt_y = d_x / b      of the wheel
/// ```
///
/// t is the transverse direction in which the pinion's loaded flanks push the wheel. So f_in opens the gap at z = +b/2
/// by f_in cos b_b relative to z = -b/2, as a lead slope C_Hbeta = f_in cos b_b of either flank would. f_across moves
/// the flanks along each other and has almost no effect.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Misalignment {
    /// f_Sigma_beta, perpendicular to the plane of axes; positive if the wheel's axis leans towards +y with increasing
    /// z.
    pub deviation: f64,
    /// f_Sigma_delta, in the plane of axes; positive if the distance of the axes grows with z.
    pub inclination: f64,
    /// f_in, in the plane of action of the driving flanks; positive if the gap opens with increasing z.
    pub in_plane_of_action: f64,
    /// f_across, perpendicular to that plane.
    pub across_plane_of_action: f64,
}

impl Misalignment {
    /// Equivalent offset of the wheel when the flanks on `side` carry the load.
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
    /// Whether the gear's axis is tilted.
    pub fn is_tilted(&self) -> bool {
        self.tilt_x != 0.0 || self.tilt_y != 0.0
    }
}
