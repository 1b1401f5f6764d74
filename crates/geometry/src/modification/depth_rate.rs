//! Derivative of the depth of a flank by a parameter. Theory (77).

use super::{Depth, DepthField, ModifiedFlank};

/// Derivative of the depth of a flank by a parameter, per unit of the parameter.
#[derive(Debug, Clone)]
pub struct DepthRate(Rate);

#[derive(Debug, Clone)]
enum Rate {
    /// Depths that are linear in the parameter: as that of a field.
    Linear(Box<DepthField>),
    /// Between the flank with less of it, as it is and with more, and the steps between these.
    Between(Box<[ModifiedFlank; 3]>, [f64; 2]),
}

/// Slopes that change by more than this share of their change beside it have a kink there.
const KINK: f64 = 1e-3;

impl DepthRate {
    /// Derivative from three flanks: with less of the parameter, as it is, and with more. `steps` are the two
    /// differences of the parameter, both above 0. `None` if the flank does not change.
    pub fn between([less, here, more]: [&ModifiedFlank; 3], steps: [f64; 2]) -> Option<Self> {
        if less == more {
            return None;
        }
        let linear = ModifiedFlank::fields([less, here, more])
            .and_then(|fields| DepthField::rate(fields, steps[0] + steps[1]))
            .map(|field| Rate::Linear(Box::new(field)));
        Some(Self(linear.unwrap_or_else(|| Rate::Between(Box::new([less, here, more].map(Clone::clone)), steps))))
    }

    /// Derivatives of depth and slopes at roll angle `u` and height `z` (mm). `None` where the left and the right
    /// derivative differ: at the start of a relief that moves.
    pub fn at(&self, u: f64, z: f64) -> Option<Depth> {
        let (flanks, [down, up]) = match &self.0 {
            Rate::Linear(field) => return Some(field.at(u, z)),
            Rate::Between(flanks, steps) => (flanks, *steps),
        };
        let [less, here, more] = flanks.each_ref().map(|flank| flank.depth(u, z));
        let of = |part: fn(&Depth) -> f64| {
            let [below, above] = [(part(&here) - part(&less)) / down, (part(&more) - part(&here)) / up];
            let is_smooth = (above - below).abs() <= KINK * below.abs().max(above.abs());
            // The parabola's slope in the middle.
            is_smooth.then(|| (up * below + down * above) / (down + up))
        };
        Some(Depth { value: of(|d| d.value)?, by_roll: of(|d| d.by_roll)?, by_z: of(|d| d.by_z)? })
    }
}
