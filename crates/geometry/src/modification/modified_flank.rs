//! The flank as manufactured: helicoid minus depth. Theory (28), (29).

use std::sync::Arc;

use super::{Depth, DepthField, SplitDepth};
use crate::{Flank, FlankPoint, Vec3, flank::Directions};

/// One flank with its micro-geometry, in its gear's own frame. Surface coordinates are those of the nominal helicoid.
///
/// ```text
/// X(u, z) = P(u, z) - h(u, z) n(u, z)
/// ```
/// P and n are the nominal point and normal; h is the depth, positive where material is removed.
#[derive(Debug, Clone, PartialEq)]
pub struct ModifiedFlank {
    flank: Flank,
    field: Option<Arc<DepthField>>,
    /// Smooth part and deviation of a measured flank, where contact takes them apart; depths are then the smooth part's.
    split: Option<SplitDepth>,
    /// Depth by which this tooth stands back because of its pitch error, mm.
    pitch: f64,
}

impl From<Flank> for ModifiedFlank {
    fn from(flank: Flank) -> Self {
        Self { flank, field: None, split: None, pitch: 0.0 }
    }
}

impl ModifiedFlank {
    pub(crate) fn new(flank: Flank, field: Option<Arc<DepthField>>, pitch: f64) -> Self {
        Self { flank, field, split: None, pitch }
    }

    /// This flank with its measured form split: its depth becomes the smooth part, and [`ModifiedFlank::deviation`] the
    /// rest, averaged over slices of axial length `slice` (mm; 0: points). A flank that was not measured does not
    /// change.
    #[must_use]
    pub fn split(mut self, slice: f64) -> Self {
        self.split = self.field.as_ref().and_then(|field| DepthField::split(field, slice));
        self
    }

    /// Depth of the flank below the surface given by [`ModifiedFlank::depth`], mm, normal to it; 0 unless the flank was
    /// split.
    pub fn deviation(&self, u: f64, z: f64) -> f64 {
        self.split.as_ref().map_or(0.0, |split| split.deviation(u, z))
    }

    /// What a band of contact about (`u`, `z`) sees beside the depth and the curvature of the smooth surface there: the
    /// measured form at distances x (mm) along the profile either way, even part, added to `sums` (mm).
    ///
    /// ```text
    /// d(x) = mean over both ways of deviation(x) + f_s(x) - f_s(0) - x f_s'(0) - c x^2/2,   c: mean of f_s'' over -band .. band
    /// ```
    /// Within the profile; beyond its ends the value there. Nothing unless the flank was split.
    pub fn beside_parabola(&self, [u, z]: [f64; 2], distances: &[f64], sums: &mut [f64]) {
        let Some(split) = &self.split else { return };
        let base = self.flank.base_radius;
        let arc = base * u.max(f64::MIN_POSITIVE);
        let step = self.band() / arc;
        let slope = |u: f64| split.smooth_form(u, z)[1];
        let curvature = (slope(u + step) - slope(u - step)) / (2.0 * step * arc * arc);
        let [here, by_roll, _] = split.smooth_form(u, z);
        for (sum, x) in sums.iter_mut().zip(distances) {
            let both = [*x, -x].map(|x| {
                let to = (u * u + 2.0 * x / base).max(0.0).sqrt();
                let to = split.within(to);
                let x = 0.5 * base * (to * to - u * u);
                let parabola = here + x * (by_roll / arc + 0.5 * curvature * x);
                split.deviation(to, z) + split.smooth_form(to, z)[0] - parabola
            });
            *sum += 0.5 * (both[0] + both[1]);
        }
    }

    /// Largest magnitude of [`ModifiedFlank::deviation`], mm.
    pub fn largest_deviation(&self) -> f64 {
        self.split.as_ref().map_or(0.0, SplitDepth::largest_deviation)
    }

    /// Fields of flanks that differ in nothing else; `None` of others.
    pub(super) fn fields<const N: usize>(flanks: [&Self; N]) -> Option<[&DepthField; N]> {
        let first = flanks.first()?;
        let alike = |f: &&Self| f.flank == first.flank && f.pitch == first.pitch && f.field.is_some();
        if !flanks.iter().all(alike) {
            return None;
        }
        let fields: Vec<&DepthField> = flanks.iter().filter_map(|f| f.field.as_deref()).collect();
        fields.try_into().ok()
    }

    /// The nominal helicoid.
    pub fn nominal(&self) -> &Flank {
        &self.flank
    }

    /// Depth at roll angle `u` and height `z` (mm), pitch error included, with first derivatives.
    pub fn depth(&self, u: f64, z: f64) -> Depth {
        let mut depth = match (&self.split, &self.field) {
            (Some(split), _) => split.smooth(u, z),
            (None, Some(field)) => field.at(u, z),
            (None, None) => Depth::default(),
        };
        depth.value += self.pitch;
        depth
    }

    /// Depths at several points, pitch error included, mm. `places` are roll angles and heights (mm). The values equal
    /// those of [`ModifiedFlank::depth`] bit by bit.
    pub fn depths(&self, places: [&[f64]; 2], depths: &mut [f64]) {
        match (&self.split, &self.field) {
            (Some(split), _) => split.smooth_at_places(places, depths),
            (None, Some(field)) => field.at_places(places, depths),
            (None, None) => depths.fill(0.0),
        }
        depths.iter_mut().for_each(|depth| *depth += self.pitch);
    }

