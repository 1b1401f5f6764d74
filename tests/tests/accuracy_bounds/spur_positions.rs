//! Bounds of few positions over spur pairs, whose load jumps from pair to pair.

use analysis::accuracy::Calibration;
use scene::Quantity;
use verification::measured_pair::MeasuredPair;

/// 53 spur pairs took no part in the laws; of them at least 95 in 100 lie within the bound of their positions alone, number
/// by number.
#[test]
fn few_positions_of_spur_pairs_are_covered() {
    let lines: Vec<serde_json::Value> = include_str!("../../data/spur_curves.jsonl")
        .lines()
        .filter_map(|line| serde_json::from_str(line).ok())
        .collect();
    let pairs = MeasuredPair::all(&lines);
    assert_eq!(pairs.len(), 53);
    for q in Quantity::ALL.iter().copied().filter(|q| !q.is_of_motion()) {
        for positions in [8, 16, 32] {
            let law = Calibration::committed().of(q).and_then(|laws| laws.of_positions(positions)).unwrap();
            let held = |pair: &MeasuredPair| {
                let (features, sample) = (pair.features_of_positions(positions)?, pair.of_positions(positions)?);
                let [known, within] = law.of(&features, &pair.seen(positions, q)?, sample.scale(q)?);
                // The quantile is the ratio of one of the pairs: round-off is on either side of it.
                Some((pair.positions_error(positions, q)? - known).abs() <= within * (1.0 + 1e-9))
            };
            let all: Vec<bool> = pairs.iter().filter_map(held).collect();
            let share = all.iter().filter(|held| **held).count() as f64 / all.len() as f64;
            assert!(all.len() >= 20 && share >= 0.95, "{}, {positions} positions: {share} of {}", q.key(), all.len());
        }
    }
}
