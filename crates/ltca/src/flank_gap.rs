//! Gap between two flanks of a pair along the face, and its minimum.

use std::cell::Cell;

use contact::{
    Pose,
    flank::FlankPatch,
    last_inside,
    slice::{RigidFlanks, SliceHint},
};

/// Axial stations at which the least gap is looked at first.
pub(crate) const STATIONS: usize = 41;
/// Dips of the gap along the face that are looked into.
const DIPS: usize = 3;
/// Stretch about a dip of an earlier look in which it is looked for, over that between stations.
const KNOWN: f64 = 1.0 / 16.0;
/// Bisections to the end of what faces the other flank, to a 10^12th of a bracket.
const END_STEPS: usize = 40;

/// Gap between the two flanks of a pair.
pub(crate) struct FlankGap<'a> {
    flanks: RigidFlanks<'a>,
    /// b/2 of both, mm.
    half_widths: [f64; 2],
    /// Normal module, mm: what round-off is a part of.
    module: f64,
    /// Where the last place was found.
    hint: Cell<SliceHint>,
    /// Where it dips along the face, the deepest first.
    dips: Vec<Dip>,
}

/// A station whose neighbours are no nearer.
struct Dip {
    z: f64,
    gap: f64,
    lowest: f64,
    is_known: bool,
}

/// Where a dip is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DipPlace {
    z: f64,
    /// Whether it was looked into, and lies there but for what a small turn moves it by; else it is about this station.
    is_known: bool,
}

impl<'a> FlankGap<'a> {
    /// A gap that has not been evaluated yet; `module` is the normal module, mm.
    pub fn unseen(flanks: &'a [FlankPatch; 2], poses: &'a [Pose; 2], module: f64) -> Self {
        let half_widths = flanks.each_ref().map(|flank| flank.range()[1][1]);
        let flanks = RigidFlanks::new(flanks.each_ref(), poses);
        Self { flanks, half_widths, module, hint: Cell::default(), dips: Vec::new() }
    }

    /// Gap at the stations along the face.
    pub fn new(flanks: &'a [FlankPatch; 2], poses: &'a [Pose; 2], module: f64) -> Self {
        let gap = Self::unseen(flanks, poses, module);
        gap.looked(&[Some([f64::NEG_INFINITY; 2]); STATIONS], 0.0)
    }

    /// Gap at those stations along the face at which the forecast permits a gap as small as `enough`, mm.
    pub fn looked(self, foretold: &[Option<[f64; 2]>], enough: f64) -> Self {
        let mut gap = self;
        let z = |i: usize| gap.station(i);
        let may_be = |i: usize| foretold[i].is_some_and(|[low, _]| low <= enough);
        let gap_at = |i: usize| match foretold[i] {
            Some(_) if may_be(i) => gap.at(z(i)).map_or(f64::INFINITY, |g| g.1),
            Some([low, high]) => 0.5 * (low + high),
            None => f64::INFINITY,
        };
        let gaps: Vec<f64> = (0..STATIONS).map(gap_at).collect();
        let dip = |i: usize| {
            let beside = [i.checked_sub(1), Some(i + 1).filter(|k| *k < STATIONS)];
            let beside = || beside.iter().flatten();
            // What was not looked at is higher, whatever stands for its gap here.
            let is_dip = may_be(i) && gaps[i].is_finite() && beside().all(|&k| !may_be(k) || gaps[i] <= gaps[k]);
            // Towards a station where nothing faces it falls no faster than on the other side; alone, who knows.
            let rises = beside().map(|&k| (gaps[k] - gaps[i]).abs()).filter(|rise| rise.is_finite());
            let rise = rises.reduce(f64::max).unwrap_or(f64::INFINITY);
            is_dip.then(|| Dip { z: z(i), gap: gaps[i], lowest: gaps[i] - 2.0 * rise, is_known: false })
        };
        let dips = (0..STATIONS).filter_map(dip).collect();
        gap.dips = dips;
        gap.dips.sort_by(|a, b| a.gap.total_cmp(&b.gap));
        // A stretch of equal gaps is one dip after another; any of them is as good.
        gap.dips.truncate(DIPS);
        gap
    }

