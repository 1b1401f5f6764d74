//! The gap between the two flanks of a pair without load, along the face.

use std::f64::consts::{PI, TAU};

use contact::{Pose, SurfacePair, Vec3, last_inside};
use geometry::{Flank, ModifiedFlank};

/// Axial stations at which the least gap is looked at first.
pub(crate) const STATIONS: usize = 41;
/// Dips of the gap along the face that are looked into.
const DIPS: usize = 3;
/// Bisections to the end of what faces the other flank, to a 10^12th of a bracket.
const END_STEPS: usize = 40;
/// Roll angle to which a station's place of least gap is known before it is looked into, rad: its gap to a nanometre,
/// at a kink to a ten-thousandth of a millimetre.
const FIRST_LOOK: f64 = 1e-5;

/// Gap between the two flanks of a pair.
pub(crate) struct FlankGap<'a> {
    flanks: &'a [ModifiedFlank; 2],
    poses: &'a [Pose; 2],
    /// Where the gap of each station may be least; none where nominal flanks tell nothing.
    guide: Option<Guide>,
    /// Where it dips along the face, the deepest first.
    dips: Vec<Dip>,
}

/// A station whose neighbours are no nearer.
struct Dip {
    z: f64,
    gap: f64,
    lowest: f64,
}

/// Places along the profile at which the gap is looked at to first order.
const SCAN: usize = 24;
/// What the gap to first order may be off by: so much, mm, and this share of what the nominal flanks part by.
const FIRST_ORDER: (f64, f64) = (2e-3, 0.3);

/// Part of a stride by which a place may lie beyond the second flank and still face it.
const NEARLY: f64 = 0.25;

/// The gap to first order: nominal flanks that touch along a line part by their curvature, and depths are added.
///
/// ```text
/// g(u, z) = kappa s^2 / 2 + h_1(u, z) + h_2(u_2, z),   s = r_b1 (u^2 - u_0(z)^2) / 2 = r_b2 (u_2,0(z)^2 - u_2^2) / 2
/// ```
/// Nominal flanks on parallel axes touch where the generating angle of the first is -sigma alpha_w against the line of
/// centres, and both roll angles make up the length between the base circles,
///
/// ```text
/// r_b1 u_0 + r_b2 u_2,0 = a sin(alpha_w)
/// ```
/// It says in which dip the least gap lies; where in it, and how large it is, the flanks themselves say.
struct Guide {
    /// Roll angles of nominal contact at mid-face; they go beyond the flanks as if these went on.
    touch: [f64; 2],
    stride: f64,
}

/// What the gap to first order says of a height.
#[derive(Debug, Clone)]
struct Look {
    /// Where downhill ways to the dips begin that may be the deepest.
    starts: Vec<f64>,
    /// Least gap, mm, and what it may be off by.
    gap: f64,
    doubt: f64,
}

impl Guide {
    fn new(flanks: &[ModifiedFlank; 2], poses: &[Pose; 2]) -> Option<Self> {
        let [first, second] = flanks.each_ref().map(ModifiedFlank::nominal);
        let stride = (first.roll_tip - first.roll_form) / (SCAN - 1) as f64;
        let across = poses[1].translation.vector - poses[0].translation.vector;
        let distance = across.x.hypot(across.y);
        let pressure_angle = ((first.base_radius + second.base_radius) / distance).acos();
        if !(pressure_angle.is_finite() && stride > 0.0) {
            return None;
        }
        let s = first.side.sign();
        let turned = poses[0].rotation * Vec3::x();
        let touching = across.y.atan2(across.x) - s * pressure_angle;
        let at_root = turned.y.atan2(turned.x) + first.generating_angle(0.0, 0.0);
        let middle = 0.5 * (first.roll_form + first.roll_tip);
        let u = middle + (s * (at_root - touching) - middle + PI).rem_euclid(TAU) - PI;
        let u2 = (distance * pressure_angle.sin() - first.base_radius * u) / second.base_radius;
        Some(Self { touch: [u, u2], stride })
    }

