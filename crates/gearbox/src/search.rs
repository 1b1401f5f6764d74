//! Equilibrium of the seats under a load: meshes and rolling bearings together. Theory (84).

use nalgebra::{DMatrix, DVector};

use crate::{
    GearboxError, MeshForces, StaticGearbox,
    equilibrium::{Converged, Left, equilibrium},
    rolling_bearing::RollingReply,
    static_gearbox::at_mesh,
};

/// Loads that a light one is found by way of: powers of this factor, and how many.
const HEAVIER: f64 = 8.0;
const MOST_POWERS: i32 = 8;

/// Equilibrium, with what meshes and rolling bearings did there.
pub(crate) struct Trial {
    pub found: Converged,
    pub replies: Vec<MeshForces>,
    pub pressed: Vec<RollingReply>,
}

impl StaticGearbox {
    /// Equilibrium of the seats under a load, from `start` on.
    pub(crate) fn search(&mut self, load: &DVector<f64>, start: DVector<f64>) -> Result<Trial, GearboxError> {
        let Self { seats, elements, to_gears, stiffness, compliant_support, turned_springs, norms, meshes, .. } = self;
        let (mut replies, mut pressed) = (Vec::new(), Vec::new());
        let found = equilibrium(norms, load, start, |z| {
            replies.clear();
            let mut left = Left { residual: &*stiffness * z - load, tangent: stiffness.clone() };
            for (i, (to_gears, element)) in to_gears.iter().zip(elements.iter_mut()).enumerate() {
                let reply = element.evaluate(&(to_gears * z)).map_err(|source| at_mesh(&meshes[i], source))?;
                left.residual -= to_gears.tr_mul(&reply.force);
                left.tangent -= to_gears.tr_mul(&(reply.tangent * to_gears));
                replies.push(reply);
            }
            if !(compliant_support.is_empty() && turned_springs.is_empty()) {
                let y = &seats.basis * z;
                let (mut forces, mut slopes) = (DVector::zeros(y.len()), DMatrix::zeros(y.len(), y.len()));
                pressed = compliant_support.iter().map(|own| own.add(&y, &mut forces, &mut slopes)).collect();
                turned_springs.iter().for_each(|own| own.add(&y, &mut forces, &mut slopes));
                left.residual -= seats.basis.tr_mul(&forces);
                left.tangent -= seats.basis.tr_mul(&(slopes * &seats.basis));
            }
            Ok(left)
        })?;
        Ok(Trial { found, replies, pressed })
    }

    /// Search by way of heavier loads. Under a light load play is a bent valley with walls that are hard beside the
    /// load: steps along it are short. A heavy load finds the way through, and the way back is short.
    pub(crate) fn by_heavier_loads(&mut self, load: &DVector<f64>) -> Option<Trial> {
        for powers in 1..=MOST_POWERS {
            let heavy = load * HEAVIER.powi(powers);
            let start = self.norms.displacements(&heavy);
            let Ok(mut sought) = self.search(&heavy, start) else { continue };
            for power in (0..powers).rev() {
                sought = self.search(&(load * HEAVIER.powi(power)), sought.found.displacements).ok()?;
            }
            return Some(sought);
        }
        None
    }
}
