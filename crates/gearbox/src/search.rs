//! Equilibrium of the seats under a load: meshes and rolling bearings together. Theory (84).

use nalgebra::{DMatrix, DVector, Dyn, OMatrix, U12};

use crate::{
    GearMesh, GearboxError, MeshElement, MeshForces, StaticGearbox, Structure, Vector12,
    compliant_support::CompliantBearing,
    equilibrium::{Converged, Left, equilibrium},
    joined_meshes::{AcrossMeshes, JoinedForces, JoinedMeshes},
    rolling_bearing::RollingReply,
    train::at_mesh,
};

/// Loads that a light one is found by way of: powers of this factor, and how many.
const HEAVIER: f64 = 8.0;
const MOST_POWERS: i32 = 8;

/// Equilibrium, with what meshes and rolling bearings did there.
pub(crate) struct Trial {
    pub found: Converged,
    pub replies: Vec<MeshForces>,
    /// How joined meshes follow each other's gears.
    pub across: Vec<AcrossMeshes>,
    pub pressed: Vec<RollingReply>,
}

impl StaticGearbox {
    /// Equilibrium of the seats under a load, from `start` on.
    pub(crate) fn search(&mut self, load: &DVector<f64>, start: DVector<f64>) -> Result<Trial, GearboxError> {
        let Self {
            assembly,
            seats,
            elements,
            joined,
            to_gears,
            stiffness,
            compliant_support,
            turned_springs,
            norms,
            meshes,
            ..
        } = self;
        let (mut replies, mut across, mut pressed) = (Vec::new(), Vec::new(), Vec::new());
        let found = equilibrium(norms, load, start, |z| {
            let mut left = Left { residual: &*stiffness * z - load, tangent: stiffness.clone() };
            let displacements: Vec<Vector12> = to_gears.iter().map(|to_gears| to_gears * z).collect();
            let y = &seats.basis * z;
            let structure = assembly.structure();
            let on_bores;
            (replies, across, on_bores) =
                forces((meshes, elements), joined, (structure, compliant_support), (&displacements, &y))?;
            for (to_gears, reply) in to_gears.iter().zip(&replies) {
                left.residual -= to_gears.tr_mul(&reply.force);
                left.tangent -= to_gears.tr_mul(&(reply.tangent * to_gears));
            }
            for own in &across {
                let [of, by] =
                    [own.of, own.by].map(|part| coordinates(part, to_gears, (compliant_support, &seats.basis, &y)));
                left.tangent -= of.tr_mul(&(own.tangent * by));
            }
            if !(compliant_support.is_empty() && turned_springs.is_empty()) {
                let (mut forces, mut slopes) = (DVector::zeros(y.len()), DMatrix::zeros(y.len(), y.len()));
                let reply = |(own, bore): (&CompliantBearing, Option<RollingReply>)| {
                    let reply = bore.unwrap_or_else(|| own.reply(&y));
                    own.add(&reply, &y, &mut forces, &mut slopes);
                    reply
                };
                pressed = compliant_support.iter().zip(on_bores).map(reply).collect();
                turned_springs.iter().for_each(|own| own.add(&y, &mut forces, &mut slopes));
                left.residual -= seats.basis.tr_mul(&forces);
                left.tangent -= seats.basis.tr_mul(&(slopes * &seats.basis));
            }
            Ok(left)
        })?;
        Ok(Trial { found, replies, across, pressed })
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

/// Displacements of a mesh's gears, or of a bearing's shaft against its seat, by the coordinates z.
pub(crate) fn coordinates(
    part: usize,
    to_gears: &[OMatrix<f64, U12, Dyn>],
    (supports, basis, y): (&[CompliantBearing], &DMatrix<f64>, &DVector<f64>),
) -> OMatrix<f64, U12, Dyn> {
    match to_gears.get(part) {
        Some(own) => own.clone(),
        None => {
            let own = supports[part - to_gears.len()].slopes(y) * basis;
            OMatrix::<f64, U12, Dyn>::from_fn(basis.ncols(), |k, j| if k < 6 { own[(k, j)] } else { 0.0 })
        }
    }
}

/// Forces of all meshes, how joined ones follow each other, and forces of bearings on bores.
type AllForces = (Vec<MeshForces>, Vec<AcrossMeshes>, Vec<Option<RollingReply>>);

/// Forces of all meshes at displacements, those that gears join together; how these follow each other's gears; and forces of
/// the bearings in their bores.
fn forces(
    (meshes, elements): (&[GearMesh], &mut [Box<dyn MeshElement>]),
    joined: &mut [JoinedMeshes],
    (structure, supports): (&Structure, &[CompliantBearing]),
    (displacements, y): (&[Vector12], &DVector<f64>),
) -> Result<AllForces, GearboxError> {
    let (mut replies, mut pressed, mut across) = (vec![None; meshes.len()], vec![None; supports.len()], Vec::new());
    for own in joined {
        let found = JoinedForces { replies: &mut replies, pressed: &mut pressed, across: &mut across };
        own.evaluate((meshes, elements), (structure, supports), (displacements, y), found)?;
    }
    let alone = |(i, reply): (usize, Option<MeshForces>)| match reply {
        Some(reply) => Ok(reply),
        None => elements[i].evaluate(&displacements[i]).map_err(|source| at_mesh(&meshes[i], source)),
    };
    Ok((replies.into_iter().enumerate().map(alone).collect::<Result<_, _>>()?, across, pressed))
}
