//! The flank as it is made: helicoid minus depth. Theory (28), (29).

use std::sync::Arc;

use super::{Depth, DepthField};
use crate::{Flank, FlankPoint, Vec3};

/// One flank with its micro-geometry, in its gear's own frame; surface coordinates are those of the nominal helicoid.
///
/// ```text
/// X(u, z) = P(u, z) - h(u, z) n(u, z)
/// ```
/// P, n: nominal point and normal; h: depth, material removed positive.
#[derive(Debug, Clone, PartialEq)]
pub struct ModifiedFlank {
    flank: Flank,
    field: Option<Arc<DepthField>>,
    /// Depth by which this tooth stands back because of its pitch error, mm.
    pitch: f64,
}

impl From<Flank> for ModifiedFlank {
    fn from(flank: Flank) -> Self {
        Self { flank, field: None, pitch: 0.0 }
    }
}

impl ModifiedFlank {
    pub(crate) fn new(flank: Flank, field: Option<Arc<DepthField>>, pitch: f64) -> Self {
        Self { flank, field, pitch }
    }

    /// The nominal helicoid.
    pub fn nominal(&self) -> &Flank {
        &self.flank
    }

    /// Depth at roll angle `u` and height `z` (mm), pitch error included, with first derivatives.
    pub fn depth(&self, u: f64, z: f64) -> Depth {
        let mut depth = self.field.as_ref().map_or_else(Depth::default, |f| f.at(u, z));
        depth.value += self.pitch;
        depth
    }

    /// Whether the flank is a plain helicoid, if one turned by a pitch error: nothing is ground off that varies along
    /// it.
    pub fn is_offset_helicoid(&self) -> bool {
        self.field.is_none()
    }

    fn is_nominal(&self) -> bool {
        self.field.is_none() && self.pitch == 0.0
    }

    /// Surface point, mm.
    pub fn point(&self, u: f64, z: f64) -> Vec3 {
        let nominal = self.flank.point(u, z);
        if self.is_nominal() {
            return nominal;
        }
        nominal - self.depth(u, z).value * self.flank.normal(u, z)
    }

    /// Unit normal of the modified surface, out of the tooth.
    ///
    /// The nominal normal tilted by the slope of the depth:
    /// ```text
    /// N ~ n + g_1 e_r + g_2 l,   g_1 = h_u / (r_b u - h cos b_b),   g_2 = cos(b_b) (h_z + s k h_u)
    /// ```
    /// e_r is the profile direction and l that of the generator; both are tangent to the nominal flank.
    pub fn normal(&self, u: f64, z: f64) -> Vec3 {
        let n = self.flank.normal(u, z);
        let Some(field) = &self.field else { return n };
        let depth = field.at(u, z);
        let s = self.flank.side.sign();
        let cos_b = self.flank.base_helix_angle.cos();
        let (e_r, generator) = self.directions(u, z);
        let along = depth.by_roll / self.offset_radius(u, depth.value + self.pitch);
        let across = cos_b * (depth.by_z + s * self.flank.twist * depth.by_roll);
        (n + along * e_r + across * generator).normalize()
    }

    /// Surface point (mm) and its derivative by roll angle (mm).
    pub fn point_and_profile(&self, u: f64, z: f64) -> [Vec3; 2] {
        if self.is_nominal() {
            return self.flank.point_and_profile(u, z);
        }
        let [point, profile] = self.flank.point_and_profile(u, z);
        let n = self.flank.normal(u, z);
        let depth = self.depth(u, z);
        let shrunk = 1.0 - depth.value * self.flank.base_helix_angle.cos() / (self.flank.base_radius * u);
        [point - depth.value * n, shrunk * profile - depth.by_roll * n]
    }

    /// Derivatives of the surface point by roll angle (mm) and by z (1).
    ///
    /// ```text
    /// X_u = (r_b u - h cos b_b) e_r - h_u n
    /// X_z = l / cos b_b - s k (r_b u - h cos b_b) e_r - h_z n
    /// ```
    pub fn tangents(&self, u: f64, z: f64) -> [Vec3; 2] {
        if self.is_nominal() {
            return self.flank.tangents(u, z);
        }
        let n = self.flank.normal(u, z);
        let depth = self.depth(u, z);
        let (s, cos_b) = (self.flank.side.sign(), self.flank.base_helix_angle.cos());
        let (e_r, generator) = self.directions(u, z);
        let radius = self.flank.base_radius * u - depth.value * cos_b;
        [radius * e_r - depth.by_roll * n, generator / cos_b - s * self.flank.twist * radius * e_r - depth.by_z * n]
    }

    /// Foot of `p` (mm, gear's own frame) on the **nominal** helicoid, with `distance` + depth there in place of the
    /// distance.
    ///
    /// It is zero exactly on the modified surface. Near it, with g the slope of the depth along the surface and w the
    /// gap, the true distance is w (1 - g^2 / 2) up to w^2 times the curvature of the depth: of a gap of 20 um over a
    /// relief of 20 um in 2 mm, one nanometre. `None` below the base cylinder.
    pub fn locate(&self, p: &Vec3) -> Option<FlankPoint> {
        let foot = self.flank.locate(p)?;
        if self.is_nominal() {
            return Some(foot);
        }
        Some(FlankPoint { distance: foot.distance + self.depth(foot.roll, foot.z).value, ..foot })
    }

    /// Foot as [`ModifiedFlank::locate`] finds it, and the unit normal of the modified surface there.
    pub fn locate_with_normal(&self, p: &Vec3) -> Option<(FlankPoint, Vec3)> {
        let (foot, normal) = self.flank.locate_with_normal(p)?;
        if self.field.is_none() {
            return Some((FlankPoint { distance: foot.distance + self.pitch, ..foot }, normal));
        }
        let distance = foot.distance + self.depth(foot.roll, foot.z).value;
        Some((FlankPoint { distance, ..foot }, self.normal(foot.roll, foot.z)))
    }

    /// Profile direction e_r and direction of the generator, sin(b_b) e_t + cos(b_b) e_z.
    fn directions(&self, u: f64, z: f64) -> (Vec3, Vec3) {
        let (sin, cos) = self.flank.generating_angle(u, z).sin_cos();
        let (sin_b, cos_b) = self.flank.base_helix_angle.sin_cos();
        (Vec3::new(cos, sin, 0.0), Vec3::new(-sin_b * sin, sin_b * cos, cos_b))
    }

    /// Radius of curvature of the offset profile, transverse, mm; kept off zero, where the involute ends in a point.
    fn offset_radius(&self, u: f64, depth: f64) -> f64 {
        let rho = self.flank.base_radius * u - depth * self.flank.base_helix_angle.cos();
        rho.max(1e-9 * self.flank.base_radius)
    }
}
