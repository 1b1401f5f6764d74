//! How an error goes with a difference that a run can see.

use serde::{Deserialize, Serialize};

/// How the error of a number goes with a difference `d` that was seen. Theory (67).
///
/// ```text
/// exact = value + pull d  +-  factor (|d| + floor scale)
/// ```
/// `scale` is the number itself, for transmission errors the mean deflection of the pair. The factor is that of
/// split conformal prediction: the share of the calibration's pairs lies within.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Law {
    /// Share of the difference that is the known part of the error.
    pub pull: f64,
    /// Difference that is assumed at least, over the scale.
    pub floor: f64,
    /// Bound over the difference.
    pub factor: f64,
}

impl Law {
    /// Known part of the error, and the bound of the rest.
    pub fn of(self, difference: f64, scale: f64) -> [f64; 2] {
        [self.pull * difference, self.factor * (difference.abs() + self.floor * scale.abs())]
    }
}
