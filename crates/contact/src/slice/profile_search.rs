//! Search for the smallest gap of two profiles at a height of body 1. Theory (35).

use nalgebra::{Matrix3, Vector3};

use crate::{
    Pose, Vec3,
    bracketing::{bracket_zero, last_inside},
    flank::FlankPatch,
    slice::SliceHint,
    slice::first_order::{FirstOrderGap, Outlook},
};

/// Two flank patches, with body 1's points in body 2's frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProfilePair<'a> {
    pub patches: [&'a FlankPatch; 2],
    turn: Matrix3<f64>,
    shift: Vector3<f64>,
    /// Whether both profiles are arcs without relief, one of which may be hollow and is then the flatter one: the gap then has one minimum, and Newton's method finds it.
    single: bool,
    /// The gap to first order, of flanks that nearly touch.
    guide: Option<FirstOrderGap>,
}

/// Point of least gap, by what bounds it: the zero of the gap's slope, an edge or a kink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum LeastGapPoint {
    /// Flank against flank, at this roll angle of the searched body.
    Inside(f64),
    /// The searched body's own end (tip edge or root form circle).
    OwnEnd(f64),
    /// The other flank ends here: its edge presses on the searched body.
    OtherEnd(f64),
    /// A kink of the other flank, where a linear relief begins: it presses as an edge does.
    OtherKink(f64),
}

/// A place on the searched profile: roll angle, slope of the gap there (mm), roll angle of its foot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub roll: f64,
    pub slope: f64,
    pub foot: f64,
}

impl Place {
    pub fn of(roll: f64, sample: &GapSample) -> Self {
        Self { roll, slope: sample.slope, foot: sample.foot[0] }
    }
}

/// A place, with what is seen there where that is known.
pub(super) type Found = (LeastGapPoint, Option<GapSample>);

/// Gap at a point of body 1's profile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GapSample {
    /// Gap along the normal of body 2, mm.
    pub gap: f64,
    /// n_2 . dx_1/du, mm.
    pub slope: f64,
    /// Surface coordinates of the foot on body 2.
    pub foot: [f64; 2],
    /// Square of |dx_1/du|, mm^2.
    pub stretch: f64,
    /// The point of body 1, and the unit normal out of body 2 at its foot, in body 2's frame.
    pub point: Vec3,
    pub normal: Vec3,
}

/// How far beyond an end face of body 2 a foot point may lie, as a share of its width: foot points move by gap times
/// sin(b_b).
const BEYOND: f64 = 1e-3;
/// Lengths of a profile by which flanks overlap at the most; twice that is more than a tooth is thick.
const DEEPEST: f64 = 2.0;
/// Sample points along a profile on which the gap may have several minima.
const SCAN: usize = 16;
/// Steps down to a dip before a bracket is closed; four are enough where there is no kink.
const DESCENT_STEPS: usize = 8;
/// Strides that a dip may lie from where it was told to be.
const FARTHEST: f64 = 3.0;
/// Newton steps before the scan takes over; four are enough.
const NEWTON_STEPS: usize = 24;
/// Roll angles nearer than this count as equal, rad: shorter steps are round-off.
pub(super) const RESOLUTION: f64 = 1e-13;
/// After a longer step than this the gap is sampled again, rad: the slope is not yet linear.
pub(super) const NEAR: f64 = 1e-6;
/// After a longer first step than this the gap is sampled again, rad: the curvatures give the slope's derivative to a
/// per cent.
const NEAR_AT_ONCE: f64 = 1e-8;
/// Steps as short as this change no gap, rad.
const SAME_PLACE: f64 = 1e-11;
/// Bisections to the end of the part of a profile that faces the other; some fifty reach round-off.
const BISECTIONS: usize = 100;

impl LeastGapPoint {
    /// Roll angle on the searched body.
    pub fn roll(self) -> f64 {
        let (Self::Inside(u) | Self::OwnEnd(u) | Self::OtherEnd(u) | Self::OtherKink(u)) = self;
        u
    }
}

