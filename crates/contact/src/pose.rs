//! Where the gears stand: rigid offsets of their axes, and the wheel angle that transmission error counts from. Theory (30), (31).

use ale::{Station, ToothWindow};
use geometry::{GearPair, Side};
use nalgebra::{Translation3, UnitQuaternion};

use crate::{ContactError, ContactOptions, ContactSet, Pose, Vec3};

/// Rigid displacement of a gear from its nominal place: bearings, housing, shafts.
///
/// The gear turns about its own axis where it then is: levers and torques are about the displaced, tilted axis. Tilts are
/// about axes through the gear's centre at mid-face, parallel to the fixed x and y.
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

/// Deviation of the wheel's axis from the pinion's, as displacement over the face width from z = -b/2 to z = +b/2, mm; the parts
/// add up.
///
/// Terms after ISO/TR 10064-3, which gives the deviations over the bearing span; here they are over the **face width**.
///
/// ```text
/// d = f_Sigma_delta e_x + f_Sigma_beta e_y + f_in t + f_across m
/// t = (sin a_wt, s cos a_wt, 0),  m = (-s cos a_wt, sin a_wt, 0)      s = +1 left, -1 right flanks drive
/// tilt_x = -d_y / b,  tilt_y = d_x / b      of the wheel
/// ```
///
/// t is the direction in which the pinion's loaded flanks push the wheel, transverse, so f_in opens the gap at z = +b/2 by
/// f_in cos b_b against z = -b/2: just as a lead slope C_Hbeta = f_in cos b_b of either flank would. f_across moves the flanks along each other
/// and has next to no effect.
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

/// Centre of a gear, mm.
pub fn gear_centre(pair: &GearPair, options: &ContactOptions, gear: usize) -> Vec3 {
    let o = options.offsets[gear];
    Vec3::new([0.0, pair.centre_distance()][gear] + o.x, o.y, o.z)
}

/// Pose of a gear that is turned by `angle` (rad) about its own axis.
pub fn gear_pose(pair: &GearPair, options: &ContactOptions, gear: usize, angle: f64) -> Pose {
    let o = options.offsets[gear];
    let mut rotation = UnitQuaternion::from_axis_angle(&Vec3::z_axis(), angle);
    if o.is_tilted() {
        rotation = UnitQuaternion::from_scaled_axis(Vec3::new(o.tilt_x, o.tilt_y, 0.0)) * rotation;
    }
    Pose::from_parts(Translation3::from(gear_centre(pair, options, gear)), rotation)
}

/// Wheel angle at which the transmission error is zero, rad: the unmodified flanks touch there, unloaded, axes parallel
/// through the displaced centres.
///
/// A gear displaced by z along its axis has its flanks turned by -k z, k the twist of its teeth.
pub fn reference_angle(pair: &GearPair, options: &ContactOptions, pinion_angle: f64) -> f64 {
    let [a, b] = [0, 1].map(|i| gear_centre(pair, options, i));
    let [t1, t2] = [pair.pinion.twist() * a.z, pair.wheel.twist() * b.z];
    pair.wheel_angle_at(options.side(), pinion_angle - t1, [b.x - a.x, b.y - a.y]) + t2
}

/// Offsets with which the gears still mesh.
pub fn check_offsets(pair: &GearPair, options: &ContactOptions) -> Result<(), ContactError> {
    let bad = |name, value, expected| Err(ContactError::OutOfRange { name, value, expected });
    for o in options.offsets {
        for (name, value) in [("tilt about x [rad]", o.tilt_x), ("tilt about y [rad]", o.tilt_y)] {
            // Beyond this the teeth of ordinary gears jam; and to first order the kinematics would not hold.
            if value.is_nan() || value.abs() > 0.05 {
                return bad(name, value, "-0.05 to 0.05");
            }
        }
    }
    let [a, b] = [0, 1].map(|i| gear_centre(pair, options, i));
    let distance = (b - a).xy().norm();
    let least = pair.pinion.base_radius() + pair.wheel.base_radius();
    if !(distance > least && distance < pair.pinion.tip_radius() + pair.wheel.tip_radius()) {
        return bad("distance of the displaced axes [mm]", distance, "between the sums of base and of tip radii");
    }
    let apart = b.z - a.z;
    if apart.is_nan() || apart.abs() >= pair.face_width() {
        return bad("axial offset between the gears [mm]", apart, "smaller than the face width");
    }
    Ok(())
}

/// Frames of the matrices when both gears are turned from the unloaded position.
pub fn frames(
    pair: &GearPair,
    set: &ContactSet,
    window: &ToothWindow,
    options: &ContactOptions,
    station: Station,
    turns: [f64; 2],
) -> [Pose; 2] {
    let theta1 = station.pinion_angle(pair, options.side(), options.sense);
    let angles = [theta1, reference_angle(pair, options, theta1)];
    // Teeth counted from the middle pair of the cycle stand at these angles; the matrices count from their first tooth.
    let first_pair = window.first() - station.middle_pair(options.sense);
    let last_pair = first_pair + window.count() as i64 - 1;
    let [f1, f2] = set.first_teeth();
    let whole = [
        (first_pair - i64::from(f1)).rem_euclid(i64::from(pair.pinion.teeth())) as f64 * pair.pinion.pitch_angle(),
        (-last_pair - i64::from(f2)).rem_euclid(i64::from(pair.wheel.teeth())) as f64 * pair.wheel.pitch_angle(),
    ];
    [0, 1].map(|i| gear_pose(pair, options, i, angles[i] + turns[i] + whole[i]))
}