    /// What is seen at a height; `None` where nothing is faced.
    fn look(&self, flanks: &[ModifiedFlank; 2], z: f64) -> Option<Look> {
        let [first, second] = flanks.each_ref().map(ModifiedFlank::nominal);
        let [u, u2] = self.touch;
        let u0 = u + first.side.sign() * first.twist * z;
        let u20 = u2 - first.base_radius * (u0 - u) / second.base_radius;
        let arc = |flank: &Flank, u: f64| flank.base_radius * u.max(self.stride);
        let curvature = 1.0 / arc(first, u0) + 1.0 / arc(second, u20);
        let gap = |i: usize| -> Option<[f64; 3]> {
            let u = (first.roll_form + self.stride * i as f64).min(first.roll_tip);
            let s = 0.5 * first.base_radius * (u * u - u0 * u0);
            let u2 = (u20 * u20 - 2.0 * s / second.base_radius).max(0.0).sqrt();
            // What is faced is known to first order as well: to a hundredth of a millimetre where flanks are near.
            let beyond = (second.roll_form - u2).max(u2 - second.roll_tip) * second.base_radius;
            if beyond > NEARLY * self.stride * first.base_radius {
                return None;
            }
            let parted = 0.5 * curvature * s * s;
            Some([u, parted + flanks[0].depth(u, z).value + flanks[1].depth(u2, z).value, parted])
        };
        let all: Vec<Option<[f64; 3]>> = (0..SCAN).map(gap).collect();
        let at = |i: Option<usize>| i.and_then(|i| *all.get(i)?).map_or(f64::INFINITY, |g| g[1]);
        let dips = (0..SCAN).filter_map(|i| {
            let own = all[i]?;
            (own[1] <= at(i.checked_sub(1)) && own[1] <= at(Some(i + 1))).then_some(own)
        });
        let dips: Vec<[f64; 3]> = dips.collect();
        let best = dips.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1]))?;
        let (amount, share) = FIRST_ORDER;
        let may_be = |dip: &&[f64; 3]| dip[1] - best[1] <= amount + share * (dip[2] + best[2]);
        let starts = dips.iter().filter(may_be).map(|dip| dip[0]).collect();
        Some(Look { starts, gap: best[1], doubt: 0.5 * amount + share * best[2] })
    }
}

impl<'a> FlankGap<'a> {
    /// Not looked at yet.
    pub fn unseen(flanks: &'a [ModifiedFlank; 2], poses: &'a [Pose; 2]) -> Self {
        Self { flanks, poses, guide: Guide::new(flanks, poses), dips: Vec::new() }
    }

    /// At the stations along the face.
    pub fn new(flanks: &'a [ModifiedFlank; 2], poses: &'a [Pose; 2]) -> Self {
        let gap = Self::unseen(flanks, poses);
        gap.looked(&[Some([f64::NEG_INFINITY; 2]); STATIONS], 0.0)
    }

    /// At the stations along the face at which the gap may be as small as `enough`, mm, after what is foretold of them.
    pub fn looked(self, foretold: &[Option<[f64; 2]>], enough: f64) -> Self {
        let mut gap = self;
        let z = |i: usize| gap.station(i);
        let may_be = |i: usize| foretold[i].is_some_and(|[low, _]| low <= enough);
        let gap_at = |i: usize| match foretold[i] {
            Some(_) if may_be(i) => gap.at_within(z(i), FIRST_LOOK).map_or(f64::INFINITY, |g| g.1),
            Some([low, high]) => 0.5 * (low + high),
            None => f64::INFINITY,
        };
        let gaps: Vec<f64> = (0..STATIONS).map(gap_at).collect();
        let dip = |i: usize| {
            let beside = [i.checked_sub(1).and_then(|k| gaps.get(k)), gaps.get(i + 1)];
            let is_dip = may_be(i) && gaps[i].is_finite() && beside.iter().flatten().all(|g| gaps[i] <= **g);
            // Towards a station where nothing faces it falls no faster than on the other side; alone, who knows.
            let rises = beside.iter().flatten().map(|g| *g - gaps[i]).filter(|rise| rise.is_finite());
            let rise = rises.reduce(f64::max).unwrap_or(f64::INFINITY);
            is_dip.then(|| Dip { z: z(i), gap: gaps[i], lowest: gaps[i] - 2.0 * rise })
        };
        let dips = (0..STATIONS).filter_map(dip).collect();
        gap.dips = dips;
        gap.dips.sort_by(|a, b| a.gap.total_cmp(&b.gap));
        // A stretch of equal gaps is one dip after another; any of them is as good.
        gap.dips.truncate(DIPS);
        gap
    }