    /// Least depth over the flank, pitch error included, mm: see [`DepthField::least`].
    pub fn least_depth(&self) -> f64 {
        let of_field = || self.field.as_ref().map_or(0.0, |f| f.least());
        self.pitch + self.split.as_ref().map_or_else(of_field, SplitDepth::least)
    }

    /// Least depth at a height (mm), pitch error included, mm: see [`DepthField::least_at`].
    pub fn least_depth_at(&self, z: f64) -> f64 {
        match (&self.split, &self.field) {
            (Some(split), _) => self.pitch + split.least(),
            (None, field) => self.pitch + field.as_ref().map_or(0.0, |field| field.least_at(z)),
        }
    }

    /// Roll angles at which the profile has kinks: the starts of linear root and tip reliefs.
    pub fn kinks(&self) -> [Option<f64>; 2] {
        self.field.as_ref().map_or([None; 2], |field| field.kinks())
    }

    /// Half of a typical contact band, mm: see [`DepthField::band`]; 0 for an unmodified flank.
    pub fn band(&self) -> f64 {
        self.field.as_ref().map_or(0.0, |f| f.band())
    }

    /// Whether the flank is a plain helicoid, possibly rotated by a pitch error: no modification varies along it.
    pub fn is_offset_helicoid(&self) -> bool {
        self.field.is_none()
    }

    fn is_nominal(&self) -> bool {
        self.field.is_none() && self.pitch == 0.0
    }

    /// Surface point, mm.
    pub fn point(&self, u: f64, z: f64) -> Vec3 {
        if self.is_nominal() {
            return self.flank.point(u, z);
        }
        let frame = self.flank.directions(u, z);
        self.flank.point_at(u, z, &frame) - self.depth(u, z).value * frame.normal
    }

    /// Unit normal of the modified surface, pointing out of the tooth.
    ///
    /// The nominal normal tilted by the slope of the depth:
    /// ```text
    /// N ~ n + g_1 e_r + g_2 l,   g_1 = h_u / (r_b u - h cos b_b),   g_2 = cos(b_b) (h_z + s k h_u)
    /// ```
    /// e_r is the profile direction, l the direction of the generator. Both are tangent to the nominal flank.
    pub fn normal(&self, u: f64, z: f64) -> Vec3 {
        let frame = self.flank.directions(u, z);
        if self.field.is_none() {
            return frame.normal;
        }
        self.tilted(u, &frame, &self.depth(u, z))
    }

    /// The normal where the depth is known.
    fn tilted(&self, u: f64, frame: &Directions, depth: &Depth) -> Vec3 {
        let s = self.flank.side.sign();
        let [_, cos_b] = self.flank.base_helix();
        // Kept off zero, where the involute ends in a point.
        let (base, sign) = (self.flank.base_radius, self.flank.base_radius.signum());
        let radius = sign * (sign * (base * u - depth.value * cos_b)).max(1e-9 * base.abs());
        let along = depth.by_roll / radius;
        let across = cos_b * (depth.by_z + s * self.flank.twist * depth.by_roll);
        (frame.normal + along * frame.profile + across * frame.generator).normalize()
    }

    /// Surface point (mm) and its derivative by roll angle (mm).
    pub fn point_and_profile(&self, u: f64, z: f64) -> [Vec3; 2] {
        if self.is_nominal() {
            return self.flank.point_and_profile(u, z);
        }
        let frame = self.flank.directions(u, z);
        let depth = self.depth(u, z);
        let radius = self.flank.base_radius * u - depth.value * self.flank.base_helix()[1];
        let point = self.flank.point_at(u, z, &frame) - depth.value * frame.normal;
        [point, radius * frame.profile - depth.by_roll * frame.normal]
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
        let Directions { normal, profile, generator } = self.flank.directions(u, z);
        let depth = self.depth(u, z);
        let (s, [_, cos_b]) = (self.flank.side.sign(), self.flank.base_helix());
        let radius = self.flank.base_radius * u - depth.value * cos_b;
        [
            radius * profile - depth.by_roll * normal,
            generator / cos_b - s * self.flank.twist * radius * profile - depth.by_z * normal,
        ]
    }

    /// Foot point of `p` (mm, the gear's own frame) on the **nominal** helicoid. Its `distance` is the distance from
    /// the helicoid plus the depth there.
    ///
    /// This sum is zero exactly on the modified surface. Near it, with g the slope of the depth along the surface and w
    /// the gap, the true distance is w (1 - g^2 / 2), up to w^2 times the curvature of the depth. For a gap of 20 um
    /// over a relief of 20 um in 2 mm the difference is one nanometre. `None` below the base cylinder.
    pub fn locate(&self, p: &Vec3) -> Option<FlankPoint> {
        let foot = self.flank.locate(p)?;
        if self.is_nominal() {
            return Some(foot);
        }
        Some(FlankPoint { distance: foot.distance + self.depth(foot.roll, foot.z).value, ..foot })
    }

    /// Foot point as in [`ModifiedFlank::locate`], and the unit normal of the modified surface there.
    pub fn locate_with_normal(&self, p: &Vec3) -> Option<(FlankPoint, Vec3)> {
        let (foot, frame) = self.flank.locate_with_directions(p)?;
        if self.field.is_none() {
            return Some((FlankPoint { distance: foot.distance + self.pitch, ..foot }, frame.normal));
        }
        let depth = self.depth(foot.roll, foot.z);
        let distance = foot.distance + depth.value;
        Some((FlankPoint { distance, ..foot }, self.tilted(foot.roll, &frame, &depth)))
    }
}
