//! Counts the teeth of a mesh without groups by its tip lands.

use std::f64::consts::TAU;

use crate::Mesh;

/// How far from the largest radius a node of a tip land may be, as a share of it.
const ON_TIP: f64 = 1e-4;

/// Angle between neighbouring tip lands of an external gear, rad; `None` where they cannot be told from each other.
///
/// Tip lands are the runs of nodes at the largest radius of one end face. A gap is wider than half the widest gap within
/// the mesh; a run of one node is none, so that the smooth rim of an internal gear or of a flange has no tips.
pub(crate) fn between_tips(mesh: &Mesh) -> Option<f64> {
    let low = mesh.nodes.iter().map(|x| x[2]).fold(f64::INFINITY, f64::min);
    let largest = mesh.nodes.iter().map(|x| x[0].hypot(x[1])).fold(0.0, f64::max);
    let on_tip = |x: &&[f64; 3]| x[2] - low <= ON_TIP * largest && x[0].hypot(x[1]) >= (1.0 - ON_TIP) * largest;
    let mut angles: Vec<f64> = mesh.nodes.iter().filter(on_tip).map(|x| x[1].atan2(x[0])).collect();
    angles.sort_unstable_by(f64::total_cmp);
    let first = *angles.first()?;
    let mut gaps: Vec<f64> = angles.windows(2).map(|w| w[1] - w[0]).collect();
    gaps.push(first + TAU - angles.last()?);
    // Of a sector the gap around the rest of the gear is the widest: the next one is between teeth.
    let mut sizes = gaps.clone();
    sizes.sort_unstable_by(f64::total_cmp);
    let between = 0.5 * sizes.get(sizes.len().checked_sub(2)?)?;
    // Runs begin behind the widest gap.
    let (from, _) = gaps.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    let mut tips: Vec<(f64, usize)> = Vec::new();
    let mut run = (0.0, 0, 0.0);
    for k in 1..=angles.len() {
        let i = (from + k) % angles.len();
        // Angles go on beyond a full turn.
        let angle = if from + k >= angles.len() { angles[i] + TAU } else { angles[i] };
        run = if run.1 == 0 { (angle, 1, angle) } else { (run.0, run.1 + 1, angle) };
        if gaps[i] > between {
            tips.push((0.5 * (run.0 + run.2), run.1));
            run = (0.0, 0, 0.0);
        }
    }
    if tips.len() < 2 || tips.iter().any(|(_, nodes)| *nodes < 2) {
        return None;
    }
    let mut pitches: Vec<f64> = tips.windows(2).map(|w| w[1].0 - w[0].0).collect();
    pitches.sort_unstable_by(f64::total_cmp);
    Some(pitches[pitches.len() / 2])
}
