//! Assigns tooth pairs to columns.

use std::collections::BTreeSet;

use ltca::{StaticHistory, StaticPosition};

/// Number of a pair within its mesh cycle: 0 for the pair whose contact passes the middle of the path during this
/// cycle, 1 for the one ahead of it in the sense of rotation, -1 for the one behind. So a column means the same in
/// every cycle, and a run of a thousand rotations has as many columns as one of a single cycle.
pub fn in_cycle(position: &StaticPosition, pair: i64, pitch_angle: f64) -> i64 {
    // angle / pitch - phase is a whole number, or half of one where phase 1/2 is the middle: both round alike.
    // Pair numbers grow in the sense of rotation, so the pair of the next cycle is one less.
    let cycle = (position.pinion_angle / pitch_angle - position.mesh_phase + 0.75).floor();
    pair + cycle as i64
}

/// All numbers that occur, ascending.
pub fn columns(history: &StaticHistory, pitch_angle: f64) -> Vec<i64> {
    let mut all = BTreeSet::new();
    for position in &history.positions {
        all.extend(position.pairs.iter().map(|p| in_cycle(position, p.pair, pitch_angle)));
    }
    all.into_iter().collect()
}

/// Pinion and wheel tooth of the pair of this column; `None` if it is not in the window.
pub fn teeth(position: &StaticPosition, column: i64, pitch_angle: f64) -> Option<[u32; 2]> {
    let pair = position.pairs.iter().find(|p| in_cycle(position, p.pair, pitch_angle) == column)?;
    Some([pair.pinion_tooth, pair.wheel_tooth])
}

/// Normal force of the pair of this column, N; 0 if it is not in the window.
pub fn force(position: &StaticPosition, column: i64, pitch_angle: f64) -> f64 {
    // 0.0 first: the sum of nothing is -0.0 otherwise.
    0.0 + position
        .pairs
        .iter()
        .filter(|p| in_cycle(position, p.pair, pitch_angle) == column)
        .map(|p| p.normal_force)
        .sum::<f64>()
}
