//! Involute helicoid: the exact flank surface. Theory (7), (8), (9).

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::{Vec3, profile::LAST_DIGITS};

/// Side of a tooth, seen from +z with the tooth pointing up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// Counter-clockwise side.
    Left,
    /// Clockwise side.
    Right,
}

impl Side {
    /// +1 for left, -1 for right.
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }

    /// The other side.
    pub fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// `left` or `right`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// One flank in its gear's own frame.
///
/// ```text
/// P(u, z) = r_b [e_r(phi) + s u e_t(phi)] + z e_z,   phi = c + k z + s (sigma - u)
/// n(u, z) = s cos(b_b) [e_t(phi) - tan(b_b) e_z]     out of the tooth
/// ```
/// u is the roll angle, s = +1 for left and -1 for right, c the tooth's centre angle, k = tan(b)/r the twist, sigma the
/// half tooth angle at the base circle. The surface is developable, with straight generators: one principal curvature
/// is 0, the other is cos(b_b)/(r_b u) in the direction e_r.
///
/// For an internal gear r_b is negative, sigma is that of z < 0, and c is half a revolution larger. The same formulas
/// then give a concave flank. Left and right follow ISO 21771: seen with the tooth pointing up, which is towards the
/// axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flank {
    /// Side of the tooth.
    pub side: Side,
    /// Base radius r_b, mm; negative for an internal gear.
    pub base_radius: f64,
    /// Half tooth angle at the base circle, sigma, rad.
    pub base_half_angle: f64,
    /// Twist k, rad/mm.
    pub twist: f64,
    /// Base helix angle b_b, rad, with the sign of k r_b.
    pub base_helix_angle: f64,
    /// Centre angle of the tooth, c, rad.
    pub centre_angle: f64,
    /// Roll angle at the root form circle.
    pub roll_form: f64,
    /// Roll angle at the tip circle.
    pub roll_tip: f64,
    /// Half of the face width, b/2, mm.
    pub half_width: f64,
}

/// Foot point on a flank of a point in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankPoint {
    /// Roll angle of the foot point.
    pub roll: f64,
    /// Axial position of the foot point, mm.
    pub z: f64,
    /// Signed distance, mm; positive outside the tooth.
    pub distance: f64,
}

/// Unit directions of the nominal surface at a place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Directions {
    /// Out of the tooth.
    pub normal: Vec3,
    /// e_r, of the profile.
    pub profile: Vec3,
    /// Direction of the straight generator: sin(b_b) e_t + cos(b_b) e_z.
    pub generator: Vec3,
}

impl Flank {
    /// Direction angle phi of the base-circle point that generates (u, z).
    pub fn generating_angle(&self, u: f64, z: f64) -> f64 {
        self.centre_angle + self.twist * z + self.side.sign() * (self.base_half_angle - u)
    }

    /// Surface point, mm.
    pub fn point(&self, u: f64, z: f64) -> Vec3 {
        let (sin, cos) = self.generating_angle(u, z).sin_cos();
        let along = self.side.sign() * u;
        Vec3::new(self.base_radius * (cos - along * sin), self.base_radius * (sin + along * cos), z)
    }

    /// Unit normal, pointing out of the tooth.
    pub fn normal(&self, u: f64, z: f64) -> Vec3 {
        self.frame(u, z)[0]
    }

    /// Unit normal and unit profile direction (in the transverse plane), computed from one sine and cosine.
    pub fn frame(&self, u: f64, z: f64) -> [Vec3; 2] {
        let frame = self.directions(u, z);
        [frame.normal, frame.profile]
    }

    /// The three directions of the nominal surface, with one sine for all.
    pub(crate) fn directions(&self, u: f64, z: f64) -> Directions {
        let (sin, cos) = self.generating_angle(u, z).sin_cos();
        self.directions_at([sin, cos])
    }

    /// Directions from sine and cosine of phi.
    fn directions_at(&self, [sin, cos]: [f64; 2]) -> Directions {
        let [sin_b, cos_b] = self.base_helix();
        Directions {
            normal: self.side.sign() * Vec3::new(-sin * cos_b, cos * cos_b, -sin_b),
            profile: Vec3::new(cos, sin, 0.0),
            generator: Vec3::new(-sin_b * sin, sin_b * cos, cos_b),
        }
    }

    /// Surface point (mm) whose directions are known.
    pub(crate) fn point_at(&self, u: f64, z: f64, directions: &Directions) -> Vec3 {
        let [cos, sin] = [directions.profile.x, directions.profile.y];
        let along = self.side.sign() * u;
        Vec3::new(self.base_radius * (cos - along * sin), self.base_radius * (sin + along * cos), z)
    }

