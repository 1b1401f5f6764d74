//! Backlash: a spring that begins to work beyond a clearance.

use serde::{Deserialize, Serialize};

/// Dead zone of half-width b about x = 0.
///
/// ```text
/// f(x) = x - b (x > b),  0 (|x| <= b),  x + b (x < -b)
/// ```
/// x and b in one unit of length (or angle); b >= 0, and b = 0 is a spring without clearance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct DeadZone {
    /// Half-width b, half of the backlash, >= 0.
    pub half_width: f64,
}

/// A dead zone at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beyond {
    /// f(x): what is beyond the clearance, signed.
    pub value: f64,
    /// df/dx: 1 in contact, 0 in the clearance.
    pub slope: f64,
}

impl DeadZone {
    /// Half-width b.
    pub fn new(half_width: f64) -> Self {
        Self { half_width }
    }

    /// f(x) and its slope; at |x| = b the slope is that of the clearance, and without a clearance it is 1 everywhere.
    ///
    /// ```
    /// let zone = lumped::DeadZone::new(0.1);
    /// assert_eq!(zone.at(0.05).value, 0.0);
    /// assert!((zone.at(-0.3).value + 0.2).abs() < 1e-15 && zone.at(-0.3).slope == 1.0);
    /// assert_eq!(lumped::DeadZone::default().at(0.0).slope, 1.0);
    /// ```
    pub fn at(&self, x: f64) -> Beyond {
        let b = self.half_width;
        if b == 0.0 {
            return Beyond { value: x, slope: 1.0 };
        }
        let value = if x > b {
            x - b
        } else if x < -b {
            x + b
        } else {
            0.0
        };
        Beyond { value, slope: f64::from(x.abs() > b) }
    }
}

impl Beyond {
    /// Potential of a unit spring, f^2 / 2.
    pub fn potential(&self) -> f64 {
        0.5 * self.value * self.value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The force is the slope of the potential on both flanks and in between, and odd.
    #[test]
    fn force_is_the_slope_of_the_potential() {
        for b in [0.0, 0.05] {
            let zone = DeadZone::new(b);
            for i in -40..=40 {
                let (x, h) = (0.01 * f64::from(i) + 0.003, 1e-6);
                let slope = (zone.at(x + h).potential() - zone.at(x - h).potential()) / (2.0 * h);
                assert!((slope - zone.at(x).value).abs() < 1e-9, "b = {b}, x = {x}: {slope}, not {}", zone.at(x).value);
                assert_eq!(zone.at(-x).value, -zone.at(x).value, "b = {b}, x = {x}");
            }
        }
    }
}
