//! Reliefs: from their start to the edge of the flank. Theory (26).

use serde::Serialize;

use crate::profile::roll_angle;

/// A position along the profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ProfilePlace {
    /// Roll angle u = tan(alpha), rad.
    Roll(f64),
    /// Diameter, mm: d = d_b sqrt(1 + u^2).
    Diameter(f64),
}

impl ProfilePlace {
    /// Roll angle on a gear of base radius `base_radius` (mm); NaN below the base circle.
    pub fn roll(self, base_radius: f64) -> f64 {
        match self {
            Self::Roll(u) => u,
            Self::Diameter(d) => roll_angle(0.5 * d, base_radius).unwrap_or(f64::NAN),
        }
    }
}

/// How the depth grows from the start of a relief to its end.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ReliefShape {
    /// Linear with the distance from the start; the profile has a kink at the start.
    #[default]
    Linear,
    /// Quadratic with the distance from the start; tangent to the flank at the start.
    Parabolic,
}

/// Tip or root relief.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Relief {
    /// Depth at the tip circle or at the root form circle, mm.
    pub amount: f64,
    /// Position at which the relief starts.
    pub start: ProfilePlace,
    /// Shape of the relief.
    pub shape: ReliefShape,
}

/// End relief.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EndRelief {
    /// Depth at the end face, mm.
    pub amount: f64,
    /// Axial length from the start to the end face, mm.
    pub length: f64,
    /// Shape of the relief.
    pub shape: ReliefShape,
}

/// Depth that starts at one place of an axis and is the amount at another; beyond the start there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ramp {
    amount: f64,
    start: f64,
    /// 1 over the way from the start to the other place; negative: towards smaller x.
    per_length: f64,
    shape: ReliefShape,
}

impl Ramp {
    /// A ramp from depth 0 at `start` to `amount` at `start + length`.
    pub fn new(amount: f64, shape: ReliefShape, start: f64, length: f64) -> Self {
        Self { amount, start, per_length: 1.0 / length, shape }
    }

    /// Difference of two ramps over `step`. The ramps may differ in their amounts, and either may be absent. `None` if
    /// their starts or shapes differ.
    pub fn rate([less, more]: [Option<Self>; 2], step: f64) -> Option<Option<Self>> {
        let Some(any) = more.or(less) else { return Some(None) };
        let amount = |ramp: Option<Self>| ramp.map_or(0.0, |r| r.amount);
        let same = [less, more].into_iter().flatten().all(|ramp| Self { amount: any.amount, ..ramp } == any);
        let amount = (amount(more) - amount(less)) / step;
        same.then(|| (amount != 0.0).then_some(Self { amount, ..any }))
    }

    /// Position of the kink at the start of the ramp, if it has one.
    pub fn kink(&self) -> Option<f64> {
        (self.shape == ReliefShape::Linear && self.amount != 0.0).then_some(self.start)
    }

    /// Adds the depth of the ramp at each x.
    pub fn add_to(&self, depths: &mut [f64], at: &[f64]) {
        let way = |x: f64| (x - self.start) * self.per_length;
        let places = depths.iter_mut().zip(at);
        match self.shape {
            ReliefShape::Linear => places.for_each(|(depth, &x)| {
                let t = way(x);
                *depth += if t <= 0.0 { 0.0 } else { self.amount * t };
            }),
            ReliefShape::Parabolic => places.for_each(|(depth, &x)| {
                let t = way(x);
                *depth += if t <= 0.0 { 0.0 } else { self.amount * t * t };
            }),
        }
    }

    /// Depth and its derivative by x. At the start itself the slope is that of the flank before it.
    pub fn at(&self, x: f64) -> (f64, f64) {
        let t = (x - self.start) * self.per_length;
        if t <= 0.0 {
            return (0.0, 0.0);
        }
        let slope = self.amount * self.per_length;
        match self.shape {
            ReliefShape::Linear => (self.amount * t, slope),
            ReliefShape::Parabolic => (self.amount * t * t, 2.0 * t * slope),
        }
    }
}
