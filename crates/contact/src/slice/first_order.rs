//! First-order approximation of the gap along a profile, which tells where it may have minima. Theory (35).

use std::f64::consts::{PI, TAU};

use geometry::Flank;

use crate::{Pose, Vec3, flank::Surface};

/// Strides over the searched profile: dips that are nearer to each other are one.
const STRIDES: f64 = 23.0;
/// What the gap to first order may be off by: one part in so many of half a band of contact, and this share of what the
/// nominal flanks part by.
const OFF_BY: (f64, f64) = (50.0, 0.3);
/// Share of what plain flanks part by to second order that they surely part by.
const SURELY: f64 = 0.9;
/// Part of a stride by which flanks may overlap or be apart, and to which their ends are known.
const NEARLY: f64 = 0.25;
/// Dips that are looked into at the most.
const MOST_DIPS: usize = 6;
/// Places along the profile at the most: one more than strides over all of it.
const MOST_PLACES: usize = 26;

/// Two involute flanks that nearly touch: nominal ones part by their curvature from where they touch, and depths are
/// added.
///
/// ```text
/// g = cos b_b kappa s^2 / 2 + h_1(u_1, z) + h_2(u_2, z)
/// s = r_b1 (u_1^2 - u_10(z)^2) / 2 = r_b2 (u_20(z)^2 - u_2^2) / 2,   kappa = 1/(r_b1 u_10) + 1/(r_b2 u_20)
/// ```
/// r_b of a ring and the distance to it are negative.
///
/// Nominal flanks on parallel axes touch where the generating angle of the first is -sigma alpha_w against the line of
/// centres, and both roll angles make up the length between the base circles, r_b1 u_10 + r_b2 u_20 = a sin(alpha_w).
/// What is left of it by the second flank as it stands is the gap between them.
///
/// It says in which dip the least gap lies; where in it, and how large it is, the flanks themselves say.
#[derive(Debug, Clone, Copy)]
pub(super) struct FirstOrderGap {
    base_radius: [f64; 2],
    /// Roll angles [low, high] of both flanks.
    rolls: [[f64; 2]; 2],
    /// Roll angles of nominal contact at the first one's mid-face; they go beyond the flanks as if these went on.
    touch: [f64; 2],
    /// Change of the first flank's roll angle of nominal contact with height, rad/mm.
    twist: f64,
    /// Height of the second one's mid-face over the first one's, mm.
    offset: f64,
    cos_base_helix: f64,
    /// Distance between places, mm along the first flank's arc in its middle.
    stride: f64,
    /// Gap of the nominal flanks at mid-face, mm.
    apart: f64,
    /// What tilted axes may add to it or take from it anywhere on the flanks, mm.
    tilted: f64,
    /// Least sum of both depths, mm.
    shallowest: f64,
    /// What the gap to first order may be off by whatever the nominal flanks part by, mm.
    amount: f64,
}

/// Where the gap may be least at a height.
#[derive(Debug, Clone, Copy)]
pub(super) enum Outlook {
    /// The flanks face each other nowhere.
    NotFaced,
    /// No gap is less than this, mm.
    Wider(f64),
    /// Dips begin near these roll angles of the first flank.
    Dips(Dips),
}

/// Roll angles, ascending.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Dips {
    /// The gap in the deepest, from which to which, mm.
    pub gap: [f64; 2],
    rolls: [f64; MOST_DIPS],
    count: usize,
}

impl Dips {
    pub fn rolls(&self) -> &[f64] {
        &self.rolls[..self.count]
    }
}

/// A place along the profile: s, gap to first order, what the nominal flanks part by.
type Place = [f64; 3];

