//! Law for an error as a function of a difference that a run can measure.

use serde::{Deserialize, Serialize};

/// Law for the error of a value as a function of a measured difference `d`. Theory (67).
///
/// ```text
/// exact = value + pull d  +-  factor (|d| + floor scale)
/// ```
/// `scale` is the value itself; for transmission errors it is the mean deflection of the pair. The factor is that of
/// split conformal prediction: the share of the calibration's pairs is within the bound.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Law {
    /// Share of the difference that is the known part of the error.
    pub pull: f64,
    /// Smallest difference that is assumed, relative to the scale.
    pub floor: f64,
    /// Bound divided by the difference.
    pub factor: f64,
}

impl Law {
    /// Known part of the error, and the bound of the rest.
    pub fn of(self, difference: f64, scale: f64) -> [f64; 2] {
        [self.pull * difference, self.factor * (difference.abs() + self.floor * scale.abs())]
    }
}