    pub fn half_width(&self) -> f64 {
        self.flanks[0].nominal().half_width
    }

    /// Where an earlier look at nearly the same poses found dips: at these heights, deeper than any other place.
    pub fn seen(flanks: &'a [ModifiedFlank; 2], poses: &'a [Pose; 2], heights: &[f64]) -> Self {
        let dip = |&z: &f64| Dip { z, gap: f64::NEG_INFINITY, lowest: f64::NEG_INFINITY };
        Self { dips: heights.iter().map(dip).collect(), ..Self::unseen(flanks, poses) }
    }

    /// Heights of the dips that may fall to some gap; where stations foretell more than was found, that of `found`.
    pub fn dips_below(&self, gap: f64, found: Option<f64>) -> Vec<f64> {
        let step = 2.0 * self.half_width() / (STATIONS - 1) as f64;
        let holds = |dip: &&Dip| dip.lowest <= gap || found.is_some_and(|z| (dip.z - z).abs() <= step);
        self.dips.iter().filter(holds).map(|dip| dip.z).collect()
    }

    /// Roll angle of least gap at height `z` of the pinion, and the gap.
    pub fn at(&self, z: f64) -> Option<(f64, f64)> {
        self.at_within(z, 0.0)
    }

    /// The same with a roll angle to `within`, rad.
    fn at_within(&self, z: f64, within: f64) -> Option<(f64, f64)> {
        let [first, second] = self.flanks;
        let (f, s) = (first.nominal(), second.nominal());
        // The foot of an end face's point lies on the end face to round-off.
        let end = s.half_width * (1.0 + 1e-9);
        let covers = |[u, z]: [f64; 2]| u >= s.roll_form && u <= s.roll_tip && z.abs() <= end;
        let (pair, range) = (SurfacePair { first, second, poses: self.poses }, [f.roll_form, f.roll_tip]);
        let near = self.guide.as_ref().map(|guide| {
            let look = guide.look(self.flanks, z)?;
            Some(pair.least_gap_near(range, &covers, z, (&look.starts, guide.stride), within))
        });
        match near {
            // Nothing is faced, not even nearly.
            Some(None) => None,
            Some(Some(Some(found))) => Some(found),
            _ => pair.least_gap(range, &covers, z),
        }
    }

    /// Gaps to first order at the stations with what they may be off by, from which to which; `None` where nothing is
    /// faced, or where nominal flanks tell nothing.
    pub fn foretold(&self) -> Vec<Option<[f64; 2]>> {
        // Tilted axes part flanks by as much at the ends of the face; the guide knows nothing of them.
        let axes = self.poses.each_ref().map(|pose| pose.rotation * Vec3::z());
        let tilt = axes[0].cross(&axes[1]).norm() * self.half_width();
        let of_station = |i: usize| {
            let Some(guide) = &self.guide else { return Some([f64::NEG_INFINITY, f64::INFINITY]) };
            let Look { gap, doubt, .. } = guide.look(self.flanks, self.station(i))?;
            Some([gap - doubt - tilt, gap + doubt + tilt])
        };
        (0..STATIONS).map(of_station).collect()
    }

    fn station(&self, i: usize) -> f64 {
        self.half_width() * (2.0 * i as f64 / (STATIONS - 1) as f64 - 1.0)
    }

    /// What the gap may fall to between the stations: beside each by as much again as it differs from its neighbours,
    /// twice.
    pub fn lowest(&self) -> f64 {
        self.dips.iter().map(|dip| dip.lowest).fold(f64::INFINITY, f64::min)
    }

