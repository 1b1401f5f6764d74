//! Parameters of the model with twelve coordinates.

use integrate::State;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::{LumpedError, LumpedPair, error::not_negative};

/// Springs that hold one gear: bearings, and what drives or loads it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Support12 {
    /// Along x, y, z (N/mm) and about x, y, z (N mm/rad), global axes, >= 0. The last is 0 for a gear that is free to
    /// turn.
    pub stiffness: [f64; 6],
}

/// Parameters of the model with twelve coordinates; plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lumped12 {
    /// Pair, excitation, load and friction.
    pub pair: LumpedPair,
    /// Supports of driver and driven gear.
    pub supports: [Support12; 2],
    /// Rayleigh damping C = a M + b K: a (1/s) and b (s), >= 0. K is that of the supports and of the mesh as it then
    /// is, without friction's part; at the mesh it acts on the rate of the mesh deflection, l' - e', so that a pair
    /// that follows its error slowly is not damped.
    pub rayleigh: [f64; 2],
}

impl Lumped12 {
    /// Parameters with Rayleigh coefficients that give the damping ratio zeta at two frequencies (rad/s).
    ///
    /// ```text
    /// b = 2 zeta / (omega_1 + omega_2),   a = b omega_1 omega_2
    /// ```
    ///
    /// # Errors
    /// [`LumpedError`] for what has no meaning.
    pub fn new(
        pair: LumpedPair,
        supports: [Support12; 2],
        damping_ratio: f64,
        frequencies: [f64; 2],
    ) -> Result<Self, LumpedError> {
        not_negative("damping ratio", damping_ratio)?;
        for frequency in frequencies {
            crate::error::positive("frequency of the damping ratio in rad/s", frequency)?;
        }
        let b = 2.0 * damping_ratio / (frequencies[0] + frequencies[1]);
        let made = Self { pair, supports, rayleigh: [b * frequencies[0] * frequencies[1], b] };
        made.check()?;
        Ok(made)
    }

    /// A state at `t` = 0 s from coordinates and velocities, mm, rad and s.
    pub fn state(&self, x: [f64; 12], v: [f64; 12]) -> State {
        State::new(0.0, DVector::from_row_slice(&x), DVector::from_row_slice(&v))
    }

    /// Everything that must be positive is, and every number is one.
    ///
    /// # Errors
    /// [`LumpedError`] naming the first that is not.
    pub fn check(&self) -> Result<(), LumpedError> {
        self.pair.check()?;
        for support in &self.supports {
            for k in support.stiffness {
                not_negative("support stiffness in N/mm or N mm/rad", k)?;
            }
        }
        not_negative("Rayleigh coefficient a in 1/s", self.rayleigh[0])?;
        not_negative("Rayleigh coefficient b in s", self.rayleigh[1])
    }
}
