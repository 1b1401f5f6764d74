//! Effect of displacements of both gears on flanks in one plane of action. Theory (75).

use geometry::{GearPair, Side};
use nalgebra::{SVector, Vector3};

/// Coordinates of a gear: x, y, z and the turns about them.
const COORDINATES: usize = 6;

/// Displacements of both gears.
type Displacement = SVector<f64, 12>;

/// Approach of the flanks on one side and their tilt, as linear functions of the twelve displacements: x, y, z (mm) and
/// rotations (rad) of pinion and wheel. x points from axis to axis.
///
/// ```text
/// x = a . d: approach along the normal at the pitch point, mm;   gamma = b . d: tilt in the plane of action, rad
/// approach at zeta = x + zeta gamma,   zeta: place along the plane of action across the normal, from the pitch point, mm
/// ```
/// The flanks of an involute pair touch in this plane and have one normal there. So no other displacement changes a gap
/// to first order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankProjection {
    /// Approach a.
    pub approach: Displacement,
    /// Tilt b.
    pub tilt: Displacement,
    /// Friction that slides across the path of contact: per unit of force on the pinion, of its moment with the
    /// position along the path as lever, and of its moment with the position along the face as lever. Theory (75a).
    pub friction: [Displacement; 3],
    /// Pitch point in the middle of the common face, mm.
    point: Vector3<f64>,
    /// Direction of zeta.
    across: Vector3<f64>,
    /// Transverse line of action.
    along: Vector3<f64>,
}

impl FlankProjection {
    /// Approach and tilt of the flanks on a side.
    pub fn new(pair: &GearPair, side: Side) -> Self {
        let s = side.sign();
        let (sin, cos) = pair.working_pressure_angle().sin_cos();
        let base = pair.pinion.base_radius();
        let along = Vector3::new(sin, s * cos, 0.0);
        // A gear that moves along its axis has its flanks turned by the twist of its teeth.
        let normal = (along - s * base * pair.pinion.twist() * Vector3::z()).normalize();
        let pitch_radius = base / cos;
        let point = Vector3::new(pitch_radius, 0.0, pair.common_middle()[0]);
        let out_of_plane = along.cross(&Vector3::z());
        let centres = [Vector3::zeros(), Vector3::new(pair.centre_distance(), 0.0, pair.mid_face_offset())];
        let [mut approach, mut tilt] = [Displacement::zeros(); 2];
        let (slide, mut friction) = (Vector3::z().cross(&along), [Displacement::zeros(); 3]);
        for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
            let arm = point - centres[g];
            let (moment, of_slide) = (arm.cross(&normal), arm.cross(&slide));
            for i in 0..3 {
                friction[0][COORDINATES * g + i] = sign * slide[i];
                friction[0][COORDINATES * g + 3 + i] = sign * of_slide[i];
                friction[2][COORDINATES * g + 3 + i] = -sign * along[i];
                approach[COORDINATES * g + i] = sign * normal[i];
                approach[COORDINATES * g + 3 + i] = sign * moment[i];
                tilt[COORDINATES * g + 3 + i] = -sign * out_of_plane[i];
            }
        }
        for (i, sign) in [(COORDINATES - 1, 1.0), (2 * COORDINATES - 1, -1.0)] {
            friction[1][i] = sign;
        }
        Self { approach, tilt, friction, point, across: out_of_plane.cross(&normal), along }
    }

    /// Friction on the pinion at a point: force along the sliding direction (N), and its moments along the path of
    /// contact and over the face (N mm).
    pub fn rubbing(&self, position: &Vector3<f64>, force: &Vector3<f64>) -> [f64; 3] {
        let moment = (position - self.point).cross(force);
        [Vector3::z().cross(&self.along).dot(force), moment.z, -moment.dot(&self.along)]
    }

    /// Stiffness along the approach of the normal forces alone, N/mm, from the derivatives of all forces (-d/dd) by the
    /// wheel's rotation. Friction has no component along the line of action.
    pub fn normal_stiffness(&self, over_turn: &Displacement) -> f64 {
        let normal = self.approach.fixed_rows::<2>(0);
        let along = normal.dot(&over_turn.fixed_rows::<2>(0));
        along / (normal.norm_squared() * self.approach[2 * COORDINATES - 1])
    }

    /// Position of a contact point across the normal, mm.
    pub fn lever(&self, position: &Vector3<f64>) -> f64 {
        (position - self.point).dot(&self.across)
    }

    /// Displacements with this approach and tilt: the wheel rotates about its own axis and tilts in the plane of
    /// action.
    pub fn displacement(&self, approach: f64, tilt: f64) -> Displacement {
        let turn = 2 * COORDINATES - 1;
        let mut d = Displacement::zeros();
        for i in [COORDINATES + 3, COORDINATES + 4] {
            // The axis of the tilt is a unit vector across the axes.
            d[i] = tilt * self.tilt[i];
        }
        d[turn] = (approach - self.approach.dot(&d)) / self.approach[turn];
        d
    }
}
