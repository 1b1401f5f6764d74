//! A slice at which two smooth flanks touch: derivatives of its position, gap and directions by small changes of depths
//! and poses. Theory (77a).

use geometry::modification::{Depth, DepthRate};

use super::flank_pair::{FlankPair, Slice};
use crate::{Pose, Vec3, flank::Surface, local::LocalContact, nodal::ContactRow};

/// Motion of a body per unit of a parameter, common axes: velocity of its frame's origin (mm) and turn (rad).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Motion {
    pub shift: Vec3,
    pub turn: Vec3,
}

/// How a row follows a parameter, forces held, per unit of it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RowRate {
    /// Gap, mm.
    pub gap: f64,
    /// Surface coordinates on both flanks.
    pub at: [[f64; 2]; 2],
    /// What of the opening is along each direction of the tables of both gears.
    pub openings: [[f64; 3]; 2],
    /// What of the load is.
    pub loads: [[f64; 3]; 2],
    /// Moments of a unit force about both axes, friction included, mm.
    pub levers: [f64; 2],
    /// Local approach under the force, mm.
    pub approach: f64,
    /// Largest pressure under the force, MPa.
    pub pressure: f64,
}

/// Step of surface coordinates for slopes of normals, tangents, curvatures and local laws; rad, and mm of height.
const STEP: f64 = 1e-7;
/// Slope of the gap over the tangent that a place of contact between smooth flanks has no more than.
const LEVEL: f64 = 1e-6;
/// What slopes either way may differ by where there is no kink.
const KINK: f64 = 1e-5;

/// Local laws at the places beside a slice: along the profile of either flank, along the second one's face, and with
/// another radius of curvature; each less and more.
pub(super) const BESIDE: usize = 8;

/// The geometry of a slice, common axes.
#[derive(Debug)]
pub(super) struct SmoothSlice {
    position: Vec3,
    normal: Vec3,
    /// dx_1/du, mm.
    tangent: Vec3,
    /// Nominal normals, directions of the profiles, and what is across both, of both flanks.
    frames: [[Vec3; 3]; 2],
    axes: [Vec3; 2],
    origins: [Vec3; 2],
    at: [[f64; 2]; 2],
    flanks: [FlankSize; 2],
    /// Depth of the second flank at the foot.
    depth: Depth,
    /// How distance, roll angle and height of the foot follow the point.
    foot: [Vec3; 3],
    /// How the foot's follow the roll angle on body 1.
    foot_by_roll: [f64; 3],
    /// Derivatives of the normal by both coordinates of the foot.
    normal_by: [Vec3; 2],
    /// Derivative of the gap's slope by the roll angle, mm.
    slope_by_roll: f64,
    /// Derivatives of both curvatures by roll angle, and of the second by height.
    curvature_by: [f64; 3],
    pub radius: f64,
}

/// What formulas take of an involute flank.
#[derive(Debug, Clone, Copy)]
struct FlankSize {
    side: f64,
    base_radius: f64,
    twist: f64,
    sin_b: f64,
    cos_b: f64,
    /// Half of a usual band, mm; 0 of a flank that nothing is ground off.
    band: f64,
    /// Whether the curvature follows that of the depth.
    follows: bool,
}

impl FlankSize {
    fn of(surface: &dyn Surface, at: [f64; 2]) -> Option<Self> {
        let flank = surface.nominal_flank()?;
        let (sin_b, cos_b) = flank.base_helix_angle.sin_cos();
        let nominal = flank.curvatures(at[0])[0];
        Some(Self {
            side: flank.side.sign(),
            base_radius: flank.base_radius,
            twist: flank.twist,
            sin_b,
            cos_b,
            band: surface.band(),
            // As much of a hollow as is left convex follows nothing.
            follows: surface.curvature(at) - nominal > -0.9 * nominal.abs() * (1.0 - 1e-9),
        })
    }

    /// Turn of the flank's directions about its axis by rates of its coordinates.
    fn turn(&self, [u, z]: [f64; 2]) -> f64 {
        self.twist * z - self.side * u
    }
}

/// Slope of a vector between three places, `STEP` apart; `None` over a kink.
fn slope([less, here, more]: [Vec3; 3], size: f64) -> Option<Vec3> {
    let bend = (less + more - 2.0 * here).norm();
    (bend <= KINK * STEP * size).then(|| (more - less) / (2.0 * STEP))
}

