//! How unevenly the load lies over the face, from its solved distribution. Theory (34a).

use ltca::StaticPosition;

/// K_Hbeta: [`ltca::face_load_factor`] of all positions.
///
/// `None` where points touch, and without load.
pub fn face_load_factor(slices: usize, positions: &[StaticPosition]) -> Option<f64> {
    let pairs = positions.iter().flat_map(|position| &position.pairs);
    ltca::face_load_factor(slices, pairs.flat_map(|pair| &pair.slices))
}
