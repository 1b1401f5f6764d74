//! Stress modes: stress at chosen nodes straight from a window's boundary coordinates.

use std::sync::Arc;

use faer::{Accum, Mat, Par, linalg::matmul::matmul};
use fem::StressOperator;
use rayon::prelude::*;

use crate::{GearReducer, ReductionError, Window, reducer::node_dofs};

/// Nodes whose stress rows go through the factor together: 6 rows each, 240 columns of all free freedoms.
const NODE_BLOCK: usize = 40;

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
/// Exact for loads on the boundary, as T is. Components are in the frame of the window's matrices; principal and equivalent
/// stresses do not depend on it. Source: adjoint form of the constraint modes of Craig and Bampton, AIAA J. 6(7), 1968.
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
    /// Made the adjoint way: each row of D B, a sparse vector over the free freedoms, goes through the forward substitution
    /// once (`S' = T' (D B)'`), so the cost is rows and not solves for columns; with `nodes` in the order of their place, neighbours
    /// first, most of the factor is passed over. A cyclic gear has the same modes in all its windows. Other windows
    /// of a general gear take whole solves: S = D B K^-1 R' K^, R the window's freedoms.
    ///
    /// # Errors
    /// [`ReductionError::Fem`] when a node does not exist.
    pub fn stress_modes(&self, window: &Window, nodes: &[u32]) -> Result<StressModes, ReductionError> {
        let operator = StressOperator::new(self.gear().mesh(), self.material(), self.elements(), self.dofs(), nodes)?;
        let reduced = &window.reduced;
        let count = reduced.coordinates();
        let first = Arc::ptr_eq(reduced, self.first_window());
        let dofs = node_dofs(self.dofs(), &reduced.nodes);
        let mut modes = Mat::<f64>::zeros(6 * nodes.len(), count);
        for start in (0..nodes.len()).step_by(NODE_BLOCK) {
            let end = nodes.len().min(start + NODE_BLOCK);
            let mut rows = operator.transposed(start..end)?;
            let mut block = modes.as_mut().subrows_mut(6 * start, 6 * (end - start));
            if first {
                block.copy_from(self.factor().condense(rows.as_ref())?.transpose());
            } else {
                self.factor().solve(rows.as_mut())?;
                // stress of unit forces on the window, then of the forces that its unit displacements take
                let by_force = Mat::from_fn(rows.ncols(), count, |i, j| rows[(dofs[j], i)]);
                let stiffness = reduced.stiffness.as_ref();
                block.par_col_chunks_mut(64).zip(stiffness.par_col_chunks(64)).for_each(|(block, stiffness)| {
                    matmul(block, Accum::Replace, by_force.as_ref(), stiffness, 1.0, Par::Seq);
                });
            }
        }
        Ok(StressModes { nodes: nodes.to_vec(), modes })
    }
}
