//! The bore of a gear: the part of its width that is held, the nodes that do not move, the weights of its mean
//! displacements.

use std::collections::BTreeMap;

use nalgebra::{Matrix3x6, Matrix6, Rotation3, Vector3};

use crate::{BoreCoupling, Face, Mesh, MeshError, MeshedGear, SurfaceGroup};

impl MeshedGear {
    /// This gear, held only by the faces of its bore that lie entirely between two heights `from` <= z <= `to` (mm). A
    /// range that contains the whole bore leaves the mesh unchanged.
    ///
    /// # Errors
    /// [`MeshError::NotHeld`] if no face of the bore lies in the range.
    pub fn held_between(self, [from, to]: [f64; 2]) -> Result<Self, MeshError> {
        let heights = || self.bore.faces.iter().flat_map(Face::nodes).map(|&n| self.mesh.nodes[n as usize][2]);
        let [low, high] = heights().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], z| [a.min(z), b.max(z)]);
        // Digits of a file, not a part of an element.
        let near = 1e-6 * (high - low).max(to - from);
        let inside = |face: &&Face| {
            let z = |n: &u32| self.mesh.nodes[*n as usize][2];
            face.nodes().iter().all(|n| (from - near..=to + near).contains(&z(n)))
        };
        let faces: Vec<Face> = self.bore.faces.iter().filter(inside).copied().collect();
        if faces.is_empty() {
            return Err(MeshError::NotHeld { from_mm: from, to_mm: to, low_mm: low, high_mm: high });
        }
        let bore = SurfaceGroup { name: self.bore.name.clone(), faces };
        let coupling = self.coupling;
        Ok(Self::from_parts(self.mesh, self.teeth, bore, self.flanks, self.cuts)
            .coupled(coupling)
            .numbered(self.clockwise))
    }

    /// This gear with another coupling of its bore to the shaft.
    pub fn coupled(mut self, coupling: BoreCoupling) -> Self {
        self.coupling = coupling;
        self
    }

    /// How the bore follows the shaft.
    pub fn bore_coupling(&self) -> BoreCoupling {
        self.coupling
    }

    /// Nodes that do not move in the gear's frame, ascending: all held nodes of a rigid bore, none for another coupling.
    pub fn held_nodes(&self) -> &[u32] {
        match self.coupling {
            BoreCoupling::Kinematic => self.bore_nodes(),
            BoreCoupling::Distributing | BoreCoupling::Elastic(_) => &[],
        }
    }

    /// Stiffness of the springs under the bore of the whole gear as a rigid body on its axis at mid-face: along x, y, z (N/mm) and
    /// about them (N mm/rad); of an open sector that of its own springs. `None` where the bore stands on none.
    ///
    /// ```text
    /// S = sum of [1 -X]' D [1 -X]      X r = x cross r
    /// ```
    /// # Errors
    /// As of [`Foundation::springs`](crate::Foundation::springs).
    pub fn rigid_springs(&self) -> Result<Option<Matrix6<f64>>, MeshError> {
        let Some(foundation) = self.coupling.foundation() else { return Ok(None) };
        let mut own = Matrix6::zeros();
        for spring in foundation.springs(&self.mesh, &self.bore.faces)? {
            let nodes = spring.face.nodes().iter().zip(spring.shape);
            let at: Vector3<f64> = nodes.map(|(&n, share)| share * Vector3::from(self.mesh.nodes[n as usize])).sum();
            let mut moves = Matrix3x6::zeros();
            moves.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            moves.fixed_view_mut::<3, 3>(0, 3).copy_from(&-at.cross_matrix());
            own += moves.transpose() * spring.stiffness * moves;
        }
        let copies = if self.is_periodic_sector() { self.teeth } else { 1 };
        let copy = |k: u32| {
            let mut turn = Matrix6::zeros();
            let about = *Rotation3::from_axis_angle(&Vector3::z_axis(), self.pitches_on(k)).matrix();
            [0, 3].into_iter().for_each(|i| turn.fixed_view_mut::<3, 3>(i, i).copy_from(&about));
            turn * own * turn.transpose()
        };
        Ok(Some((0..copies).map(copy).sum()))
    }

    /// Integrals of the shape functions over the held faces, mm^2, by node, ascending. Area-weighted means are computed
    /// with them. The integrals of corner nodes of quadratic faces are negative.
    pub fn bore_weights(&self) -> Vec<(u32, f64)> {
        face_weights(&self.mesh, &self.bore.faces)
    }
}

/// Integrals of the shape functions over some faces of a mesh, mm^2, by node.
pub fn face_weights(mesh: &Mesh, faces: &[Face]) -> Vec<(u32, f64)> {
    let mut all: BTreeMap<u32, f64> = BTreeMap::new();
    for face in faces {
        for point in face.area_points(mesh) {
            for (value, &node) in point.shape.iter().zip(face.nodes()) {
                *all.entry(node).or_default() += value * point.area;
            }
        }
    }
    all.into_iter().collect()
}
