//! An evenly loaded mesh as one spring along the line of action, with which the search for equilibrium begins.

use geometry::GearPair;
use lumped::shaft18::MeshGeometry;
use nalgebra::SMatrix;

use crate::{GearMesh, GearboxError, Vector12};

/// Turn of vectors from a mesh's axes to the common ones.
pub(crate) fn turn(direction: f64) -> SMatrix<f64, 12, 12> {
    // Along an axis exactly: a pair alone stays the pair it is.
    let (sin, cos) = if direction == 0.0 { (0.0, 1.0) } else { direction.sin_cos() };
    let mut all = SMatrix::identity();
    for at in [0, 3, 6, 9] {
        all[(at, at)] = cos;
        all[(at, at + 1)] = -sin;
        all[(at + 1, at)] = sin;
        all[(at + 1, at + 1)] = cos;
    }
    all
}

/// What displacements of both gears compress an evenly loaded mesh by, own axes.
pub(crate) fn guessed_lever(mesh: &GearMesh, meshing: &crate::Meshing) -> Result<Vector12, GearboxError> {
    let line = MeshGeometry::of_pair(&mesh.pair, meshing.side()).line();
    let line = line.map_err(|source| GearboxError::Mesh { mesh: mesh.name.clone(), source })?;
    Ok(Vector12::from_fn(|k, _| line.levers[k / 6][k % 6]))
}

/// Stiffness along the normal that the search begins with, N/mm.
pub(crate) fn guessed_stiffness(pair: &GearPair) -> f64 {
    ltca::GUESSED_LINE_STIFFNESS * pair.face_width() / pair.base_helix_angle().cos().powi(2)
}
