//! Start of the search for a slice.

use crate::flank::FacePoint;

/// Position of a slice found before, from which the next search nearby starts. The slice does not depend on the start.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SliceHint {
    pub(crate) roll: Option<f64>,
    pub(super) faces: [Option<FacePoint>; 2],
}

impl SliceHint {
    /// Hint for the next station by linear extrapolation, if the search was at `before` one station earlier.
    #[must_use]
    pub fn beyond(&self, before: &Self) -> Self {
        let roll = match (self.roll, before.roll) {
            (Some(here), Some(there)) => Some(2.0 * here - there),
            (here, _) => here,
        };
        Self { roll, faces: Default::default() }
    }

    /// Follows the rotation of body 1 about its own axis (rad). Contact stays on its line in space, so the position on
    /// flank `patch` moves by the same roll angle.
    pub fn turn(&mut self, side: f64, angle: f64) {
        if let Some(roll) = &mut self.roll {
            *roll += side * angle;
        }
    }
}