    pub fn half_width(&self) -> f64 {
        self.half_widths[0]
    }

    /// Gap at the minima that an earlier search at nearly the same poses found to be the deepest.
    pub fn seen(flanks: &'a [FlankPatch; 2], poses: &'a [Pose; 2], module: f64, places: &[DipPlace]) -> Self {
        let dip = |&DipPlace { z, is_known }: &DipPlace| Dip {
            z,
            gap: f64::NEG_INFINITY,
            lowest: f64::NEG_INFINITY,
            is_known,
        };
        Self { dips: places.iter().map(dip).collect(), ..Self::unseen(flanks, poses, module) }
    }

    /// Positions of the minima that may reach a given gap. If stations predict more minima than were found, those of
    /// `found` are used.
    pub fn dips_below(&self, gap: f64, found: Option<f64>) -> Vec<DipPlace> {
        let step = 2.0 * self.half_width() / (STATIONS - 1) as f64;
        let holds = |dip: &&Dip| dip.lowest <= gap || found.is_some_and(|z| (dip.z - z).abs() <= step);
        self.dips.iter().filter(holds).map(|&Dip { z, is_known, .. }| DipPlace { z, is_known }).collect()
    }

    /// Roll angle of the smallest gap at height `z` of the pinion, and the gap.
    pub fn at(&self, z: f64) -> Option<(f64, f64)> {
        let mut hint = self.hint.get();
        let (roll, gap, foot) = self.flanks.least_gap(z, &mut hint)?;
        self.hint.set(hint);
        // The foot of an end face's point lies on the end face to round-off.
        let end = self.half_widths[1] * (1.0 + 1e-9);
        (foot[1].abs() <= end).then_some((roll, gap))
    }

    /// First-order bounds of the gap at the stations; `None` where the flank faces nothing.
    pub fn foretold(&self) -> Vec<Option<[f64; 2]>> {
        (0..STATIONS).map(|i| self.flanks.foretold(self.station(i))).collect()
    }

    /// Station with the smallest predicted gap, and that gap.
    pub fn told_least(&self, foretold: &[Option<[f64; 2]>]) -> Option<(f64, f64, &Self)> {
        let told = foretold.iter().enumerate().filter_map(|(i, told)| Some((i, (*told)?)));
        let least = told.map(|(i, [low, high])| (i, 0.5 * (low + high))).min_by(|a, b| a.1.total_cmp(&b.1));
        least.filter(|(_, gap)| gap.is_finite()).map(|(i, gap)| (self.station(i), gap, self))
    }

    fn station(&self, i: usize) -> f64 {
        self.half_width() * (2.0 * i as f64 / (STATIONS - 1) as f64 - 1.0)
    }

    /// Lower bound of the gap between the stations: near each station the gap may fall by twice its difference from its
    /// neighbours.
    pub fn lowest(&self) -> f64 {
        self.dips.iter().map(|dip| dip.lowest).fold(f64::INFINITY, f64::min)
    }

    /// Smallest gap over the face and its position on the pinion, if it is less than `enough`, mm. Accurate to
    /// round-off, or to a nanometre on the `first` search.
    pub fn nearest_below(&mut self, enough: f64, first: bool) -> Option<(f64, [f64; 2])> {
        let round_off = self.module / if first { FIRST_ROUND_OFF } else { ROUND_OFF };
        let mut best: Option<(f64, [f64; 2])> = None;
        for i in 0..self.dips.len() {
            let dip = &self.dips[i];
            if dip.lowest >= best.map_or(enough, |b| b.0) {
                continue;
            }
            let half = self.half_width();
            let step = 2.0 * half / (STATIONS - 1) as f64 * if dip.is_known { KNOWN } else { 1.0 };
            let [from, to] = [(dip.z - step).max(-half), (dip.z + step).min(half)];
            let mut seen = Best::default();
            let z = self.least_between([from, to], dip.z, round_off, &mut seen);
            // A dip that has left the place where it was known is looked for all over its stations.
            let at_end = (z == from && from > -half) || (z == to && to < half);
            let has_left = dip.is_known && (at_end || seen.0.is_none());
            if has_left {
                let wide = [(dip.z - step / KNOWN).max(-half), (dip.z + step / KNOWN).min(half)];
                self.least_between(wide, dip.z, round_off, &mut seen);
            }
            let found = seen.0;
            if let Some((gap, [_, z])) = found {
                self.dips[i] = Dip { z, gap, lowest: gap, is_known: true };
            }
            best = found.filter(|f| f.0 < best.map_or(enough, |b| b.0)).or(best);
        }
        best
    }

