//! What a run shows of its own errors.

use geometry::GearPair;
use scene::{Quantity, Scene};
use study::Between;

use crate::loaded_pair::LoadedPair;

/// What a run shows of an error, in the unit of its number.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Seen {
    /// What the shape of the curve adds to the number.
    pub shift: f64,
    /// Sizes that the error goes with.
    pub sizes: Vec<f64>,
}

impl Seen {
    /// What a curve shows between its positions, and the difference from the number of every second of them.
    pub fn of(between: &Between, halved: Option<f64>) -> Self {
        Self { shift: between.shift, sizes: between.seen.into_iter().chain(halved).collect() }
    }
}

/// Normal force of a tooth pair that carries the whole load in the plane of action, N: `F = T / (r_b cos beta_b)` of the
/// driven gear. The largest pair force is this force where a pair carries all, on every mesh and between all positions. It
/// is larger only where tips touch off the plane of action.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeForce(f64);

impl WholeForce {
    /// The whole force of a scene and its pair.
    pub fn of(scene: &Scene, pair: &GearPair) -> Self {
        let loaded = LoadedPair::of(scene, pair);
        Self(loaded.torque / (loaded.driven_base_radius() * pair.base_helix_angle().cos()))
    }

    /// Share that is left for other pairs beside one with this force (N); negative beside a larger force.
    pub fn left(self, force: f64) -> f64 {
        1.0 - force / self.0
    }

    /// What meshes and slices show: the number itself; for the largest pair force its distance from the whole force.
    pub fn number(self, quantity: Quantity, value: f64) -> Seen {
        Seen { shift: 0.0, sizes: vec![if quantity == Quantity::MaxPairForce { self.distance(value) } else { value }] }
    }

    /// What a curve shows between its positions: a pair force rises no farther than to the whole force.
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
