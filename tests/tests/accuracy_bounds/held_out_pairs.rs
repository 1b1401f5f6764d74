//! Bounds of the committed laws over pairs that took no part in them.

use scene::Quantity;
use verification::{held_out::held_out, measured_pair::MeasuredPair, pair_bounds::pair_bounds};

/// Of the numbers of pairs of a seed for checks, on all meshes and numbers of positions, at least 95 in 100 lie inside of their
/// bounds; mean transmission error and stiffness have bounds of at most three times the error, in the median.
#[test]
fn bounds_hold_for_pairs_that_took_no_part() {
    let lines: Vec<serde_json::Value> = include_str!("../../data/held_out_pairs.jsonl")
        .lines()
        .filter_map(|line| serde_json::from_str(line).ok())
        .collect();
    let pairs = MeasuredPair::all(&lines);
    assert!(pairs.len() >= 25 && pairs.iter().all(|pair| held_out(pair.seed)), "{} pairs", pairs.len());
    let of = |q: Quantity| pairs.iter().flat_map(move |pair| pair_bounds(pair, q)).collect::<Vec<_>>();
    let all: Vec<_> = Quantity::ALL.iter().copied().filter(|q| !q.is_of_motion()).flat_map(of).collect();
    let inside = all.iter().filter(|bound| bound.holds()).count() as f64 / all.len() as f64;
    assert!(inside >= 0.95, "{inside} of {} numbers lie inside", all.len());
    for q in [Quantity::MeanSte, Quantity::MeshStiffness] {
        let mut ratios: Vec<f64> = of(q).iter().map(|bound| bound.sharpness()).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        let median = ratios[ratios.len() / 2];
        assert!(median <= 3.0, "{}: bound over error {median}", q.key());
    }
}