    /// Least gap over the face and where on the pinion, where it is less than `enough`, mm: to round-off, or to a
    /// nanometre at the `first` look.
    pub fn nearest_below(&self, enough: f64, first: bool) -> Option<(f64, [f64; 2])> {
        let (within, round_off) = if first { (FIRST_LOOK, FIRST_ROUND_OFF) } else { (0.0, ROUND_OFF) };
        let mut best: Option<(f64, [f64; 2])> = None;
        for dip in &self.dips {
            if dip.lowest >= best.map_or(enough, |b| b.0) {
                continue;
            }
            let step = 2.0 * self.half_width() / (STATIONS - 1) as f64;
            let half = self.half_width();
            let [from, to] = [(dip.z - step).max(-half), (dip.z + step).min(half)];
            let gap = |z: f64| self.at_within(z, within).map_or(f64::INFINITY, |g| g.1);
            let ends = [self.facing_end(dip.z, from), self.facing_end(dip.z, to)];
            let (z, _) = least(gap, ends, dip.z, round_off);
            let found = self.at_within(z, within).map(|(u, gap)| (gap, [u, z]));
            best = found.filter(|f| f.0 < best.map_or(enough, |b| b.0)).or(best);
        }
        best
    }

    /// `to`, or the last place on the way there from `from` at which the flanks face each other.
    fn facing_end(&self, from: f64, to: f64) -> f64 {
        if self.at(to).is_some() {
            return to;
        }
        last_inside(|z| self.at(z).is_some(), [from, to], END_STEPS, 0.0)
    }
}

/// Evaluations before the least value is taken as it is.
const LEAST_STEPS: usize = 80;
/// Bracket of the place of the least value, over the first one.
const PLACE: f64 = 1e-8;
/// Differences between gaps that are round-off, mm.
const ROUND_OFF: f64 = 2e-15;
/// The same at a first look, which another one follows.
const FIRST_ROUND_OFF: f64 = 1e-7;

/// Place and least value of `f` between `ends`, these included, from a place within: Brent's method (Algorithms for
/// minimization without derivatives, 1973, chapter 5): parabolas where they serve, golden sections where they do not.
fn least(f: impl Fn(f64) -> f64, ends: [f64; 2], within: f64, round_off: f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.381_966_011_250_105_1;
    let [mut a, mut b] = ends;
    let tolerance = PLACE * (b - a);
    let known = f(within);
    let of_ends = ends.map(|z| (z, if z == within { known } else { f(z) }));
    // The least value so far, the second and the third.
    let mut three = [(within, known); 3];
    let [mut last, mut before] = [b - a; 2];
    for _ in 0..LEAST_STEPS {
        let [(x, fx), (w, fw), (v, fv)] = three;
        let middle = 0.5 * (a + b);
        let flat = w != x && v != x && v != w && fw - fx <= round_off && fv - fx <= round_off;
        if (x - middle).abs() <= 2.0 * tolerance - 0.5 * (b - a) || flat {
            break;
        }
        // The lowest point of the parabola through all three.
        let (r, q) = ((x - w) * (fx - fv), (x - v) * (fx - fw));
        let (p, q) = ((x - v) * q - (x - w) * r, 2.0 * (q - r));
        let way = -p / q;
        let serves = way.is_finite() && way.abs() < 0.5 * before.abs() && x + way > a && x + way < b;
        let step = if serves { way } else { GOLDEN * if x < middle { b - x } else { a - x } };
        (before, last) = (if serves { last } else { step / GOLDEN }, step);
        let at = x + if step.abs() >= tolerance { step } else { tolerance.copysign(step) };
        let found = f(at);
        if found <= fx {
            if at < x {
                b = x
            } else {
                a = x
            }
            three = [(at, found), (x, fx), (w, fw)];
        } else {
            if at < x {
                a = at
            } else {
                b = at
            }
            if found <= fw || w == x {
                three = [(x, fx), (at, found), (w, fw)];
            } else if found <= fv || v == x || v == w {
                three[2] = (at, found);
            }
        }
    }
    // At an end the value may still fall: the end itself is the place then.
    of_ends.into_iter().fold(three[0], |best, end| if end.1 < best.1 { end } else { best })
}