    /// `to`, or the last place on the way there from `from` at which the flanks face each other, and the least gap
    /// there with its roll angle.
    fn facing_end(&self, from: f64, to: f64) -> (f64, Option<(f64, f64)>) {
        if let Some(found) = self.at(to) {
            return (to, Some(found));
        }
        let end = last_inside(|z| self.at(z).is_some(), [from, to], END_STEPS, 0.0);
        (end, self.at(end))
    }

    /// Place of the least gap between two heights, from one between them; everything seen on the way goes into `best`.
    fn least_between(&self, [from, to]: [f64; 2], within: f64, round_off: f64, best: &mut Best) -> f64 {
        let ends = [from, to].map(|end| {
            let (z, found) = self.facing_end(within, end);
            (z, best.and(z, found))
        });
        least(|z| best.and(z, self.at(z)), ends, within, round_off)
    }
}

/// The least gap seen so far, and its roll angle and height.
#[derive(Debug, Default)]
struct Best(Option<(f64, [f64; 2])>);

impl Best {
    /// Notes what is seen at a height; its gap, infinite where nothing is faced.
    fn and(&mut self, z: f64, seen: Option<(f64, f64)>) -> f64 {
        let Some((u, gap)) = seen else { return f64::INFINITY };
        if self.0.is_none_or(|(least, _)| gap < least) {
            self.0 = Some((gap, [u, z]));
        }
        gap
    }
}

/// Evaluations before the least value is taken as it is.
const LEAST_STEPS: usize = 80;
/// Bracket of the place of the least value, over the first one.
const PLACE: f64 = 1e-8;
/// Part of a bracket by which an end is looked beside.
const AT_END: f64 = 1e-6;
/// Differences between gaps that are round-off, as one part in so many of the normal module: 2e-15 mm at 3 mm.
const ROUND_OFF: f64 = 1.5e15;
/// Round-off of a first search, which a finer one follows, as one part in so many of the normal module: a tenth of a
/// nanometre at 3 mm.
const FIRST_ROUND_OFF: f64 = 3e7;

/// Place of the least value of `f` between two ends with known values, these included, from a place within: Brent's
/// method (Algorithms for minimization without derivatives, 1973, chapter 5), parabolas where they serve, golden
/// sections where they do not, begun with the parabola through all three.
fn least(mut f: impl FnMut(f64) -> f64, of_ends: [(f64, f64); 2], within: f64, round_off: f64) -> f64 {
    const GOLDEN: f64 = 0.381_966_011_250_105_1;
    let [mut a, mut b] = of_ends.map(|(z, _)| z);
    let tolerance = PLACE * (b - a);
    let known = f(within);
    // The least value so far, the second and the third.
    let mut three = [(within, known), of_ends[0], of_ends[1]];
    if of_ends[1].1 < of_ends[0].1 {
        three.swap(1, 2);
    }
    let is_bracket = three.iter().all(|(_, value)| value.is_finite() && *value >= known) && a < within && within < b;
    if !is_bracket {
        three = [(within, known); 3];
    }
    // An end from which it rises at once.
    let lowest = if of_ends[1].1 < of_ends[0].1 { 1 } else { 0 };
    let (end, value) = of_ends[lowest];
    if value <= known && f(end + AT_END * (of_ends[1 - lowest].0 - end)) >= value {
        return end;
    }
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
    of_ends.into_iter().fold(three[0], |best, end| if end.1 < best.1 { end } else { best }).0
}
