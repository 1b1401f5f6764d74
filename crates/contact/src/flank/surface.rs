//! Smooth surfaces of bodies in contact.

use crate::Vec3;

/// Foot point on a smooth surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// Surface coordinates of the foot point.
    pub at: [f64; 2],
    /// Signed distance of the point from the surface, mm; positive outside the material. If the surface has a
    /// [`Surface::depth`], it is the distance from the nominal surface plus the depth at the foot point.
    pub distance: f64,
}

/// A smooth surface in its body's own frame.
pub trait Surface: Send + Sync + std::fmt::Debug {
    /// Point at surface coordinates, mm.
    fn point(&self, at: [f64; 2]) -> Vec3;
    /// Unit normal, pointing out of the material.
    fn normal(&self, at: [f64; 2]) -> Vec3;
    /// Derivative of the point by the first surface coordinate.
    fn profile_tangent(&self, at: [f64; 2]) -> Vec3;
    /// [`Surface::point`] and [`Surface::profile_tangent`] together.
    fn point_and_profile(&self, at: [f64; 2]) -> [Vec3; 2] {
        [self.point(at), self.profile_tangent(at)]
    }
    /// [`Surface::locate`] and the unit normal at the foot point.
    fn locate_with_normal(&self, p: &Vec3) -> Option<(Foot, Vec3)> {
        self.locate(p).map(|foot| (foot, self.normal(foot.at)))
    }
    /// Curvature across the contact line, 1/mm; convex positive.
    fn curvature(&self, at: [f64; 2]) -> f64;
    /// Foot point of `p`; `None` if there is none.
    fn locate(&self, p: &Vec3) -> Option<Foot>;
    /// Depth of the surface below the nominal one, mm, along the nominal normal. Meshes are made from the nominal
    /// surface, so their nodes lie on it and not on this surface.
    fn depth(&self, _at: [f64; 2]) -> f64 {
        0.0
    }
    /// [`Surface::depth`] at several points, given by their first and second surface coordinates, mm.
    fn depths(&self, [first, second]: [&[f64]; 2], depths: &mut [f64]) {
        depths.iter_mut().zip(first).zip(second).for_each(|((depth, &u), &z)| *depth = self.depth([u, z]));
    }
    /// Foot point of `p` on the nominal surface.
    fn locate_nominal(&self, p: &Vec3) -> Option<Foot> {
        self.locate(p)
    }
    /// Unit normal and unit profile direction of the nominal surface, without micro-geometry. They are smooth even
    /// where the micro-geometry has kinks.
    fn nominal_frame(&self, at: [f64; 2]) -> [Vec3; 2] {
        let (normal, profile) = (self.normal(at), self.profile_tangent(at));
        let along = profile - normal * normal.dot(&profile);
        [normal, along / along.norm().max(f64::MIN_POSITIVE)]
    }
    /// Whether every profile is one smooth convex arc. Then the gap to another such profile has a single minimum, and
    /// any descent method finds it.
    fn is_single_arc(&self) -> bool {
        false
    }
    /// The involute helicoid from which [`Surface::depth`] is measured; `None` for other surfaces.
    fn nominal_flank(&self) -> Option<&geometry::Flank> {
        None
    }
    /// The flank with its micro-geometry; `None` for other surfaces.
    fn modified_flank(&self) -> Option<&geometry::ModifiedFlank> {
        None
    }
    /// Smallest [`Surface::depth`] over the flank, mm, accurate to some hundredths of its magnitude.
    fn least_depth(&self) -> f64 {
        0.0
    }
    /// Smallest [`Surface::depth`] at a height, mm, accurate to some hundredths of its magnitude.
    fn least_depth_at(&self, _z: f64) -> f64 {
        self.least_depth()
    }
    /// Roll angles at which [`Surface::depth`] has kinks along the profile.
    fn kinks(&self) -> [Option<f64>; 2] {
        [None; 2]
    }
    /// Depth of the measured flank below this surface at surface coordinates, mm: the deviation of a measured flank
    /// from its smooth part.
    fn deviation(&self, _at: [f64; 2]) -> f64 {
        0.0
    }
    /// Largest magnitude of [`Surface::deviation`], mm.
    fn largest_deviation(&self) -> f64 {
        0.0
    }
    /// What a band of contact sees of the measured flank beside a parabola: [`geometry::ModifiedFlank::beside_parabola`].
    fn beside_parabola(&self, _at: [f64; 2], _distances: &[f64], _sums: &mut [f64]) {}
    /// Half of a typical contact band, mm, over which curvatures of [`Surface::depth`] are averaged; 0 without depth.
    fn band(&self) -> f64 {
        0.0
    }
}

fn foot(f: geometry::FlankPoint) -> Foot {
    Foot { at: [f.roll, f.z], distance: f.distance }
}

/// Surface coordinates of an involute flank are (roll angle, z).
impl Surface for geometry::Flank {
    fn point(&self, [u, z]: [f64; 2]) -> Vec3 {
        geometry::Flank::point(self, u, z)
    }

    fn normal(&self, [u, z]: [f64; 2]) -> Vec3 {
        geometry::Flank::normal(self, u, z)
    }

    fn profile_tangent(&self, [u, z]: [f64; 2]) -> Vec3 {
        self.tangents(u, z)[0]
    }

    fn curvature(&self, [u, _]: [f64; 2]) -> f64 {
        self.curvatures(u)[0]
    }

    fn nominal_frame(&self, [u, z]: [f64; 2]) -> [Vec3; 2] {
        self.frame(u, z)
    }

