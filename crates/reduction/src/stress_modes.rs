//! Stress modes: stress at chosen nodes straight from a window's boundary coordinates. Theory (22a), (22b), (22c).

use faer::Mat;
use mesh::Face;

use crate::{GearReducer, ReductionError, Window};

/// How the stress at a node comes from the displacement of the mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) enum StressRecovery<'a> {
    /// From Gauss points of the elements, the mean over the elements of a node ([`fem::StressOperator::new`]): any
    /// node.
    Volume,
    /// From these free faces alone, the mean over the faces of a node ([`fem::StressOperator::on_surface`]): nodes on
    /// them.
    ///
    /// On a cyclic gear the faces must be whole orbits, or all that are about the nodes.
    Surface(&'a [Vec<Face>]),
}

/// Stress at some nodes of a gear as a linear map of a window's boundary coordinates.
///
/// ```text
/// sigma = S u_B,   S = D B T,   T = [I; Phi_IC]
/// ```
/// | name      | shape       | unit   | meaning                                                             |
/// |-----------|-------------|--------|---------------------------------------------------------------------|
/// | `D B`     | 6 m x n     | MPa/mm | nodal stress of the whole mesh: extrapolated from Gauss points, then |
/// |           |             |        | the mean over the elements of the node ([`fem::StressOperator`])     |
/// | S         | 6 m x n_B   | MPa/mm | row 6 i + k: component k (xx, yy, zz, xy, yz, zx) at node i          |
///
/// Exact for loads on the boundary, as T is. Components are in the frame of the window's matrices; principal and
/// equivalent stresses do not depend on it. Source of T: Craig and Bampton, AIAA J. 6(7), 1968.
#[derive(Debug, Clone)]
pub struct StressModes {
    nodes: Vec<u32>,
    modes: Mat<f64>,
}

impl StressModes {
    /// The nodes, in the order asked for; numbers of the mesh in the frame of the window's matrices.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// S, MPa/mm.
    pub fn matrix(&self) -> &Mat<f64> {
        &self.modes
    }

    /// Stress (MPa) at each node from boundary coordinates `u` (mm).
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`].
    pub fn stress(&self, u: &[f64]) -> Result<Vec<[f64; 6]>, ReductionError> {
        if u.len() != self.modes.ncols() {
            return Err(ReductionError::WrongLength { given: u.len(), wanted: self.modes.ncols() });
        }
        let mut stress = vec![[0.0; 6]; self.nodes.len()];
        // Column by column, as the matrix lies in memory.
        for (column, &u) in self.modes.col_iter().zip(u).filter(|(_, u)| **u != 0.0) {
            for (s, &mode) in stress.as_flattened_mut().iter_mut().zip(column.iter()) {
                *s += mode * u;
            }
        }
        Ok(stress)
    }
}

impl GearReducer {
    /// Stress modes of a window for `nodes` (numbers of the mesh in the frame of the window's matrices).
    ///
    /// A cyclic gear has the same modes in all its windows: `S = (D B) [X f + T u_c]` sector by sector, f = K^ u_B.
    /// With one factor of the whole gear they are read off it for the window whose boundary is last in it; other
    /// windows take solves: S = D B K^-1 R' K^, R the window's freedoms.
    ///
    /// # Errors
    /// [`ReductionError::Fem`] when a node does not exist; [`ReductionError::NotPositiveDefinite`] as for
    /// [`GearReducer::expand`].
    pub fn stress_modes(&self, window: &Window, nodes: &[u32]) -> Result<StressModes, ReductionError> {
        let modes = self.stress_of(window, nodes, StressRecovery::Volume)?;
        Ok(StressModes { nodes: nodes.to_vec(), modes })
    }

    /// Stress modes for nodes of free faces, from the displacement of these `faces` alone (numbers of the mesh in the
    /// frame of the window's matrices): D B is [`fem::StressOperator::on_surface`]. Theory (22c).
    ///
    /// # Errors
    /// As [`GearReducer::stress_modes`].
    pub fn surface_stress_modes(
        &self,
        window: &Window,
        nodes: &[u32],
        faces: &[Vec<Face>],
    ) -> Result<StressModes, ReductionError> {
        let modes = self.stress_of(window, nodes, StressRecovery::Surface(faces))?;
        Ok(StressModes { nodes: nodes.to_vec(), modes })
    }
}
