//! Coulomb friction on the quasi-static contact. Theory (19e).

use geometry::GearPair;

use crate::{ContactOptions, Pose, Vec3, nodal::ContactRow};

/// Sliding at which friction has risen to tanh(1) = 76 % of Coulomb's, as a share of the sliding at the end of the
/// longer half of the path of contact: it changes its sign through zero where a slice passes the pitch line.
const REGULARISATION: f64 = 0.02;

/// Friction of a pair that rotates with the ratio of its tooth numbers.
///
/// ```text
/// F_t = -mu tanh(|v| / v_0) v / |v| F_n,   v = v_1 - v_2 at the contact
/// ```
/// v scales with the speed and so does v_0, so friction depends only on the position. Friction changes the deformation
/// as well as the torque: the matrix of the contact is not symmetric.
#[derive(Debug, Clone, Copy)]
pub struct Friction {
    coefficient: f64,
    sense: f64,
    ratio: f64,
    /// v_0, mm per radian of the pinion.
    least: f64,
}

impl Friction {
    /// `None` without friction.
    pub fn new(pair: &GearPair, options: &ContactOptions) -> Option<Self> {
        (options.friction != 0.0).then(|| Self {
            coefficient: options.friction,
            sense: options.sense.sign() as f64,
            ratio: ratio(pair),
            least: REGULARISATION * fastest(pair),
        })
    }

    /// The row with its friction.
    pub fn on(&self, poses: &[Pose; 2], row: ContactRow) -> ContactRow {
        let v = self.sense * sliding(self.ratio, poses, &row);
        let speed = v.norm();
        if speed == 0.0 {
            return row;
        }
        row.with_friction(poses, &(-self.coefficient * (speed / self.least).tanh() / speed * v))
    }
}

/// Friction work per radian of the pinion's rotation in the running sense, for a unit normal force at the row, mm.
pub fn friction_work(pair: &GearPair, options: &ContactOptions, poses: &[Pose; 2], row: &ContactRow) -> f64 {
    let on_pinion = row.traction - row.normal;
    -(options.sense.sign() as f64) * on_pinion.dot(&sliding(ratio(pair), poses, row))
}

/// Sliding distance of the flanks on each other at the row per radian of the pinion's rotation, mm.
pub fn sliding_distance(pair: &GearPair, poses: &[Pose; 2], row: &ContactRow) -> f64 {
    sliding(ratio(pair), poses, row).norm()
}

/// Sliding of the pinion's flank on the wheel's, mm per radian of counter-clockwise pinion rotation.
fn sliding(ratio: f64, poses: &[Pose; 2], row: &ContactRow) -> Vec3 {
    let turning = |pose: &Pose| (pose.rotation * Vec3::z()).cross(&(row.position - pose.translation.vector));
    let v = turning(&poses[0]) + ratio * turning(&poses[1]);
    v - row.normal * row.normal.dot(&v)
}

/// Turn of the wheel, against that of the pinion, for a turn of the pinion; negative of a ring, which turns as its pinion does.
fn ratio(pair: &GearPair) -> f64 {
    pair.pinion.signed_teeth() / pair.wheel.signed_teeth()
}

/// Largest sliding on the path of contact, mm per radian of the pinion: distance from the pitch point times (1 + z1 /
/// z2).
fn fastest(pair: &GearPair) -> f64 {
    let pitch_point = pair.pinion.base_radius() * pair.working_pressure_angle().tan();
    let ends = pair.path_of_contact();
    (1.0 + ratio(pair)) * ends.iter().map(|xi| (xi - pitch_point).abs()).fold(0.0, f64::max)
}