impl SmoothSlice {
    /// `None` if an edge or a kink touches, or if a flank deviates from its smooth surface.
    pub fn new(pair: &FlankPair<'_>, poses: &[Pose; 2], row: &ContactRow, slice: &Slice) -> Option<Self> {
        let surfaces = pair.surfaces();
        if slice.local.deviation.is_some() || slice.local.edge_opening() != 0.0 || slice.local.off_line != 0.0 {
            return None;
        }
        let at = slice.at;
        let flanks = [FlankSize::of(surfaces[0], at[0])?, FlankSize::of(surfaces[1], at[1])?];
        let turned = |b: usize, v: Vec3| poses[b].rotation * v;
        let beside = |by: f64| [at[0][0] + by, at[0][1]];
        let tangent_at = |by: f64| surfaces[0].point_and_profile(beside(by))[1];
        let tangents = [tangent_at(-STEP), tangent_at(0.0), tangent_at(STEP)];
        let tangent = turned(0, tangents[1]);
        if row.normal.dot(&tangent).abs() > LEVEL * tangent.norm() {
            return None;
        }
        let normal_at = |k: usize, by: f64| {
            let mut place = at[1];
            place[k] += by;
            surfaces[1].normal(place)
        };
        let own_normal = normal_at(0, 0.0);
        let normal_slope = |k: usize| slope([normal_at(k, -STEP), own_normal, normal_at(k, STEP)], 1.0);
        let normal_by = [turned(1, normal_slope(0)?), turned(1, normal_slope(1)?)];
        let tangent_by_roll = turned(0, slope(tangents, flanks[0].base_radius.abs())?);
        let frames = [0, 1].map(|b| {
            let [normal, along] = surfaces[b].nominal_frame(at[b]).map(|v| turned(b, v));
            [normal, along, normal.cross(&along)]
        });
        let axes = poses.map(|pose| pose.rotation * Vec3::z());
        let seen = poses[1].inverse_transform_point(&row.position.into()).coords;
        let second = &flanks[1];
        let reach = seen.x * seen.x + seen.y * seen.y - second.base_radius * second.base_radius;
        if reach <= 0.0 {
            return None;
        }
        let w = reach.sqrt().copysign(second.base_radius);
        let outward = turned(1, Vec3::new(seen.x, seen.y, 0.0) / w);
        let foot = [
            frames[1][0],
            (outward - second.cos_b * frames[1][0]) / second.base_radius,
            axes[1] + second.side * second.sin_b * frames[1][0],
        ];
        let foot_by_roll = foot.map(|f| f.dot(&tangent));
        let slope_by_roll = (normal_by[0] * foot_by_roll[1] + normal_by[1] * foot_by_roll[2]).dot(&tangent)
            + row.normal.dot(&tangent_by_roll);
        let curvature = |b: usize, k: usize| {
            let of = |by: f64| {
                let mut place = at[b];
                place[k] += by;
                surfaces[b].curvature(place)
            };
            (of(STEP) - of(-STEP)) / (2.0 * STEP)
        };
        (slope_by_roll > 0.0).then(|| Self {
            position: row.position,
            normal: row.normal,
            tangent,
            frames,
            axes,
            origins: poses.map(|pose| pose.translation.vector),
            at,
            flanks,
            depth: surfaces[1].modified_flank().map(|f| f.depth(at[1][0], at[1][1])).unwrap_or_default(),
            foot,
            foot_by_roll,
            normal_by,
            slope_by_roll,
            curvature_by: [curvature(0, 0), curvature(1, 0), curvature(1, 1)],
            radius: slice.local.radius,
        })
    }

    /// Local contacts next to this one, for differences.
    pub fn beside(&self, pair: &FlankPair<'_>, local: &LocalContact) -> [LocalContact; BESIDE] {
        std::array::from_fn(|i| {
            let by = if i % 2 == 0 { -1.0 } else { 1.0 };
            let mut other = local.clone();
            match i / 2 {
                0 => other.bodies[0] = pair.layer(0, [self.at[0][0] + by * STEP, self.at[0][1]]),
                1 => other.bodies[1] = pair.layer(1, [self.at[1][0] + by * STEP, self.at[1][1]]),
                2 => other.bodies[1] = pair.layer(1, [self.at[1][0], self.at[1][1] + by * STEP]),
                _ => other.radius *= 1.0 + by * STEP,
            }
            other
        })
    }

