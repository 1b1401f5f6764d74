//! Reliefs: from a start to the edge of the flank. Theory (26).

use serde::Serialize;

/// A place along the profile.
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
            Self::Diameter(d) => ((0.5 * d / base_radius).powi(2) - 1.0).sqrt(),
        }
    }
}

/// How depth grows from the start of a relief to its end.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ReliefShape {
    /// With the distance from the start: a kink there.
    #[default]
    Linear,
    /// With its square: tangent to the flank at the start.
    Parabolic,
}

/// Tip or root relief.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Relief {
    /// Depth at the tip circle or at the root form circle, mm.
    pub amount: f64,
    /// Where it starts.
    pub start: ProfilePlace,
    /// How it grows.
    pub shape: ReliefShape,
}

/// End relief.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EndRelief {
    /// Depth at the end face, mm.
    pub amount: f64,
    /// Axial length from the start to the end face, mm.
    pub length: f64,
    /// How it grows.
    pub shape: ReliefShape,
}

/// Depth that starts at `start` and is `amount` at `start + length`; `length` < 0: towards smaller x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ramp {
    pub amount: f64,
    pub start: f64,
    pub length: f64,
    pub shape: ReliefShape,
}

impl Ramp {
    /// Depth and its derivative by x; at the start itself the slope is that of the flank before it.
    pub fn at(&self, x: f64) -> (f64, f64) {
        let t = (x - self.start) / self.length;
        if t <= 0.0 {
            return (0.0, 0.0);
        }
        match self.shape {
            ReliefShape::Linear => (self.amount * t, self.amount / self.length),
            ReliefShape::Parabolic => (self.amount * t * t, 2.0 * self.amount * t / self.length),
        }
    }
}
