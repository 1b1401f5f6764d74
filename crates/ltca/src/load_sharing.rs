//! Load factors for face and tooth pairs from the solved load distribution. Theory (34a).

use crate::{PairResult, StaticHistory, StaticPosition};

/// K_Hbeta: [`crate::face_load_factor`] over all positions.
///
/// `None` for contact of points, and without load.
pub fn face_load_factor_of(slices: usize, positions: &[StaticPosition]) -> Option<f64> {
    let pairs = positions.iter().flat_map(|position| &position.pairs);
    crate::face_load_factor(slices, pairs.flat_map(|pair| &pair.slices))
}

/// K_Halpha by its definition in ISO 6336-1 (not its estimates): [`load_sharing_ratio`], but at least 1 as in the
/// standard. `None` without load.
pub fn transverse_load_factor(history: &StaticHistory) -> Option<f64> {
    load_sharing_ratio(history).map(|ratio| ratio.max(1.0))
}

/// Largest load of a tooth pair over the mesh, divided by the largest load that it would have if the pairs in mesh
/// shared the load in proportion to their nominal contact lines.
///
/// ```text
/// r = max F_k / max (F l_k / L)       over all positions and pairs k;  F = sum F_k,  L = sum l_k
/// ```
/// F_k are normal forces, l_k analytic lengths of the unloaded lines. The standard compares with "a similar pair free
/// from inaccuracies"; here that pair has evenly loaded lines, as the standard's own mean load has. The ratio is below
/// 1 if soft ends of lines or reliefs distribute the load over more pairs. It is 1 for a spur pair in which one tooth
/// pair temporarily carries the whole load, whatever its errors. `None` without load.
pub fn load_sharing_ratio(history: &StaticHistory) -> Option<f64> {
    let largest = |of: &dyn Fn(&StaticPosition, &PairResult) -> f64| {
        let all = history.positions.iter().flat_map(|p| p.pairs.iter().map(move |pair| of(p, pair)));
        all.fold(0.0, f64::max)
    };
    let even = largest(&|p, pair| {
        let force: f64 = p.pairs.iter().map(|pair| pair.normal_force).sum();
        let length: f64 = p.pairs.iter().map(|pair| pair.geometric_line_length).sum();
        if length > 0.0 { force * pair.geometric_line_length / length } else { 0.0 }
    });
    (even > 0.0).then(|| largest(&|_, pair| pair.normal_force) / even)
}