    fn locate(&self, p: &Vec3) -> Option<Foot> {
        geometry::Flank::locate(self, p).map(foot)
    }

    fn point_and_profile(&self, [u, z]: [f64; 2]) -> [Vec3; 2] {
        geometry::Flank::point_and_profile(self, u, z)
    }

    fn locate_with_normal(&self, p: &Vec3) -> Option<(Foot, Vec3)> {
        geometry::Flank::locate_with_normal(self, p).map(|(f, normal)| (foot(f), normal))
    }

    fn is_single_arc(&self) -> bool {
        true
    }

    fn nominal_flank(&self) -> Option<&geometry::Flank> {
        Some(self)
    }
}

/// Surface coordinates are those of the nominal flank.
impl Surface for geometry::ModifiedFlank {
    fn point(&self, [u, z]: [f64; 2]) -> Vec3 {
        geometry::ModifiedFlank::point(self, u, z)
    }

    fn normal(&self, [u, z]: [f64; 2]) -> Vec3 {
        geometry::ModifiedFlank::normal(self, u, z)
    }

    fn profile_tangent(&self, [u, z]: [f64; 2]) -> Vec3 {
        self.tangents(u, z)[0]
    }

    /// That of the nominal flank and that of the depth, as a band of contact sees it ([`geometry::ModifiedFlank::band`]):
    /// where a relief starts with a kink there is none to be had at a point.
    fn curvature(&self, [u, z]: [f64; 2]) -> f64 {
        let nominal = self.nominal();
        let curvature = nominal.curvatures(u)[0];
        if self.is_offset_helicoid() {
            return curvature;
        }
        let arc = nominal.base_radius * u.max(f64::MIN_POSITIVE);
        let step = self.band() / arc;
        let slope = |u: f64| geometry::ModifiedFlank::depth(self, u, z).by_roll;
        let added = (slope(u + step) - slope(u - step)) / (2.0 * step * arc * arc);
        // A hollow is no Hertzian contact; a tenth of the convexity left keeps its band finite.
        curvature + added.max(-0.9 * curvature.abs())
    }

    fn locate(&self, p: &Vec3) -> Option<Foot> {
        geometry::ModifiedFlank::locate(self, p).map(foot)
    }

    fn point_and_profile(&self, [u, z]: [f64; 2]) -> [Vec3; 2] {
        geometry::ModifiedFlank::point_and_profile(self, u, z)
    }

    fn locate_with_normal(&self, p: &Vec3) -> Option<(Foot, Vec3)> {
        geometry::ModifiedFlank::locate_with_normal(self, p).map(|(f, normal)| (foot(f), normal))
    }

    fn depth(&self, [u, z]: [f64; 2]) -> f64 {
        geometry::ModifiedFlank::depth(self, u, z).value
    }

    fn depths(&self, places: [&[f64]; 2], depths: &mut [f64]) {
        geometry::ModifiedFlank::depths(self, places, depths);
    }

    fn locate_nominal(&self, p: &Vec3) -> Option<Foot> {
        self.nominal().locate(p).map(foot)
    }

    fn nominal_frame(&self, [u, z]: [f64; 2]) -> [Vec3; 2] {
        self.nominal().frame(u, z)
    }

    fn is_single_arc(&self) -> bool {
        self.is_offset_helicoid()
    }

    fn nominal_flank(&self) -> Option<&geometry::Flank> {
        Some(self.nominal())
    }

    fn modified_flank(&self) -> Option<&geometry::ModifiedFlank> {
        Some(self)
    }

    fn least_depth(&self) -> f64 {
        geometry::ModifiedFlank::least_depth(self)
    }

    fn least_depth_at(&self, z: f64) -> f64 {
        geometry::ModifiedFlank::least_depth_at(self, z)
    }

    fn kinks(&self) -> [Option<f64>; 2] {
        geometry::ModifiedFlank::kinks(self)
    }

    fn deviation(&self, [u, z]: [f64; 2]) -> f64 {
        geometry::ModifiedFlank::deviation(self, u, z)
    }

    fn largest_deviation(&self) -> f64 {
        geometry::ModifiedFlank::largest_deviation(self)
    }

    fn beside_parabola(&self, at: [f64; 2], distances: &[f64], sums: &mut [f64]) {
        geometry::ModifiedFlank::beside_parabola(self, at, distances, sums);
    }

    fn band(&self) -> f64 {
        geometry::ModifiedFlank::band(self)
    }
}

/// A solid circular cylinder about an axis parallel to z; surface coordinates are (angle from +x, z).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Centre in the xy plane, mm.
    pub centre: [f64; 2],
    /// Radius, mm.
    pub radius: f64,
}

impl Surface for Cylinder {
    fn point(&self, [angle, z]: [f64; 2]) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        Vec3::new(self.centre[0] + self.radius * cos, self.centre[1] + self.radius * sin, z)
    }

    fn normal(&self, [angle, _]: [f64; 2]) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        Vec3::new(cos, sin, 0.0)
    }

    fn profile_tangent(&self, [angle, _]: [f64; 2]) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        self.radius * Vec3::new(-sin, cos, 0.0)
    }

    fn curvature(&self, _: [f64; 2]) -> f64 {
        self.radius.recip()
    }

    fn locate(&self, p: &Vec3) -> Option<Foot> {
        let (x, y) = (p.x - self.centre[0], p.y - self.centre[1]);
        let r = x.hypot(y);
        (r > 0.0).then(|| Foot { at: [y.atan2(x), p.z], distance: r - self.radius })
    }
}
