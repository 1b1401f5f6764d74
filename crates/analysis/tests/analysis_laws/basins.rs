//! Basins of attraction: starts end in the stable motions of the branch, and in no other.

use analysis::lumped::{BasinAnalysis, BasinResult};
use scene::{Scene, SceneBuilder};

use crate::continuation::{followed, pair};

/// Between the folds of this pair, 1/min, where it has two stable motions.
const BETWEEN: f64 = 16_050.0;

fn plane(scene: SceneBuilder, ([low, high], columns): ([f64; 2], i64), ([slow, fast], rows): ([f64; 2], i64)) -> Scene {
    let scene = scene
        .set("operation.speed_rpm", BETWEEN)
        .set("motion.run", "basins")
        .set("motion.basins.from_um", low)
        .set("motion.basins.to_um", high)
        .set("motion.basins.columns", columns)
        .set("motion.basins.from_mm_s", slow)
        .set("motion.basins.to_mm_s", fast)
        .set("motion.basins.rows", rows);
    scene.build().unwrap_or_else(|e| panic!("{e}"))
}

fn solved(scene: &Scene) -> BasinResult {
    BasinAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{e}"))
}

/// Between two folds a pair has two stable motions: starts all over the plane end in either, with the amplitudes that
/// the branch has there.
#[test]
fn starts_end_in_the_stable_motions_of_the_branch() {
    let of = || pair("mapped", (15.0, 12));
    let (_, branch) = followed(of().set("motion.continuation.time_points", 0), [15_500.0, 17_000.0]);
    // The branch passes this speed three times: amplitudes between those of its neighbours there.
    let mut there: Vec<(f64, bool)> = Vec::new();
    for w in branch.points.windows(2) {
        let share = (BETWEEN - w[0].value) / (w[1].value - w[0].value);
        if (0.0..1.0).contains(&share) {
            let [a, b] = [w[0].peak_to_peak_dte_um, w[1].peak_to_peak_dte_um];
            there.push((a + share * (b - a), w[0].is_stable && w[1].is_stable));
        }
    }
    let mut stable: Vec<f64> = there.iter().filter(|p| p.1).map(|p| p.0).collect();
    stable.sort_by(f64::total_cmp);
    assert_eq!(stable.len(), 2, "{there:?}");
    let found = solved(&plane(of(), ([-12.0, 12.0], 5), ([-60.0, 60.0], 4)));
    assert_eq!(found.headline.failed, 0, "{:?}", found.remarks);
    let amplitudes: Vec<f64> = found.attractors.iter().map(|a| a.peak_to_peak_dte_um()).collect();
    assert_eq!(amplitudes.len(), 2, "{:?}, on the branch {stable:?}", found.attractors);
    for (a, b) in amplitudes.iter().zip(&stable) {
        assert!((a / b - 1.0).abs() < 0.02, "starts end in {amplitudes:?} um, the branch has {stable:?}");
    }
    assert_eq!(found.attractors.iter().map(|a| a.starts).sum::<usize>(), found.starts.len());
}

/// Without an initial disturbance the start is that from rest: what a plain run settles to.
#[test]
fn the_middle_of_the_plane_is_rest() {
    let of = || pair("mapped", (15.0, 12));
    let found = solved(&plane(of(), ([0.0, 0.0], 1), ([0.0, 0.0], 1)));
    let steady = of().set("operation.speed_rpm", BETWEEN).build().unwrap_or_else(|e| panic!("{e}"));
    let run = analysis::lumped::LumpedAnalysis::new(&steady).solve().unwrap_or_else(|e| panic!("{e}"));
    let [at_rest] = &found.attractors[..] else { panic!("{:?}", found.attractors) };
    let off = (at_rest.peak_to_peak_dte_um() / run.headline.peak_to_peak_dte_um - 1.0).abs();
    assert!(off < 1e-4, "{at_rest:?}, a plain run {} um", run.headline.peak_to_peak_dte_um);
}
