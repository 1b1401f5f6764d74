//! Where two flanks are nearest at an axial station.

use crate::{FlankPatch, Pose};

/// Places along the profile at which the search starts; one is nearer to the least gap than any other dip.
const SCAN: usize = 24;
/// Bisection steps: the bracket shrinks to round-off.
const STEPS: usize = 60;

/// Surface coordinates on `first` at height `z` (mm) where the gap to the smooth surface of `second` is least; ends of the
/// faces included. `None` where no point of the station faces `second`.
///
/// The gap's slope along the profile is n_2 . dx_1/du, with n_2 the normal at the foot; its zero is bracketed by a scan and
/// bisected, so the place is found to round-off and not to its square root as by comparing gaps.
pub fn least_gap(first: &FlankPatch, second: &FlankPatch, poses: &[Pose; 2], z: f64) -> Option<[f64; 2]> {
    let [low, high] = first.range();
    // The edge nodes lie on the surface to round-off or, from Gmsh, to a nanometre: stay inside the faces.
    let inset = 1e-6 * (high[0] - low[0]);
    let (from, to) = (low[0] + inset, high[0] - inset);
    let gap_and_slope = |u: f64| -> Option<(f64, f64)> {
        let position = poses[0].transform_point(&first.surface().point([u, z]).into());
        let foot = second.surface().locate(&poses[1].inverse_transform_point(&position).coords)?;
        if !second.covers(foot.at) {
            return None;
        }
        let normal = poses[1].rotation * second.surface().normal(foot.at);
        let tangent = poses[0].rotation * first.surface().profile_tangent([u, z]);
        Some((foot.distance, normal.dot(&tangent)))
    };
    let step = (to - from) / (SCAN - 1) as f64;
    let at = |i: usize| (from + step * i as f64).min(to);
    let scanned = (0..SCAN).filter_map(|i| Some((gap_and_slope(at(i))?.0, i)));
    let (_, nearest) = scanned.min_by(|a, b| a.0.total_cmp(&b.0))?;
    // Ends of the bracket: the neighbours, or where the facing part of the station ends before them.
    let end = |neighbour: f64| {
        if gap_and_slope(neighbour).is_some() {
            return neighbour;
        }
        let (mut inside, mut outside) = (at(nearest), neighbour);
        for _ in 0..STEPS {
            let middle = 0.5 * (inside + outside);
            if gap_and_slope(middle).is_some() { inside = middle } else { outside = middle }
        }
        inside
    };
    let (mut a, mut b) = (end(at(nearest.saturating_sub(1))), end(at((nearest + 1).min(SCAN - 1))));
    let slope = |u: f64| gap_and_slope(u).map_or(0.0, |g| g.1);
    let u = if slope(a) >= 0.0 {
        a
    } else if slope(b) <= 0.0 {
        b
    } else {
        for _ in 0..STEPS {
            let middle = 0.5 * (a + b);
            if slope(middle) < 0.0 { a = middle } else { b = middle }
        }
        0.5 * (a + b)
    };
    first.covers([u, z]).then_some([u, z])
}
