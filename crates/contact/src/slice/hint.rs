//! Where the search for a slice begins.

use crate::flank::FacePoint;

/// Where a slice was found before: the next search nearby starts from there. Any start gives the same slice.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SliceHint {
    pub(crate) roll: Option<f64>,
    pub(super) faces: [Option<FacePoint>; 2],
}

impl SliceHint {
    /// Hint for the next station of a search that was at `before` a station ago: as far again.
    #[must_use]
    pub fn beyond(&self, before: &Self) -> Self {
        let roll = match (self.roll, before.roll) {
            (Some(here), Some(there)) => Some(2.0 * here - there),
            (here, _) => here,
        };
        Self { roll, faces: Default::default() }
    }

    /// Follows body 1's turn about its own axis (rad): contact stays on its line in space, so the place of flank
    /// `patch` moves by as much in roll angle.
    pub fn turn(&mut self, side: f64, angle: f64) {
        if let Some(roll) = &mut self.roll {
            *roll += side * angle;
        }
    }
}
