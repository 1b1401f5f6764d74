//! Parameters of the model with eight coordinates.

use integrate::State;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::MeshLaw;
use crate::{LumpedError, LumpedPair, error::not_negative};

/// Support of one gear.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Support8 {
    /// K_x, K_y, K_z, N/mm, >= 0.
    pub stiffness: [f64; 3],
    /// C_x, C_y, C_z, N s/mm, >= 0.
    pub damping: [f64; 3],
    /// Torsional stiffness between the gear and what turns uniformly with it, N mm/rad, >= 0; 0 as printed: the gear is
    /// free to turn.
    #[serde(default)]
    pub turning_stiffness: f64,
    /// Torsional damping between the gear and what turns uniformly with it, N mm s/rad, >= 0.
    #[serde(default)]
    pub turning_damping: f64,
}

/// Parameters of the model with eight coordinates; plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lumped8 {
    /// Pair, excitation, load and friction.
    pub pair: LumpedPair,
    /// Supports of driver and driven gear.
    pub supports: [Support8; 2],
    /// Mesh damping C on the transverse line of action, N s/mm, >= 0; it acts in the clearance too, as in the seed.
    pub mesh_damping: f64,
    /// Half of the backlash along the flanks' normal, b_n, mm, >= 0; 0: no clearance, the flanks pull as well as push
    /// (a linear mesh).
    pub half_backlash: f64,
    /// Transverse and axial force.
    #[serde(default)]
    pub law: MeshLaw,
}

impl Lumped8 {
    /// Parameters with mesh damping of ratio zeta.
    ///
    /// ```text
    /// C = 2 zeta sqrt(k_m m_e)
    /// ```
    ///
    /// # Errors
    /// [`LumpedError`] for what has no meaning.
    pub fn new(
        pair: LumpedPair,
        supports: [Support8; 2],
        damping_ratio: f64,
        half_backlash: f64,
        law: MeshLaw,
    ) -> Result<Self, LumpedError> {
        not_negative("mesh damping ratio", damping_ratio)?;
        let mesh_damping = 2.0 * damping_ratio * (pair.cycle.stiffness.mean * pair.reduced_mass()).sqrt();
        let made = Self { pair, supports, mesh_damping, half_backlash, law };
        made.check()?;
        Ok(made)
    }

    /// b_n, seen along the transverse line of action: the mesh deflection at which the driving flanks begin to touch,
    /// mm.
    pub fn clearance(&self) -> f64 {
        let cos = self.pair.frame.base_helix_angle.cos();
        match self.law {
            MeshLaw::Normal => self.half_backlash / cos,
            MeshLaw::Projected => self.half_backlash * cos,
        }
    }

    /// A state at `t` = 0 s from eight coordinates and velocities, mm, rad and s.
    pub fn state(&self, q: [f64; 8], v: [f64; 8]) -> State {
        State::new(0.0, DVector::from_row_slice(&q), DVector::from_row_slice(&v))
    }

    /// Everything that must be positive is, and every number is one.
    ///
    /// # Errors
    /// [`LumpedError`] naming the first that is not.
    pub fn check(&self) -> Result<(), LumpedError> {
        self.pair.check()?;
        not_negative("mesh damping in N s/mm", self.mesh_damping)?;
        not_negative("half backlash in mm", self.half_backlash)?;
        for support in &self.supports {
            for (stiffness, damping) in support.stiffness.iter().zip(&support.damping) {
                not_negative("support stiffness in N/mm", *stiffness)?;
                not_negative("support damping in N s/mm", *damping)?;
            }
            not_negative("turning stiffness in N mm/rad", support.turning_stiffness)?;
            not_negative("turning damping in N mm s/rad", support.turning_damping)?;
        }
        Ok(())
    }
}
