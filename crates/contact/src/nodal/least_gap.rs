//! Finds the point at which two flanks are nearest at an axial station.

use crate::{
    Pose,
    bracketing::{bracket_zero, last_inside},
    flank::{FlankPatch, Surface},
};

/// Places along the profile at which the search starts; one is nearer to the least gap than any other dip.
const SCAN: usize = 24;
/// Bisection steps to the end of the facing part: it is found to round-off.
const BISECTIONS: usize = 60;

/// Two smooth surfaces at the poses of their bodies.
#[derive(Debug, Clone, Copy)]
struct SurfacePair<'a> {
    /// Surface of body 1.
    first: &'a dyn Surface,
    /// Surface of body 2.
    second: &'a dyn Surface,
    /// Poses of both bodies.
    poses: &'a [Pose; 2],
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
    fn least_gap(&self, range: [f64; 2], covers: &dyn Fn([f64; 2]) -> bool, z: f64) -> Option<(f64, f64)> {
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

/// Surface coordinates on `first` at height `z` (mm) at which the gap to the smooth surface of `second` is smallest,
/// ends of the faces included. `None` if no point of the station faces `second`.
pub fn least_gap(first: &FlankPatch, second: &FlankPatch, poses: &[Pose; 2], z: f64) -> Option<[f64; 2]> {
    let [low, high] = first.range();
    // The edge nodes lie on the surface to round-off or, from Gmsh, to a nanometre: stay inside the faces.
    let inset = 1e-6 * (high[0] - low[0]);
    let range = [low[0] + inset, high[0] - inset];
    let pair = SurfacePair { first: first.surface(), second: second.surface(), poses };
    let (u, _) = pair.least_gap(range, &|at| second.covers(at), z)?;
    first.covers([u, z]).then_some([u, z])
}