    /// Surface point (mm) and its derivative by roll angle (mm), computed from one sine and cosine.
    pub fn point_and_profile(&self, u: f64, z: f64) -> [Vec3; 2] {
        let frame = self.directions(u, z);
        [self.point_at(u, z, &frame), self.base_radius * u * frame.profile]
    }

    /// Derivatives of the surface point by roll angle (mm) and by z (1).
    pub fn tangents(&self, u: f64, z: f64) -> [Vec3; 2] {
        let [p, profile] = self.point_and_profile(u, z);
        [profile, Vec3::new(-self.twist * p.y, self.twist * p.x, 1.0)]
    }

    /// Roll angles at the two ends of the flank, the smaller first. An external flank runs from its root form circle to
    /// its tip circle, an internal flank from its tip circle to its root form circle.
    pub fn roll_range(&self) -> [f64; 2] {
        [self.roll_form.min(self.roll_tip), self.roll_form.max(self.roll_tip)]
    }

    /// Principal curvatures, 1/mm: across the generator (profile direction, convex positive) and along it (0).
    pub fn curvatures(&self, u: f64) -> [f64; 2] {
        [self.base_helix()[1] / (self.base_radius * u), 0.0]
    }

    /// Foot point of `p` (mm, the gear's own frame) on the helicoid of this tooth, extended without bounds.
    ///
    /// Every offset surface of an involute helicoid is the same helicoid rotated about the axis. So the foot point has
    /// a closed form:
    /// ```text
    /// W = sqrt(R^2 - r_b^2),  phi = arg p - s atan(W / r_b)
    /// d = r_b cos(b_b) [s (phi - c - k z_p) - sigma + W / r_b]
    /// z = z_p + s d sin(b_b),  r_b u = W - d cos(b_b)
    /// ```
    /// `None` below the base cylinder, where the involute has no normal. A point that lies below it by at most a
    /// millionth of its radius (the precision of a mesh file) counts as on it. The caller compares `roll` and `z` with
    /// the bounds of the flank.
    pub fn locate(&self, p: &Vec3) -> Option<FlankPoint> {
        self.locate_with_directions(p).map(|(foot, _)| foot)
    }

    /// Foot point of `p` as in [`Flank::locate`], and the unit normal there.
    pub fn locate_with_normal(&self, p: &Vec3) -> Option<(FlankPoint, Vec3)> {
        self.locate_with_directions(p).map(|(foot, directions)| (foot, directions.normal))
    }

    /// The foot point and the directions there: phi is the direction angle of the base point whose generator runs
    /// through `p`, so no further angle is needed for them.
    pub(crate) fn locate_with_directions(&self, p: &Vec3) -> Option<(FlankPoint, Directions)> {
        let s = self.side.sign();
        let square = p.x * p.x + p.y * p.y;
        let base = self.base_radius * self.base_radius;
        let reach = square - base;
        if reach < -2.0 * LAST_DIGITS * base {
            return None;
        }
        let w = reach.max(0.0).sqrt().copysign(self.base_radius);
        let [sin_b, cos_b] = self.base_helix();
        // R^2 exp(i phi) = (x + i y) (r_b - i s W)
        let [cos, sin] = [p.x * self.base_radius + s * w * p.y, p.y * self.base_radius - s * w * p.x];
        let phi = sin.atan2(cos);
        let directions = self.directions_at([sin / square, cos / square]);
        // The flank's own angle at u = W / r_b; the small difference is what the distance turns the helicoid by.
        let expected = self.centre_angle + self.twist * p.z + s * (self.base_half_angle - w / self.base_radius);
        let turn = wrap(phi - expected);
        let distance = self.base_radius * cos_b * s * turn;
        let mut roll = (w - distance * cos_b) / self.base_radius;
        if reach <= 0.0 {
            roll = roll.max(0.0);
        }
        Some((FlankPoint { roll, z: p.z + s * distance * sin_b, distance }, directions))
    }

    /// sin b_b and cos b_b, from k r_b = tan b_b.
    pub(crate) fn base_helix(&self) -> [f64; 2] {
        let tan = self.twist * self.base_radius;
        let cos = 1.0 / (1.0 + tan * tan).sqrt();
        [tan * cos, cos]
    }
}

/// Angle in (-pi, pi].
pub(crate) fn wrap(angle: f64) -> f64 {
    if angle.abs() < PI {
        return angle;
    }
    let turned = angle - (angle / (2.0 * PI)).round() * (2.0 * PI);
    // Half a turn either way is the positive one.
    if turned <= -PI { turned + 2.0 * PI } else { turned }
}
