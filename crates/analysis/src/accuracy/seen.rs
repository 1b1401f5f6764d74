//! Error indicators of a run.

use geometry::GearPair;
use scene::{Quantity, Scene};
use study::Between;

use crate::loaded_pair::LoadedPair;

/// Error indicators that a run shows, in the unit of its value.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Seen {
    /// Contribution of the curve's shape to the value.
    pub shift: f64,
    /// Magnitudes to which the error is proportional.
    pub sizes: Vec<f64>,
}

impl Seen {
    /// Possible error of a curve between its positions, and the difference of the value from that of every second
    /// position.
    pub fn of(between: &Between, halved: Option<f64>) -> Self {
        Self { shift: between.shift, sizes: between.seen.into_iter().chain(halved).collect() }
    }
}

/// Normal force of a tooth pair that carries the whole load in the plane of action, N: `F = T / (r_b cos beta_b)` of
/// the driven gear. If one pair carries the whole load, the largest pair force is this force, on every mesh and at all
/// positions. It is larger only if tips touch off the plane of action.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeForce(f64);

impl WholeForce {
    /// The whole force for a scene and its pair.
    pub fn of(scene: &Scene, pair: &GearPair) -> Self {
        let loaded = LoadedPair::of(scene, pair);
        Self(loaded.torque / (loaded.driven_base_radius() * pair.base_helix_angle().cos()))
    }

    /// Share that remains for other pairs if one has this force (N); negative if the force is larger.
    pub fn left(self, force: f64) -> f64 {
        1.0 - force / self.0
    }

    /// Indicator for meshes and slices: the value itself; for the largest pair force its difference from the whole
    /// force.
    pub fn number(self, quantity: Quantity, value: f64) -> Seen {
        Seen { shift: 0.0, sizes: vec![if quantity == Quantity::MaxPairForce { self.distance(value) } else { value }] }
    }

    /// Indicator for positions: the possible error of a curve between them. A pair force cannot exceed the whole force.
    pub fn between(self, quantity: Quantity, value: f64, between: Between) -> Between {
        if quantity != Quantity::MaxPairForce {
            return between;
        }
        let most = self.distance(value);
        Between { shift: between.shift.min(most), seen: between.seen.map(|size| size.min(most)) }
    }

    fn distance(self, force: f64) -> f64 {
        (self.0 - force).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pair that carries all is known: nothing lies between its positions, and no mesh changes it.
    #[test]
    fn a_pair_that_carries_all_has_no_error() {
        let (whole, force) = (WholeForce(1000.0), Quantity::MaxPairForce);
        let between = Between { shift: 4.0, seen: [30.0, 50.0] };
        assert_eq!(whole.between(force, 1000.0, between), Between::default());
        assert_eq!(whole.between(force, 980.0, between), Between { shift: 4.0, seen: [20.0, 20.0] });
        assert_eq!(whole.between(Quantity::MaxPressure, 1000.0, between), between);
        assert_eq!(
            (whole.number(force, 1010.0).sizes, whole.number(Quantity::MeanSte, 7.0).sizes),
            (vec![10.0], vec![7.0])
        );
        assert!((whole.left(900.0) - 0.1).abs() < 1e-15);
    }
}
