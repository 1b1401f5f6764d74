//! Where two flanks are nearest at an axial station.

use crate::{
    FlankPatch, Pose, Surface,
    bracketing::{bracket_zero, bracket_zero_within, last_inside},
};

/// Places along the profile at which the search starts; one is nearer to the least gap than any other dip.
const SCAN: usize = 24;
/// Bisection steps to the end of the facing part: it is found to round-off.
const BISECTIONS: usize = 60;

/// Two smooth surfaces at the poses of their bodies.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePair<'a> {
    /// Surface of body 1.
    pub first: &'a dyn Surface,
    /// Surface of body 2.
    pub second: &'a dyn Surface,
    /// Poses of both bodies.
    pub poses: &'a [Pose; 2],
}

impl SurfacePair<'_> {
    /// Gap (mm) from the point at `at` of the first surface to the second, and its slope along the profile; `None`
    /// where the foot is not on the second surface (`covers`).
    ///
    /// The slope is n_2 . dx_1/du, n_2 the normal at the foot; both surfaces with their micro-geometry.
    fn gap_and_slope(&self, at: [f64; 2], covers: &dyn Fn([f64; 2]) -> bool) -> Option<(f64, f64)> {
        let [first, second] = self.poses;
        let position = first.transform_point(&self.first.point(at).into());
        let foot = self.second.locate(&second.inverse_transform_point(&position).coords)?;
        if !covers(foot.at) {
            return None;
        }
        let normal = second.rotation * self.second.normal(foot.at);
        let tangent = first.rotation * self.first.profile_tangent(at);
        Some((foot.distance, normal.dot(&tangent)))
    }

    /// First surface coordinate of the place at height `z` (mm), between those of `range`, where the gap is least, and
    /// the gap there, mm; ends of `range` and of what `covers` the second surface (tip edges) included. `None` where no
    /// point of the station faces the second surface.
    ///
    /// The zero of the slope is bracketed by a scan and the bracket closed, so the place is found to round-off and not
    /// to its square root as by comparing gaps. Where a relief starts with a kink the slope jumps; the place of the
    /// jump is found as well.
    pub fn least_gap(&self, range: [f64; 2], covers: &dyn Fn([f64; 2]) -> bool, z: f64) -> Option<(f64, f64)> {
        let [from, to] = range;
        let gap_and_slope = |u: f64| self.gap_and_slope([u, z], covers);
        let step = (to - from) / (SCAN - 1) as f64;
        let at = |i: usize| (from + step * i as f64).min(to);
        let scanned = (0..SCAN).filter_map(|i| Some((gap_and_slope(at(i))?.0, i)));
        let (_, nearest) = scanned.min_by(|a, b| a.0.total_cmp(&b.0))?;
        // Ends of the bracket: the neighbours, or where the facing part of the station ends before them.
        let end = |neighbour: f64| {
            if gap_and_slope(neighbour).is_some() {
                return neighbour;
            }
            last_inside(|u| gap_and_slope(u).is_some(), [at(nearest), neighbour], BISECTIONS, 0.0)
        };
        let (a, b) = (end(at(nearest.saturating_sub(1))), end(at((nearest + 1).min(SCAN - 1))));
        let slope = |u: f64| gap_and_slope(u).map_or(0.0, |g| g.1);
        let slopes = [slope(a), slope(b)];
        let u = if slopes[0] >= 0.0 {
            a
        } else if slopes[1] <= 0.0 {
            b
        } else {
            let [a, b] = bracket_zero(slope, [a, b], slopes);
            0.5 * (a + b)
        };
        Some((u, gap_and_slope(u)?.0))
    }
}

impl SurfacePair<'_> {
    /// As [`SurfacePair::least_gap`], for a caller who knows near which places the gap may be least: from each of them
    /// downhill in strides to the next dip, whose place is found to `within` (0: round-off). `None` where one of them
    /// faces nothing.
    pub fn least_gap_near(
        &self,
        range: [f64; 2],
        covers: &dyn Fn([f64; 2]) -> bool,
        z: f64,
        (starts, stride): (&[f64], f64),
        within: f64,
    ) -> Option<(f64, f64)> {
        let mut best: Option<(f64, f64)> = None;
        for &start in starts {
            let found = self.downhill(range, covers, z, (start, stride), within)?;
            best = Some(found).filter(|f| best.is_none_or(|b| f.1 < b.1)).or(best);
        }
        best
    }

    /// The next dip downhill from a place, and the gap there.
    fn downhill(
        &self,
        range: [f64; 2],
        covers: &dyn Fn([f64; 2]) -> bool,
        z: f64,
        (start, stride): (f64, f64),
        within: f64,
    ) -> Option<(f64, f64)> {
        let gap_and_slope = |u: f64| self.gap_and_slope([u, z], covers);
        // A place that just faces nothing has a neighbour that faces something.
        let near = [start, start - stride, start + stride].map(|u| u.clamp(range[0], range[1]));
        let (mut here, (gap, mut slope)) = near.into_iter().find_map(|u| Some((u, gap_and_slope(u)?)))?;
        if slope == 0.0 {
            return Some((here, gap));
        }
        let way = -slope.signum();
        let last = if way > 0.0 { range[1] } else { range[0] };
        loop {
            if here == last {
                return Some((here, gap_and_slope(here)?.0));
            }
            let wanted = (here + way * stride).clamp(range[0], range[1]);
            // Where the facing part of the station ends before it: that end.
            let (next, ends) = match gap_and_slope(wanted) {
                Some(_) => (wanted, false),
                None => (last_inside(|u| gap_and_slope(u).is_some(), [here, wanted], BISECTIONS, 0.0), true),
            };
            let (gap, there) = gap_and_slope(next)?;
            if there * way >= 0.0 {
                let slope_at = |u: f64| gap_and_slope(u).map_or(0.0, |g| g.1);
                let [a, b] = bracket_zero_within(slope_at, [here, next], [slope, there], within);
                let u = 0.5 * (a + b);
                return Some((u, gap_and_slope(u)?.0));
            }
            if ends {
                return Some((next, gap));
            }
            (here, slope) = (next, there);
        }
    }
}

/// Surface coordinates on `first` at height `z` (mm) where the gap to the smooth surface of `second` is least; ends of
/// the faces included. `None` where no point of the station faces `second`. See [`SurfacePair::least_gap`].
pub fn least_gap(first: &FlankPatch, second: &FlankPatch, poses: &[Pose; 2], z: f64) -> Option<[f64; 2]> {
    let [low, high] = first.range();
    // The edge nodes lie on the surface to round-off or, from Gmsh, to a nanometre: stay inside the faces.
    let inset = 1e-6 * (high[0] - low[0]);
    let range = [low[0] + inset, high[0] - inset];
    let pair = SurfacePair { first: first.surface(), second: second.surface(), poses };
    let (u, _) = pair.least_gap(range, &|at| second.covers(at), z)?;
    first.covers([u, z]).then_some([u, z])
}