impl FirstOrderGap {
    /// `None` for surfaces that are not involutes, and for flanks whose overlap or distance exceeds the range of the
    /// first-order approximation.
    pub fn new(surfaces: [&dyn Surface; 2], rolls: [[f64; 2]; 2], poses: [&Pose; 2]) -> Option<Self> {
        let [first, second] = [surfaces[0].nominal_flank()?, surfaces[1].nominal_flank()?];
        let across = poses[1].translation.vector - poses[0].translation.vector;
        // Where one of them is a ring's the distance is negative, and contact is beyond the other axis, as seen from it.
        let sign = first.base_radius.signum() * second.base_radius.signum();
        let distance = sign * across.x.hypot(across.y);
        let pressure_angle = ((first.base_radius + second.base_radius) / distance).acos();
        let line = (sign * across.y).atan2(sign * across.x);
        let s = first.side.sign();
        // Both touch the line of action at the same turn from the line of centres, seen from their own centres.
        let at = |(flank, z): (&Flank, f64), pose: &Pose, [low, high]: [f64; 2], line: f64| {
            let axis = pose.rotation * Vec3::x();
            let root = axis.y.atan2(axis.x) + flank.generating_angle(0.0, z);
            let middle = 0.5 * (low + high);
            middle + (s * (root - line) + pressure_angle - middle + PI).rem_euclid(TAU) - PI
        };
        // At the height of the first one's mid-face.
        let offset = across.z;
        let [u1, own] =
            [at((first, 0.0), poses[0], rolls[0], line), at((second, -offset), poses[1], rolls[1], line + PI)];
        let length = distance * pressure_angle.sin() - first.base_radius * u1;
        let [low, high] = rolls[0];
        let stride = first.base_radius.abs() * 0.5 * (high * high - low * low) / STRIDES;
        let cos_base_helix = first.base_helix_angle.cos();
        let apart = cos_base_helix * (length - second.base_radius * own);
        let axes = poses.map(|pose| pose.rotation * Vec3::z());
        // Their end faces rise with the radius, and helical flanks with them.
        let tip =
            |i: usize, flank: &Flank| flank.base_radius.abs() * 1f64.hypot(rolls[i][0].abs().max(rolls[i][1].abs()));
        let rise = tip(0, first).max(tip(1, second)) * first.base_helix_angle.sin().abs();
        let tilted = axes[0].cross(&axes[1]).norm() * (2.0 * (first.half_width + offset.abs()) + rise);
        let serves = stride > 0.0 && first.side == second.side && apart.abs() + tilted <= NEARLY * stride;
        serves.then(|| Self {
            base_radius: [first.base_radius, second.base_radius],
            rolls,
            touch: [u1, length / second.base_radius],
            twist: s * first.twist,
            offset,
            cos_base_helix,
            stride,
            apart,
            tilted,
            shallowest: surfaces.map(Surface::least_depth).iter().sum(),
            amount: surfaces.map(Surface::band).into_iter().fold(0.0, f64::max) / OFF_BY.0,
        })
    }

    /// Angle of a stride at a roll angle of the first flank, rad.
    pub fn stride_at(&self, u: f64) -> f64 {
        self.stride / (self.base_radius[0].abs() * u.max(self.least_roll()))
    }

    fn least_roll(&self) -> f64 {
        0.1 * self.rolls[0][1]
    }

    /// Derivative of the gap's slope by u at a roll angle of the first flank, for nominal flanks, mm.
    pub fn slope_derivative(&self, u: f64, z: f64) -> f64 {
        let arc = self.base_radius[0] * u;
        arc * arc * self.curvature(self.touch_at(z)) * self.cos_base_helix
    }

    /// Roll angle of the first flank's nominal contact at a height (mm), exact for parallel axes; `None` for others.
    pub fn touch(&self, z: f64) -> Option<f64> {
        self.is_parallel().then_some(self.touch[0] + self.twist * z)
    }

    /// Whether the axes are parallel.
    pub fn is_parallel(&self) -> bool {
        self.tilted == 0.0
    }

    fn touch_at(&self, z: f64) -> [f64; 2] {
        let moved = self.twist * z;
        [self.touch[0] + moved, self.touch[1] - self.base_radius[0] * moved / self.base_radius[1]]
    }

    /// Relative transverse curvature where nominal flanks touch, 1/mm.
    fn curvature(&self, touch: [f64; 2]) -> f64 {
        let arc = |i: usize| self.base_radius[i] * touch[i].max(0.1 * self.rolls[i][1]);
        1.0 / arc(0) + 1.0 / arc(1)
    }

    /// Where both profiles face each other at a height (mm), as arcs of the first one from the place of touch, and the
    /// squares of the roll angles of that place: `Err` where they face each other nowhere, if that is sure.
    fn faced(&self, touch: [f64; 2]) -> Result<([f64; 2], [f64; 2]), bool> {
        let [r1, r2] = self.base_radius;
        // Arcs from the place of touch, going on where the involute has ended.
        let square = touch.map(|u| u * u.abs());
        let ends = self.rolls.map(|ends| ends.map(|u| u * u));
        let mut own = ends[0].map(|u| 0.5 * r1 * (u - square[0]));
        let mut other = ends[1].map(|u| 0.5 * r2 * (square[1] - u));
        // Arcs count the other way along a ring's profile.
        if r1 < 0.0 {
            own.reverse();
        }
        if r2 > 0.0 {
            other.reverse();
        }
        let (low, high) = (own[0].max(other[0]), own[1].min(other[1]));
        let slack = NEARLY * self.stride;
        if low.is_nan() || high.is_nan() {
            // Helicoids that touch nowhere near: the search itself says so.
            return Err(false);
        }
        if low > high {
            // To first order the ends are known to a part of a stride.
            return Err(low > high + slack + 0.1 * low.abs().max(high.abs()));
        }
        Ok(([low, high], square))
    }

    /// What nominal flanks part by at the least at an arc from the place of touch, mm: half of the least curvature on the
    /// way times its square. `square`: of the roll angles of that place.
    fn surely_parted(&self, s: f64, square: [f64; 2]) -> f64 {
        if s == 0.0 {
            return 0.0;
        }
        let least = |r: f64, square: [f64; 2]| {
            let [a, b] = square.map(|u| r.abs() * u.max(0.0).sqrt());
            if r > 0.0 { 1.0 / a.max(b) } else { -1.0 / a.min(b) }
        };
        let [r1, r2] = self.base_radius;
        let curvature =
            least(r1, [square[0], square[0] + 2.0 * s / r1]) + least(r2, [square[1], square[1] - 2.0 * s / r2]);
        SURELY * 0.5 * self.cos_base_helix * curvature * s * s
    }

