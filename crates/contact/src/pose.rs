//! Where the gears stand: rigid offsets of their axes, and the wheel angle that transmission error counts from.
//! Theory (30), (31).

use ale::{Station, ToothWindow};
use geometry::GearPair;
use nalgebra::{SMatrix, Translation3, UnitQuaternion};

use crate::{ContactError, ContactOptions, ContactSet, Pose, Vec3};

/// Centre of a gear, at its mid-face, mm.
pub fn gear_centre(pair: &GearPair, options: &ContactOptions, gear: usize) -> Vec3 {
    let o = options.offsets[gear];
    let [x, z] = [[0.0, 0.0], [pair.centre_distance(), pair.mid_face_offset()]][gear];
    Vec3::new(x + o.x, o.y, z + o.z)
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
/// A gear displaced by z along its axis has its flanks turned by -k z, k the twist of its teeth. The offset of the
/// mid-faces is no displacement: it moves the end faces alone.
pub fn reference_angle(pair: &GearPair, options: &ContactOptions, pinion_angle: f64) -> f64 {
    let [a, b] = [0, 1].map(|i| gear_centre(pair, options, i));
    let [z1, z2] = options.offsets.map(|o| o.z);
    let [t1, t2] = [pair.pinion.twist() * z1, pair.wheel.twist() * z2];
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

/// Poses of both gears displaced from `nominal` by the twelve displacements `d`: of pinion and wheel in turn x, y, z
/// (mm) and turns about x and y (rad), common axes. The turns about z are not applied: [`frames`] takes them, about the
/// gears' own axes.
pub fn displaced(nominal: [Pose; 2], d: &[f64; 12]) -> [Pose; 2] {
    [0, 1].map(|g| {
        let at = 6 * g;
        let moved = Vec3::new(d[at], d[at + 1], d[at + 2]);
        let tilt = UnitQuaternion::from_scaled_axis(Vec3::new(d[at + 3], d[at + 4], 0.0));
        Pose::from_parts(Translation3::from(nominal[g].translation.vector + moved), tilt * nominal[g].rotation)
    })
}

/// G of the forces on the displacements of [`displaced`]; none where both axes are along z, and G is 1.
///
/// ```text
/// f_d = G f,   -df_d/dd = G K G',   row of a turn: the moment about the gear's own axis in place of that about z
/// ```
/// f: forces and moments in common axes, twelve. Work of the forces is then that of the displacements also on an axis that
/// is misaligned or tilted, and the contact has one energy.
pub fn own_turns(poses: &[Pose; 2]) -> Option<SMatrix<f64, 12, 12>> {
    let axes = poses.map(|pose| pose.rotation * Vec3::z());
    if axes.iter().all(|axis| *axis == Vec3::z()) {
        return None;
    }
    let mut all = SMatrix::identity();
    for (gear, axis) in axes.iter().enumerate() {
        (0..3).for_each(|k| all[(6 * gear + 5, 6 * gear + 3 + k)] = axis[k]);
    }
    Some(all)
}