impl<'a> ProfilePair<'a> {
    pub fn new(patches: [&'a FlankPatch; 2], poses: [&Pose; 2]) -> Self {
        let rolls = patches.map(|patch| patch.range().map(|[u, _]| u));
        let guide = FirstOrderGap::new(patches.map(FlankPatch::surface), rolls, poses);
        Self { guide, ..Self::unguided(patches, poses) }
    }

    /// Two patches without guidance, to evaluate known points.
    pub fn unguided(patches: [&'a FlankPatch; 2], poses: [&Pose; 2]) -> Self {
        let relative = poses[1].inverse() * poses[0];
        Self {
            patches,
            turn: relative.rotation.to_rotation_matrix().into_inner(),
            shift: relative.translation.vector,
            single: patches.iter().all(|patch| patch.surface().is_single_arc()),
            guide: None,
        }
    }

    /// A point of body 1's flank in body 2's frame.
    pub fn in_frame_of_second(&self, at: [f64; 2]) -> Vec3 {
        self.turn * self.patches[0].surface().point(at) + self.shift
    }

    /// Gap and its slope along the profile; `None` if the point has no foot point on body 2.
    pub fn sample(&self, at: [f64; 2]) -> Option<GapSample> {
        let [point, tangent] = self.patches[0].surface().point_and_profile(at);
        let point = self.turn * point + self.shift;
        let (foot, normal) = self.patches[1].surface().locate_with_normal(&point)?;
        let slope = normal.dot(&(self.turn * tangent));
        let stretch = tangent.norm_squared();
        Some(GapSample { gap: foot.distance, slope, foot: foot.at, stretch, point, normal })
    }

    pub(super) fn rolls(&self, body: usize) -> [f64; 2] {
        let [[low, _], [high, _]] = self.patches[body].range();
        [low, high]
    }

    /// First-order bounds of the smallest gap at height `z` (mm); `None` if the flank faces nothing. Unbounded where
    /// the first-order approximation does not hold.
    pub fn foretold(&self, z: f64) -> Option<[f64; 2]> {
        let anything = [f64::NEG_INFINITY, f64::INFINITY];
        let Some(guide) = self.dips() else { return Some(anything) };
        match guide.look(self.patches.map(FlankPatch::surface), z, f64::INFINITY) {
            None => Some(anything),
            Some(Outlook::NotFaced) => None,
            Some(Outlook::Wider(least)) => Some([least, f64::INFINITY]),
            Some(Outlook::Dips(dips)) => Some(dips.gap),
        }
    }

    /// Point of smallest gap at height `z` (mm) of body 1, and the gap there. `None` if the flanks do not face each
    /// other: the surfaces extend beyond their flanks, and a point deep behind one of them belongs to another side of
    /// the gear, such as a tooth on the far side.
    pub fn nearest_point(&self, z: f64, hint: &mut SliceHint) -> Option<(LeastGapPoint, GapSample)> {
        self.nearest_within(z, hint, f64::INFINITY)
    }

    /// Point of smallest gap at height `z` (mm) of body 1, and the gap there, if it is at most `reach` (mm). The
    /// position of a wider gap is not always searched.
    pub fn nearest_within(&self, z: f64, hint: &mut SliceHint, reach: f64) -> Option<(LeastGapPoint, GapSample)> {
        let (point, sample) = self.search(z, hint.roll, reach)?;
        hint.roll = Some(point.roll());
        let sample = sample.map_or_else(|| self.sample([point.roll(), z]), Some)?;
        if sample.gap < -DEEPEST * self.patches[1].profile_length() {
            return None;
        }
        // Gears displaced along their axes face each other on a part of their width only.
        let [[_, low], [_, high]] = self.patches[1].range();
        let slack = BEYOND * (high - low);
        (sample.foot[1] >= low - slack && sample.foot[1] <= high + slack).then_some((point, sample))
    }

    /// Point of least gap at height `z` of body 1, with the gap where that is known; `near` is a roll angle to start
    /// from.
    fn search(&self, z: f64, near: Option<f64>, reach: f64) -> Option<Found> {
        if self.single
            && let Ok(found) = self.newton_search(z, near, reach)
        {
            return found;
        }
        if let Some(guide) = self.dips()
            && let Ok(found) = self.guided_search(guide, z, near, reach)
        {
            return found;
        }
        self.scan_search(z).map(|point| (point, None))
    }

    /// Whether both are plain helicoids on parallel axes that nearly touch.
    pub fn is_plain(&self) -> bool {
        self.single && self.guide.as_ref().is_some_and(FirstOrderGap::is_parallel)
    }

    /// Where dips may be, of modified flanks that nearly touch.
    fn dips(&self) -> Option<&FirstOrderGap> {
        self.guide.as_ref().filter(|_| !self.single)
    }

    /// The deepest of the dips that the gap to first order tells of. `Err` where the flanks are not as it says.
    fn guided_search(&self, guide: &FirstOrderGap, z: f64, near: Option<f64>, reach: f64) -> Result<Option<Found>, ()> {
        let dips = match guide.look(self.patches.map(FlankPatch::surface), z, reach).ok_or(())? {
            Outlook::NotFaced | Outlook::Wider(_) => return Ok(None),
            Outlook::Dips(dips) => dips,
        };
        let several = dips.rolls().len() > 1;
        let mut best: Option<(Found, f64)> = None;
        for &start in dips.rolls() {
            let Some((point, sample)) = self.descend(guide, z, (start, near), reach)? else { continue };
            let sample = if several && sample.is_none() { self.sample([point.roll(), z]) } else { sample };
            let gap = sample.map_or(f64::INFINITY, |s| s.gap);
            if best.is_none_or(|(_, least)| gap < least) {
                best = Some(((point, sample), gap));
            }
        }
        Ok(best.map(|(found, _)| found))
    }

    /// The dip that a place belongs to: Newton's method on the slope of the gap, then the secant method, unless it is at a
    /// kink, and a bracket where they do not settle. `near`: where the dip may be, if it is about there.
    fn descend(
        &self,
        guide: &FirstOrderGap,
        z: f64,
        (start, near): (f64, Option<f64>),
        reach: f64,
    ) -> Result<Option<Found>, ()> {
        let [[low, high], [other_low, other_high]] = [self.rolls(0), self.rolls(1)];
        let stride = guide.stride_at(start);
        let mut u = near.filter(|u| (u - start).abs() <= stride).unwrap_or(start).clamp(low, high);
        let (mut below, mut above) = (None::<Place>, None::<Place>);
        let mut before: Option<[f64; 2]> = None;
        let mut looked_at_kinks = false;
        for _ in 0..DESCENT_STEPS {
            let sample = self.sample([u, z]).ok_or(())?;
            let slope = sample.slope;
            let here = Place::of(u, &sample);
            *(if slope < 0.0 { &mut below } else { &mut above }) = Some(here);
            let mut at_kink = None;
            if before.is_none() {
                at_kink = self.least_near_kink(z, here, [&mut below, &mut above]);
            }
            if let (Some(a), Some(b), None, false) = (below, above, at_kink, looked_at_kinks) {
                looked_at_kinks = true;
                let mut between = [a, b];
                at_kink = self.least_at_kink(z, &mut between);
                [below, above] = between.map(Some);
            }
            if let Some(point) = at_kink {
                let sample = self.sample([point.roll(), z]).ok_or(())?;
                return self.within_other(z, (point, Some(sample)), &sample, reach);
            }
            if (slope < 0.0 && u >= high) || (slope > 0.0 && u <= low) {
                return self.within_other(z, (LeastGapPoint::OwnEnd(u), Some(sample)), &sample, reach);
            }
            // Downhill is further beyond the end of the other profile.
            let foot = sample.foot[0];
            let falls = if self.has_ring() { -slope } else { slope };
            if (falls > 0.0 && foot > other_high) || (falls < 0.0 && foot < other_low) {
                return self.within_other(z, (LeastGapPoint::Inside(u), None), &sample, reach);
            }
            let secant = before.map(|[v, s]| (slope - s) / (u - v)).filter(|h| *h > 0.0 && h.is_finite());
            let step = -slope / secant.unwrap_or_else(|| guide.slope_derivative(u, z));
            if !step.is_finite() {
                return Err(());
            }
            let near_enough = match before {
                Some([v, _]) => step.abs() <= NEAR && (step * (u - v)).abs() <= RESOLUTION,
                None => step.abs() <= SAME_PLACE,
            };
            if near_enough {
                let is_there = step.abs() <= SAME_PLACE;
                let point = LeastGapPoint::Inside(if is_there { u } else { u + step });
                return self.within_other(z, (point, is_there.then_some(sample)), &sample, reach);
            }
            before = Some([u, slope]);
            let next = (u + step.clamp(-stride, stride)).clamp(low, high);
            if let (Some(Place { roll: a, .. }), Some(Place { roll: b, .. })) = (below, above)
                && !(next > a.min(b) && next < a.max(b))
            {
                break;
            }
            // Another dip than the one that was told of.
            if (next - start).abs() > FARTHEST * stride {
                return Err(());
            }
            u = next;
        }
        let (Some(a), Some(b)) = (below, above) else { return Err(()) };
        let mut failed = false;
        let slope = |u: f64| self.sample([u, z]).map_or_else(|| (failed = true, 0.0).1, |s| s.slope);
        let ends = bracket_zero(slope, [a.roll, b.roll], [a.slope, b.slope]);
        let point = self.between(z, ends).filter(|_| !failed).ok_or(())?;
        let sample = self.sample([point.roll(), z]).ok_or(())?;
        self.within_other(z, (point, Some(sample)), &sample, reach)
    }

    /// Newton's method on the slope of the gap, then the secant method. The derivative of the slope is the relative
    /// curvature times the tangent's length squared.
    ///
    /// Between convex arcs slope and foot point are monotonous. So the foot point at the zero of the slope tells which
    /// end of a profile, if any, comes before it. `Err` where that does not hold.
    fn newton_search(&self, z: f64, near: Option<f64>, reach: f64) -> Result<Option<Found>, ()> {
        if self.guide.as_ref().is_some_and(|guide| guide.is_wider(z, reach)) {
            return Ok(None);
        }
        let [low, high] = self.rolls(0);
        // On parallel axes the place is known in closed form, and one look sees the gap there.
        let known = self.guide.as_ref().and_then(|guide| guide.touch(z));
        let mut u = known.or(near).unwrap_or(0.5 * (low + high)).clamp(low, high);
        let (mut below, mut above) = (None::<f64>, None::<f64>);
        let mut before: Option<(f64, f64)> = None;
        let mut found = None;
        for _ in 0..NEWTON_STEPS {
            let sample = self.sample([u, z]).ok_or(())?;
            if sample.slope < 0.0 {
                below = Some(u)
            } else {
                above = Some(u)
            }
            let at_end = (sample.slope < 0.0 && u >= high) || (sample.slope > 0.0 && u <= low);
            if at_end {
                found = Some((u, sample, true, true));
                break;
            }
            let secant = before.map(|(v, s)| (sample.slope - s) / (u - v)).filter(|h| *h > 0.0 && h.is_finite());
            let derivative = secant.unwrap_or_else(|| self.slope_derivative([u, z], &sample));
            let step = -sample.slope / derivative;
            if !step.is_finite() {
                return Err(());
            }
            if step.abs() <= SAME_PLACE {
                found = Some((u, sample, true, false));
                break;
            }
            // The error after a secant step is about the product of the last two steps.
            let near_enough = match before {
                Some((v, _)) => step.abs() <= NEAR && (step * (u - v)).abs() <= RESOLUTION,
                None => step.abs() <= NEAR_AT_ONCE,
            };
            if near_enough {
                found = Some((u + step, sample, false, false));
                break;
            }
            let mut next = (u + step).clamp(low, high);
            if let (Some(a), Some(b)) = (below, above)
                && !(next > a.min(b) && next < a.max(b))
            {
                next = 0.5 * (a + b);
                if (b - a).abs() <= RESOLUTION {
                    found = Some((next, sample, false, false));
                    break;
                }
            }
            before = Some((u, sample.slope));
            u = next;
        }
        let (u, sample, is_there, at_end) = found.ok_or(())?;
        let point = if at_end { LeastGapPoint::OwnEnd(u) } else { LeastGapPoint::Inside(u) };
        self.within_other(z, (point, is_there.then_some(sample)), &sample, reach)
    }

    /// Whether one of the flanks is a ring's.
    pub(super) fn has_ring(&self) -> bool {
        self.patches.iter().any(|patch| patch.is_hollow())
    }

    /// d slope / du where flanks touch, mm.
    fn slope_derivative(&self, at: [f64; 2], sample: &GapSample) -> f64 {
        let [first, second] = self.patches.map(FlankPatch::surface);
        sample.stretch * (first.curvature(at) + second.curvature(sample.foot))
    }

    /// Search for any profiles: the sample of least gap, its neighbours as a bracket, and the zero of the slope in it.
    fn scan_search(&self, z: f64) -> Option<LeastGapPoint> {
        let [low, high] = self.rolls(0);
        let [other_low, other_high] = self.rolls(1);
        let is_faced = |foot: f64| foot >= other_low && foot <= other_high;
        let sample = |u: f64| self.sample([u, z]);
        let faces_at = |u: f64| sample(u).is_some_and(|l| is_faced(l.foot[0]));
        let step = (high - low) / (SCAN - 1) as f64;
        let at = |i: usize| (low + step * i as f64).min(high);
        let of = |i: usize| {
            self.patches[1].surface().locate(&self.in_frame_of_second([at(i), z])).filter(|f| is_faced(f.at[0]))
        };
        let (_, nearest) = (0..SCAN).filter_map(|i| Some((of(i)?.distance, i))).min_by(|a, b| a.0.total_cmp(&b.0))?;
        // Bracket: the neighbours, or where the facing part of the profile ends before them.
        let end = |neighbour: f64| {
            if faces_at(neighbour) {
                return (neighbour, false);
            }
            (last_inside(faces_at, [at(nearest), neighbour], BISECTIONS, f64::EPSILON), true)
        };
        let (a, cut_a) = end(at(nearest.saturating_sub(1)));
        let (b, cut_b) = end(at((nearest + 1).min(SCAN - 1)));
        let slope = |u: f64| sample(u).map_or(0.0, |l| l.slope);
        let stop = |u: f64, cut: bool| {
            // The other flank ends at its tip, or at its root form circle, which is no edge.
            let hollow = self.patches[1].is_hollow();
            let at_tip = sample(u).is_some_and(|l| (2.0 * l.foot[0] > other_low + other_high) != hollow);
            if cut && at_tip { LeastGapPoint::OtherEnd(u) } else { LeastGapPoint::OwnEnd(u) }
        };
        let slopes = [slope(a), slope(b)];
        if slopes[0] >= 0.0 {
            return Some(stop(a, cut_a));
        }
        if slopes[1] <= 0.0 {
            return Some(stop(b, cut_b));
        }
        self.between(z, bracket_zero(slope, [a, b], slopes))
    }
}
