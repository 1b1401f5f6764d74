//! Equilibrium of the seats under a load: meshes and rolling bearings together. Theory (84).

use nalgebra::{DMatrix, DVector};

use crate::{
    GearboxError, MeshReply, StaticGearbox, Vector12,
    equilibrium::{Found, Left, equilibrium},
    rolling_bearing::RollingReply,
    static_gearbox::{at_mesh, spread},
};

/// Loads that a light one is found by way of: powers of this factor, and how many.
const HEAVIER: f64 = 8.0;
const MOST_POWERS: i32 = 8;

/// Equilibrium, with what meshes and rolling bearings did there.
pub(crate) struct Sought {
    pub found: Found,
    pub replies: Vec<MeshReply>,
    pub pressed: Vec<RollingReply>,
}

impl StaticGearbox {
    /// Equilibrium of the seats under a load, from `start` on.
    pub(crate) fn search(&mut self, load: &DVector<f64>, start: DVector<f64>) -> Result<Sought, GearboxError> {
        let Self { seats, elements, places, stiffness, pliant, norms, meshes, .. } = self;
        let (mut replies, mut pressed) = (Vec::new(), Vec::new());
        let found = equilibrium(norms, load, start, |z| {
            let y = &seats.basis * z;
            replies.clear();
            let (mut forces, mut slopes) = (DVector::zeros(y.len()), DMatrix::zeros(y.len(), y.len()));
            for (i, ((at, turn), element)) in places.iter().zip(elements.iter_mut()).enumerate() {
                let own = turn.transpose() * Vector12::from_fn(|k, _| y[at[k / 6] + k % 6]);
                let reply = element.evaluate(&own).map_err(|source| at_mesh(&meshes[i], source))?;
                forces += spread(y.len(), *at, &(turn * reply.force));
                let tangent = turn * reply.tangent * turn.transpose();
                for (k, m) in (0..12).flat_map(|k| (0..12).map(move |m| (k, m))) {
                    slopes[(at[k / 6] + k % 6, at[m / 6] + m % 6)] += tangent[(k, m)];
                }
                replies.push(reply);
            }
            pressed = pliant.iter().map(|own| own.add(&y, &mut forces, &mut slopes)).collect();
            let residual = &*stiffness * z - load - seats.basis.transpose() * forces;
            let tangent = &*stiffness - seats.basis.transpose() * slopes * &seats.basis;
            Ok(Left { residual, tangent })
        })?;
        Ok(Sought { found, replies, pressed })
    }

    /// The same by way of heavier loads. Under a light one play is a bent valley with walls that are hard beside the
    /// load: steps along it are short. A heavy load finds the way through, and the way back is short.
    pub(crate) fn by_heavier_loads(&mut self, load: &DVector<f64>) -> Option<Sought> {
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
