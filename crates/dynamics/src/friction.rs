//! Coulomb friction on the quasi-static contact.

use contact::{ContactRow, Pose, Vec3};
use geometry::GearPair;

use crate::StaticOptions;

/// Sliding at which friction has risen to tanh(1) = 76 % of Coulomb's, as a share of the sliding at the end of the longer half of the
/// path of contact: it changes its sign through zero where a slice passes the pitch line.
const REGULARISATION: f64 = 0.02;

/// The rows with friction, if there is any.
///
/// ```text
/// F_t = -mu tanh(|v| / v_0) v / |v| F_n,   v = v_1 - v_2 at the contact, both gears turning in the ratio of their teeth
/// ```
/// v scales with the speed and so does v_0: friction depends on the position alone. It acts on the material as well as on the torque:
/// the matrix of the contact is not symmetric.
pub(crate) fn applied(
    pair: &GearPair,
    options: &StaticOptions,
    poses: &[Pose; 2],
    rows: Vec<ContactRow>,
) -> Vec<ContactRow> {
    if options.friction == 0.0 {
        return rows;
    }
    let sense = options.sense.sign() as f64;
    let least = REGULARISATION * fastest(pair);
    let with = |row: ContactRow| {
        let v = sense * sliding(pair, poses, &row);
        let speed = v.norm();
        if speed == 0.0 {
            return row;
        }
        row.with_friction(poses, &(-options.friction * (speed / least).tanh() / speed * v))
    };
    rows.into_iter().map(with).collect()
}

/// Work that friction takes per radian of the pinion's rotation in the running sense, for a unit normal force at the row, mm.
pub(crate) fn work(pair: &GearPair, options: &StaticOptions, poses: &[Pose; 2], row: &ContactRow) -> f64 {
    let on_pinion = row.traction - row.normal;
    -(options.sense.sign() as f64) * on_pinion.dot(&sliding(pair, poses, row))
}

/// Sliding of the pinion's flank on the wheel's, mm per radian of counter-clockwise pinion rotation.
fn sliding(pair: &GearPair, poses: &[Pose; 2], row: &ContactRow) -> Vec3 {
    let ratio = f64::from(pair.pinion.teeth()) / f64::from(pair.wheel.teeth());
    let turning = |pose: &Pose| (pose.rotation * Vec3::z()).cross(&(row.position - pose.translation.vector));
    let v = turning(&poses[0]) + ratio * turning(&poses[1]);
    v - row.normal * row.normal.dot(&v)
}

/// Largest sliding on the path of contact, mm per radian of the pinion: distance from the pitch point times (1 + z1 / z2).
fn fastest(pair: &GearPair) -> f64 {
    let pitch_point = pair.pinion.base_radius() * pair.working_pressure_angle().tan();
    let ratio = f64::from(pair.pinion.teeth()) / f64::from(pair.wheel.teeth());
    let ends = pair.path_of_contact();
    (1.0 + ratio) * ends.iter().map(|xi| (xi - pitch_point).abs()).fold(0.0, f64::max)
}
