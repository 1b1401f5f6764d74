//! An elastic foundation under the bore of a gear. Theory (13d).

use nalgebra::{Matrix3, Vector3};

use crate::{Face, Mesh, MeshError};

/// Springs all around a bore, between its faces and the cross-section of the shaft.
///
/// ```text
/// t = -D u,   D = k_r e_r e_r' + k_t e_t e_t' + k_a e_z e_z'
/// K_ij = integral of N_i N_j D dA                                    over the held faces
/// ```
/// | name | unit | meaning |
/// |---|---|---|
/// | t | MPa | traction on the bore |
/// | u | mm | displacement of the bore in the gear's own frame, which moves with the shaft |
/// | k_r, k_t, k_a | N/mm^3 | stiffness per area along the radius, along the circumference, along the axis |
/// | N | 1 | shape functions of the faces |
///
/// The springs push and pull alike: the shaft has neither clearance nor a side without load. As k grows, the bore becomes
/// a rigid one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foundation {
    stiffness: [f64; 3],
}

impl Foundation {
    /// Radial, tangential and axial stiffness per area, N/mm^3, 0 where nothing holds. Tangential and axial springs hold
    /// every motion of a body; without either of them one is left free.
    ///
    /// # Errors
    /// [`MeshError::FreeBore`] if the gear could turn or move along its axis; [`MeshError::BadFoundation`] for a
    /// stiffness that is negative or not finite.
    pub fn new([radial, tangential, axial]: [f64; 3]) -> Result<Self, MeshError> {
        let stiffness = [radial, tangential, axial];
        if let Some(&found) = stiffness.iter().find(|k| !k.is_finite() || **k < 0.0) {
            return Err(MeshError::BadFoundation { found });
        }
        match (tangential > 0.0, axial > 0.0) {
            (true, true) => Ok(Self { stiffness }),
            (false, _) => Err(MeshError::FreeBore { motion: "turn about its axis", missing: "tangential" }),
            (true, false) => Err(MeshError::FreeBore { motion: "move along its axis", missing: "axial" }),
        }
    }

    /// Radial, tangential and axial stiffness per area, N/mm^3.
    pub fn stiffness(&self) -> [f64; 3] {
        self.stiffness
    }

    /// D at a place, N/mm^3, in the axes of the place. On the axis itself no direction is radial: there it is the mean of
    /// those around.
    fn at(&self, x: Vector3<f64>) -> Matrix3<f64> {
        let [radial, tangential, axial] = self.stiffness;
        let along = Vector3::z() * Vector3::z().transpose();
        let across = Matrix3::identity() - along;
        let outward = Vector3::new(x.x, x.y, 0.0);
        let own = match outward.try_normalize(0.0) {
            Some(e) => tangential * across + (radial - tangential) * e * e.transpose(),
            None => 0.5 * (radial + tangential) * across,
        };
        own + axial * along
    }

    /// K_ij (N/mm) of a face, one block for every pair i >= j of its nodes in their order.
    pub fn of_face(&self, mesh: &Mesh, face: &Face) -> Vec<([usize; 2], Matrix3<f64>)> {
        let count = face.nodes().len();
        let pairs = || (0..count).flat_map(|i| (0..=i).map(move |j| [i, j]));
        let mut blocks: Vec<_> = pairs().map(|pair| (pair, Matrix3::zeros())).collect();
        for point in face.area_points(mesh) {
            let own = point.area * self.at(point.position);
            blocks.iter_mut().for_each(|([i, j], block)| *block += point.shape[*i] * point.shape[*j] * own);
        }
        blocks
    }
}
