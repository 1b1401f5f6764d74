//! Pitch errors of both gears in the order in which the teeth come into mesh. Theory (94).

use contact_map::PairOffsets;

use crate::GearboxError;

/// Deviations of the teeth of gear 1 and gear 2, mm along the normal of the driving flanks; positive if a tooth is
/// nearer to its mate.
///
/// ```text
/// e(c) = sum over pairs k of w(c - k) (e_1[k mod z_1] + e_2[-k mod z_2]),   w(x) = 1 - 3 y^2 + 2 y^3,  y = |x - 1/2| <= 1
/// ```
/// A spring represents all pairs in contact at once. Within a cycle the load passes from one pair to the next with
/// smooth weights that add up to 1. Gear 2 rotates in the opposite sense, so its teeth come in descending order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PitchErrors {
    offsets: PairOffsets,
}

impl PitchErrors {
    /// Pitch errors of the teeth of both gears, one entry per tooth; an empty list for a gear without errors.
    ///
    /// # Errors
    /// [`GearboxError::OutOfRange`] if an entry is not a finite number.
    pub fn new(teeth: [Vec<f64>; 2]) -> Result<Self, GearboxError> {
        match teeth.iter().flatten().copied().find(|e| !e.is_finite()) {
            Some(value) => Err(GearboxError::OutOfRange { part: "teeth".into(), quantity: "pitch error, mm", value }),
            None => Ok(Self { offsets: PairOffsets::new(teeth) }),
        }
    }

    /// e (mm) and de/dc (mm per cycle) at a position in the mesh cycles.
    pub fn at(&self, cycles: f64) -> [f64; 2] {
        // The pair whose middle is behind, and the one whose middle is ahead.
        let behind = (cycles - 0.5).floor();
        let y = cycles - 0.5 - behind;
        let [a, b] = [0, 1].map(|k| self.offsets.of(behind as i64 + k));
        let share = y * y * (3.0 - 2.0 * y);
        [a + share * (b - a), 6.0 * y * (1.0 - y) * (b - a)]
    }

    /// Number of mesh cycles after which the same teeth meet again.
    pub fn period(&self) -> u64 {
        self.offsets.period()
    }
}
