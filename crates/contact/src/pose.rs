//! Poses of the gears: rigid offsets of their axes, and the wheel angle from which the transmission error is counted.
//! Theory (30), (31).

use ale::{Station, ToothWindow};
use geometry::GearPair;
use nalgebra::{Matrix3, SMatrix, Translation3, UnitQuaternion};

use crate::{ContactError, ContactOptions, ContactSet, Pose, Vec3};

/// Centre of a gear at its mid-face, mm.
pub fn gear_centre(pair: &GearPair, options: &ContactOptions, gear: usize) -> Vec3 {
    let o = options.offsets[gear];
    let [x, z] = [[0.0, 0.0], [pair.centre_distance(), pair.mid_face_offset()]][gear];
    Vec3::new(x + o.x, o.y, z + o.z)
}

/// Pose of a gear rotated by `angle` (rad) about its own axis.
pub fn gear_pose(pair: &GearPair, options: &ContactOptions, gear: usize, angle: f64) -> Pose {
    let o = options.offsets[gear];
    let mut rotation = UnitQuaternion::from_axis_angle(&Vec3::z_axis(), angle);
    if o.is_tilted() {
        rotation = UnitQuaternion::from_scaled_axis(Vec3::new(o.tilt_x, o.tilt_y, 0.0)) * rotation;
    }
    Pose::from_parts(Translation3::from(gear_centre(pair, options, gear)), rotation)
}

/// Wheel angle at which the transmission error is zero, rad: the unmodified flanks touch unloaded, with parallel axes
/// through the displaced centres. [`ContactOptions::wheel_turn`] is added to it.
///
/// The flanks of a gear displaced by z along its axis are rotated by -k z, where k is the twist of its teeth. The
/// offset of the mid-faces is not a displacement: it moves only the end faces.
pub fn reference_angle(pair: &GearPair, options: &ContactOptions, pinion_angle: f64) -> f64 {
    let [a, b] = [0, 1].map(|i| gear_centre(pair, options, i));
    let [z1, z2] = options.offsets.map(|o| o.z);
    let [t1, t2] = [pair.pinion.twist() * z1, pair.wheel.twist() * z2];
    pair.wheel_angle_at(options.side(), pinion_angle - t1, [b.x - a.x, b.y - a.y]) + t2 + options.wheel_turn
}

/// Checks that the gears still mesh with these offsets.
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
    // Signed as the radii are: negative of a ring.
    let sign = pair.wheel.sign();
    let distance = sign * (b - a).xy().norm();
    let least = pair.pinion.base_radius() + pair.wheel.base_radius();
    if !(sign * distance > sign * least && distance < pair.pinion.tip_radius() + pair.wheel.tip_radius()) {
        return bad("distance of the displaced axes [mm]", distance, "between the sums of base and of tip radii");
    }
    let apart = options.offsets[1].z - options.offsets[0].z;
    if apart.is_nan() || apart.abs() >= pair.face_width() {
        return bad(
            "axial displacement of the gears against each other [mm]",
            apart,
            "smaller than the common face width",
        );
    }
    Ok(())
}

/// Frames of the matrices when both gears are rotated from the unloaded position.
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

/// Poses of both gears displaced from `nominal` by the twelve displacements `d`: for pinion and wheel in turn x, y, z
/// (mm) and rotations about x and y (rad), common axes. The rotations about z are not applied here; [`frames`] applies
/// them about the gears' own axes.
pub fn displaced(nominal: [Pose; 2], d: &[f64; 12]) -> [Pose; 2] {
    [0, 1].map(|g| {
        let at = 6 * g;
        let moved = Vec3::new(d[at], d[at + 1], d[at + 2]);
        let tilt = UnitQuaternion::from_scaled_axis(Vec3::new(d[at + 3], d[at + 4], 0.0));
        Pose::from_parts(Translation3::from(nominal[g].translation.vector + moved), tilt * nominal[g].rotation)
    })
}

/// Matrix G of the forces on the displacements `d` of [`displaced`] that led to `poses`. `None` if no gear tilts and
/// both axes are along z; then G is 1. Theory (45c).
///
/// ```text
/// f_d = G f,   d rotation/d d_k = w_k:   w_tilt = J e,   w_turn = the gear's own axis,   row of a tilt or turn of G: w'
/// J = 1 + (1 - cos a)/a^2 [p] + (a - sin a)/a^3 [p]^2,   p = (tilt x, tilt y, 0),   a = |p|
/// ```
/// f are the twelve forces and moments in common axes. With G the work of the forces equals that of the displacements
/// exactly, also on a misaligned or tilted axis: the contact has one energy V and f_d = -dV/dd. A rotation gets the
/// moment about the gear's own axis instead of that about z; from a tilt, half of the other tilt's share of the moment
/// about z is subtracted. J is the left Jacobian of a rotation vector (Sola, Deray and Atchuthan, A micro Lie theory,
/// 2018, eq. 145). The slope is -df_d/dd = G K G' except for terms of the size of the moments themselves, which are
/// small compared with a stiffness times a lever.
pub fn generalised(poses: &[Pose; 2], d: &[f64; 12]) -> Option<SMatrix<f64, 12, 12>> {
    let axes = poses.map(|pose| pose.rotation * Vec3::z());
    let tilts = [0, 1].map(|g| Vec3::new(d[6 * g + 3], d[6 * g + 4], 0.0));
    if axes.iter().all(|axis| *axis == Vec3::z()) && tilts.iter().all(|tilt| *tilt == Vec3::zeros()) {
        return None;
    }
    let mut all = SMatrix::identity();
    for (gear, (axis, tilt)) in axes.iter().zip(&tilts).enumerate() {
        let at = 6 * gear + 3;
        let rates = left_jacobian(tilt);
        for k in 0..3 {
            (all[(at, at + k)], all[(at + 1, at + k)]) = (rates[(k, 0)], rates[(k, 1)]);
            all[(at + 2, at + k)] = axis[k];
        }
    }
    Some(all)
}

/// Angular velocity of a rotation vector `p` by its rate, 3 x 3.
fn left_jacobian(p: &Vec3) -> Matrix3<f64> {
    let square = p.norm_squared();
    // Below this the next term of either series is under the last bit.
    let (first, second) = if square < 1e-8 {
        (0.5 - square / 24.0, 1.0 / 6.0 - square / 120.0)
    } else {
        let angle = square.sqrt();
        ((1.0 - angle.cos()) / square, (angle - angle.sin()) / (square * angle))
    };
    let cross = p.cross_matrix();
    Matrix3::identity() + first * cross + second * cross * cross
}
