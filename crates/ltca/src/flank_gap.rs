//! The gap between the two flanks of a pair without load, along the face.

use contact::{Pose, SurfacePair, last_inside};
use geometry::ModifiedFlank;

/// Axial stations at which the least gap is looked at first.
pub(crate) const STATIONS: usize = 41;
/// Dips of the gap along the face that are looked into.
const DIPS: usize = 3;
/// Steps of the golden section in z: the bracket shrinks to a 10^8th.
const GOLDEN_STEPS: usize = 40;

/// Gap between the two flanks of a pair.
pub(crate) struct FlankGap<'a> {
    flanks: &'a [ModifiedFlank; 2],
    poses: &'a [Pose; 2],
    /// Where it dips along the face, the deepest first.
    dips: Vec<Dip>,
}

/// A station whose neighbours are no nearer.
struct Dip {
    z: f64,
    gap: f64,
    lowest: f64,
}

impl<'a> FlankGap<'a> {
    /// At the stations along the face.
    pub fn new(flanks: &'a [ModifiedFlank; 2], poses: &'a [Pose; 2]) -> Self {
        let mut gap = Self { flanks, poses, dips: Vec::new() };
        let half = gap.half_width();
        let z = |i: usize| half * (2.0 * i as f64 / (STATIONS - 1) as f64 - 1.0);
        let gaps: Vec<f64> = (0..STATIONS).map(|i| gap.at(z(i)).map_or(f64::INFINITY, |g| g.1)).collect();
        let dip = |i: usize| {
            let beside = [i.checked_sub(1).and_then(|k| gaps.get(k)), gaps.get(i + 1)];
            let is_dip = gaps[i].is_finite() && beside.iter().flatten().all(|g| gaps[i] <= **g);
            // Towards a station where nothing faces it falls no faster than on the other side; alone, who knows.
            let rises = beside.iter().flatten().map(|g| *g - gaps[i]).filter(|rise| rise.is_finite());
            let rise = rises.reduce(f64::max).unwrap_or(f64::INFINITY);
            is_dip.then(|| Dip { z: z(i), gap: gaps[i], lowest: gaps[i] - 2.0 * rise })
        };
        gap.dips = (0..STATIONS).filter_map(dip).collect();
        gap.dips.sort_by(|a, b| a.gap.total_cmp(&b.gap));
        // A stretch of equal gaps is one dip after another; any of them is as good.
        gap.dips.truncate(DIPS);
        gap
    }

    pub fn half_width(&self) -> f64 {
        self.flanks[0].nominal().half_width
    }

    /// Roll angle of least gap at height `z` of the pinion, and the gap.
    pub fn at(&self, z: f64) -> Option<(f64, f64)> {
        let [first, second] = self.flanks;
        let (f, s) = (first.nominal(), second.nominal());
        // The foot of an end face's point lies on the end face to round-off.
        let end = s.half_width * (1.0 + 1e-9);
        let covers = |[u, z]: [f64; 2]| u >= s.roll_form && u <= s.roll_tip && z.abs() <= end;
        SurfacePair { first, second, poses: self.poses }.least_gap([f.roll_form, f.roll_tip], &covers, z)
    }

    /// What the gap may fall to between the stations: beside each by as much again as it differs from its neighbours,
    /// twice.
    pub fn lowest(&self) -> f64 {
        self.dips.iter().map(|dip| dip.lowest).fold(f64::INFINITY, f64::min)
    }

    /// Least gap over the face and where on the pinion, where it is less than `enough`, mm.
    pub fn nearest_below(&self, enough: f64) -> Option<(f64, [f64; 2])> {
        let mut best: Option<(f64, [f64; 2])> = None;
        for dip in &self.dips {
            if dip.lowest >= best.map_or(enough, |b| b.0) {
                continue;
            }
            let step = 2.0 * self.half_width() / (STATIONS - 1) as f64;
            let half = self.half_width();
            let [from, to] = [(dip.z - step).max(-half), (dip.z + step).min(half)];
            let place = self.golden(self.facing_end(dip.z, from), self.facing_end(dip.z, to));
            for z in [dip.z, place] {
                let found = self.at(z).map(|(u, gap)| (gap, [u, z]));
                best = found.filter(|f| f.0 < best.map_or(enough, |b| b.0)).or(best);
            }
        }
        best
    }

    /// `to`, or the last place on the way there from `from` at which the flanks face each other.
    fn facing_end(&self, from: f64, to: f64) -> f64 {
        if self.at(to).is_some() {
            return to;
        }
        last_inside(|z| self.at(z).is_some(), [from, to], GOLDEN_STEPS, 0.0)
    }

    /// Place of the least gap between `a` and `b`, ends included.
    fn golden(&self, mut a: f64, mut b: f64) -> f64 {
        const RATIO: f64 = 0.618_033_988_749_894_9;
        let gap = |z: f64| self.at(z).map_or(f64::INFINITY, |g| g.1);
        let ends = [(a, gap(a)), (b, gap(b))];
        let (mut x, mut y) = (b - RATIO * (b - a), a + RATIO * (b - a));
        let (mut gx, mut gy) = (gap(x), gap(y));
        for _ in 0..GOLDEN_STEPS {
            if gx <= gy {
                (b, y, gy) = (y, x, gx);
                x = b - RATIO * (b - a);
                gx = gap(x);
            } else {
                (a, x, gx) = (x, y, gy);
                y = a + RATIO * (b - a);
                gy = gap(y);
            }
        }
        let inner = if gx <= gy { (x, gx) } else { (y, gy) };
        // At an end of the flanks the gap may still fall: the end itself is the place then, and no golden section
        // reaches it.
        ends.into_iter().fold(inner, |best, end| if end.1 <= best.1 { end } else { best }).0
    }
}