    /// Derivatives of the row from those of both depths, under motions of both bodies; `None` if a depth has none.
    /// `approaches` are those of [`SmoothSlice::beside`] under the row's force, mm; `pressure` is that under this
    /// force.
    pub fn rate(
        &self,
        motions: &[Motion; 2],
        depths: [Option<&DepthRate>; 2],
        approaches: &[f64; BESIDE],
        pressure: f64,
    ) -> Option<(RowRate, RowMotion)> {
        let ground = |b: usize| match depths[b] {
            Some(rate) => rate.at(self.at[b][0], self.at[b][1]),
            None => Some(Depth::default()),
        };
        let [first, second] = [ground(0)?, ground(1)?];
        let [m1, m2] = motions;
        let [along_1, along_2] = [0, 1].map(|b| {
            let m = &motions[b];
            m.shift + m.turn.cross(&(self.position - self.origins[b]))
        });
        let own_1 = along_1 - first.value * self.frames[0][0];
        let seen = self.foot.map(|f| f.dot(&(own_1 - along_2)));
        let tilt = self.tilt(&second);
        let tangent_rate = (m1.turn - m2.turn).cross(&self.tangent)
            - first.value * self.flanks[0].cos_b * self.frames[0][1]
            - first.by_roll * self.frames[0][0];
        let normal_seen = |foot: [f64; 3]| self.normal_by[0] * foot[1] + self.normal_by[1] * foot[2];
        let slope = (normal_seen(seen) + tilt).dot(&self.tangent) + self.normal.dot(&tangent_rate);
        let roll = -slope / self.slope_by_roll;
        let foot: [f64; 3] = std::array::from_fn(|k| seen[k] + self.foot_by_roll[k] * roll);
        let normal = m2.turn.cross(&self.normal) + normal_seen(foot) + tilt;
        let position = own_1 + self.tangent * roll;
        let at = [[roll, 0.0], [foot[1], foot[2]]];
        let ground_curvature = self.ground_curvature(0, depths[0])? + self.ground_curvature(1, depths[1])?;
        let curvature = self.curvature_by[0] * roll
            + self.curvature_by[1] * foot[1]
            + self.curvature_by[2] * foot[2]
            + ground_curvature;
        let by_radius = -self.radius * curvature;
        let by = [roll, foot[1], foot[2], by_radius];
        let approach = (0..4).map(|k| by[k] * (approaches[2 * k + 1] - approaches[2 * k]) / (2.0 * STEP)).sum();
        let motion = RowMotion { position, normal, at };
        let openings = [0, 1].map(|b| self.parts_rate(b, motions, &motion, [&self.normal, &normal]));
        let rate = RowRate {
            gap: foot[0] + second.value + self.depth.by_roll * foot[1] + self.depth.by_z * foot[2],
            at,
            openings,
            loads: openings,
            levers: self.levers(motions, &position, &normal),
            approach,
            pressure: -0.5 * pressure * by_radius,
        };
        Some((rate, motion))
    }

    /// Rate of the second flank's normal by that of its depth, common axes.
    fn tilt(&self, rate: &Depth) -> Vec3 {
        let FlankSize { side, base_radius, twist, cos_b, .. } = self.flanks[1];
        let [normal, along, across] = &self.frames[1];
        let radius = base_radius * self.at[1][0] - self.depth.value * cos_b;
        let by_profile = (rate.by_roll + self.depth.by_roll * cos_b * rate.value / radius) / radius;
        let by_generator = cos_b * (rate.by_z + side * twist * rate.by_roll);
        // The generator is -s times what is across normal and profile.
        let raw = along * by_profile - across * (side * by_generator);
        (raw - self.normal * self.normal.dot(&raw)) * normal.dot(&self.normal)
    }

    /// Rate of a flank's curvature by that of its depth, as a band of contact sees it, 1/mm.
    fn ground_curvature(&self, b: usize, depth: Option<&DepthRate>) -> Option<f64> {
        let FlankSize { base_radius, band, follows, .. } = self.flanks[b];
        let Some(depth) = depth else { return Some(0.0) };
        if band == 0.0 {
            return None;
        }
        if !follows {
            return Some(0.0);
        }
        let [u, z] = self.at[b];
        let arc = base_radius * u;
        let step = band / arc;
        Some((depth.at(u + step, z)?.by_roll - depth.at(u - step, z)?.by_roll) / (2.0 * step * arc * arc))
    }

    /// Derivative of the components of a direction of body 1's force along the directions of body `b`.
    pub fn parts_rate(
        &self,
        b: usize,
        motions: &[Motion; 2],
        moved: &RowMotion,
        [direction, rate]: [&Vec3; 2],
    ) -> [f64; 3] {
        let turn = motions[b].turn + self.axes[b] * self.flanks[b].turn(moved.at[b]);
        let sign = [1.0, -1.0][b];
        self.frames[b].map(|e| sign * (turn.cross(&e).dot(direction) + e.dot(rate)))
    }

    /// Rates of the levers of a force along the normal, mm.
    fn levers(&self, motions: &[Motion; 2], position: &Vec3, normal: &Vec3) -> [f64; 2] {
        [0, 1].map(|b| {
            let (motion, axis) = (&motions[b], &self.axes[b]);
            let arm = self.position - self.origins[b];
            let moved = (position - motion.shift).cross(&self.normal) + arm.cross(normal);
            let turned = arm.cross(&self.normal).dot(&motion.turn.cross(axis));
            [1.0, -1.0][b] * (moved.dot(axis) + turned)
        })
    }
}

/// Rates of position and normal of a row, common axes, and of its surface coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowMotion {
    pub position: Vec3,
    pub normal: Vec3,
    pub at: [[f64; 2]; 2],
}
