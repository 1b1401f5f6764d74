//! Position of a pair in its mesh cycles. Theory (14).

use geometry::{GearPair, Sense, Side};

/// Position of the pair: a number of whole mesh cycles and a phase in [0, 1). So a million rotations lose no digits.
///
/// At phase s the pair in the middle of the cycle is, at mid-face, (s - 1/2) base pitches past the middle of the path
/// of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Mesh cycles since the start, in the sense of rotation.
    pub cycle: i64,
    /// Phase of the cycle, 0 .. 1.
    pub phase: f64,
}

impl Station {
    /// Splits a number of mesh cycles into whole cycles and phase.
    pub fn at_cycles(cycles: f64) -> Self {
        let whole = cycles.floor();
        Self { cycle: whole as i64, phase: (cycles - whole).min(1.0 - f64::EPSILON) }
    }

    /// Angle of the pinion, rad, relative to the position from which pair numbers are counted in this cycle: sign (s -
    /// 1/2) 2 pi / z1 from the middle of the path of contact of the flanks on `side`.
    pub fn pinion_angle(&self, pair: &GearPair, side: Side, sense: Sense) -> f64 {
        let middle = pair.middle_angle(side);
        middle + sense.sign() as f64 * (self.phase - 0.5) * pair.pinion.pitch_angle()
    }

    /// Running number of the pair in the middle of this cycle.
    pub fn middle_pair(&self, sense: Sense) -> i64 {
        -sense.sign() * self.cycle
    }

    /// Fractional running number of the point midway between the pairs.
    pub fn centre(&self, sense: Sense) -> f64 {
        let sign = sense.sign() as f64;
        self.middle_pair(sense) as f64 - sign * (self.phase - 0.5)
    }
}
