//! Where the shafts stand under steady torques.

use nalgebra::{DVector, Dyn, LU};

use super::ShaftMechanism;
use crate::LumpedError;

/// Torques that leave over more power than this share of the largest are not in balance.
const BALANCE: f64 = 1e-6;
/// Changes of contact before the search is given up.
const TRIALS: usize = 16;

impl ShaftMechanism {
    /// Static equilibrium at time `t` (s): mesh stiffness and tooth errors as they are then.
    ///
    /// Shafts that turn freely stand where the first free turn is zero.
    ///
    /// # Errors
    /// [`LumpedError::NotBalanced`] when shafts that turn freely would not stay where they are;
    /// [`LumpedError::NoEquilibrium`] when contact of the meshes does not settle.
    pub fn static_state(&self, t: f64) -> Result<DVector<f64>, LumpedError> {
        if !self.held && self.imbalance[0].abs() > BALANCE * self.imbalance[1] {
            return Err(LumpedError::NotBalanced { torque: self.imbalance[0] });
        }
        // Which flanks carry: +1 driving, -1 coast, 0 none.
        let mut sides = vec![1.0; self.meshes.len()];
        for _ in 0..TRIALS {
            let mut k = self.stiffness.clone();
            let mut f = self.load.clone();
            for (mesh, &side) in self.meshes.iter().zip(&sides).filter(|(_, side)| **side != 0.0) {
                let stiffness = mesh.stiffness.at(mesh.rate * t);
                k.ger(stiffness, &mesh.lever, &mesh.lever, 1.0);
                f.axpy(stiffness * (side * mesh.zone.half_width - mesh.excess(t)[0]), &mesh.lever, 1.0);
            }
            if !self.held {
                self.ground(&mut k);
            }
            let solved = LU::<f64, Dyn, Dyn>::new(k).solve(&f).filter(|q| q.iter().all(|x| x.is_finite()));
            let q = solved.ok_or(LumpedError::NoEquilibrium)?;
            let mut settled = true;
            for (mesh, side) in self.meshes.iter().zip(&mut sides) {
                let beyond = mesh.zone.at(mesh.lever.dot(&q) + mesh.excess(t)[0]).value;
                let found = if beyond == 0.0 { 0.0 } else { beyond.signum() };
                // A mesh without load touches where it did.
                let unloaded = found == 0.0 && beyond.abs() <= f64::EPSILON;
                if found != *side && !(unloaded && self.load.amax() == 0.0) {
                    (*side, settled) = (found, false);
                }
            }
            if settled {
                return Ok(q);
            }
        }
        Err(LumpedError::NoEquilibrium)
    }

    /// Holds one turn. Torques are in balance, so nothing rests on it.
    fn ground(&self, k: &mut nalgebra::DMatrix<f64>) {
        let turn = self.coordinates().iter().position(|c| c.2 == 5);
        if let Some(i) = turn {
            k[(i, i)] += k[(i, i)].abs().max(1.0);
        }
    }
}