    /// Whether plain helicoids are certainly not nearer than `reach` (mm) at a height (mm). If one of them ends before
    /// the contact position, the gap is at least [`Self::surely_parted`].
    pub fn is_wider(&self, z: f64, reach: f64) -> bool {
        let ([low, high], square) = match self.faced(self.touch_at(z)) {
            Ok(faced) => faced,
            Err(sure) => return sure,
        };
        let parted = self.surely_parted(0f64.clamp(low, high), square);
        self.apart - self.tilted + parted + self.shallowest > reach
    }

    /// The approximation at a height (mm). For gaps wider than `reach` (mm) it says only that they are wider.
    pub fn look(&self, surfaces: [&dyn Surface; 2], z: f64, reach: f64) -> Option<Outlook> {
        let touch = self.touch_at(z);
        let [r1, r2] = self.base_radius;
        let ([low, high], square) = match self.faced(touch) {
            Ok(faced) => faced,
            Err(sure) => return sure.then_some(Outlook::NotFaced),
        };
        let curvature = self.curvature(touch) * self.cos_base_helix;
        let parted = |s: f64| 0.5 * curvature * s * s;
        let (amount, share) = (self.amount, OFF_BY.1);
        let nearest = 0f64.clamp(low, high);
        let heights = [z, z - self.offset];
        let shallowest = surfaces[0].least_depth_at(heights[0]) + surfaces[1].least_depth_at(heights[1]);
        let at_least = |s: f64| ((1.0 - share) * parted(s)).min(self.surely_parted(s, square));
        let least = self.apart - self.tilted + at_least(nearest) + shallowest - 2.0 * amount;
        if least > reach {
            return Some(Outlook::Wider(least));
        }
        let rolls = |s: f64| [(square[0] + 2.0 * s / r1).max(0.0).sqrt(), (square[1] - 2.0 * s / r2).max(0.0).sqrt()];
        let told_of = |s: f64, depths: [f64; 2]| -> Place { [s, parted(s) + depths[0] + depths[1], parted(s)] };
        let told = |p: Place| {
            // Between two places depths may be less than at both.
            let doubt = amount + self.tilted;
            let depths = p[1] - p[2];
            [self.apart + at_least(p[0]) + depths - doubt, self.apart + (1.0 + share) * p[2] + depths + doubt]
        };
        let at = rolls(nearest);
        let here = told_of(nearest, [0, 1].map(|i| surfaces[i].depth([at[i], heights[i]])));
        // No dip is deeper than the least of the depths lets it be.
        let room = (1.0 + share) * here[2] + (here[1] - here[2]) - shallowest + 2.0 * amount;
        let window = (2.0 * room.max(0.0) / ((1.0 - share) * curvature)).sqrt();
        let (low, high) = (low.max(-window), high.min(window));
        let mut dips = Dips::default();
        let strides = ((high - low) / self.stride).ceil().max(1.0);
        if strides <= 1.0 {
            (dips.rolls[0], dips.count, dips.gap) = (rolls(nearest)[0], 1, told(here));
            return Some(Outlook::Dips(dips));
        }
        let count = (strides as usize + 1).min(MOST_PLACES);
        let mut arcs = [0.0; MOST_PLACES];
        let [mut at, mut depths] = [[[0.0; MOST_PLACES]; 2]; 2];
        let [u1, u2] = &mut at;
        for (i, ((s, u1), u2)) in arcs[..count].iter_mut().zip(u1).zip(u2).enumerate() {
            *s = low + (high - low) * i as f64 / (count - 1) as f64;
            [*u1, *u2] = rolls(*s);
        }
        for i in 0..2 {
            surfaces[i].depths([&at[i][..count], &[heights[i]; MOST_PLACES][..count]], &mut depths[i][..count]);
        }
        let mut places = [[0.0; 3]; MOST_PLACES];
        for (i, place) in places[..count].iter_mut().enumerate() {
            *place = told_of(arcs[i], [depths[0][i], depths[1][i]]);
        }
        let places = &places[..count];
        let is_dip = |i: usize| {
            let beside = [i.checked_sub(1).map(|k| places[k]), places.get(i + 1).copied()];
            beside.iter().flatten().all(|p| places[i][1] <= p[1])
        };
        let best = places.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1]))?;
        dips.gap = told(best);
        let may_be = |p: &Place| p[1] - best[1] <= amount + share * (p[2] + best[2]);
        for (_, p) in places.iter().enumerate().filter(|(i, p)| is_dip(*i) && may_be(p)) {
            if dips.count == MOST_DIPS {
                return None;
            }
            dips.rolls[dips.count] = rolls(p[0])[0];
            dips.count += 1;
        }
        Some(Outlook::Dips(dips))
    }
}
