//! Stress modes: stress at chosen nodes straight from a window's boundary coordinates.

use std::sync::Arc;

use faer::{Accum, Mat, Par, linalg::matmul::matmul};
use fem::StressOperator;
use rayon::prelude::*;

use crate::{GearReducer, ReductionError, Window, reducer::node_dofs};

/// Columns of all free degrees of freedom held at a time: 256 of 10^5 freedoms are 200 MB.
const COLUMN_BLOCK: usize = 256;

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
/// stresses do not depend on it. Source of T: Craig and Bampton, AIAA J. 6(7), 1968.
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
    /// Made from whichever has fewer columns: the rows of D B, sparse vectors that go through the forward substitution once
    /// (the adjoint way, `S' = T' (D B)'`), or the columns of T, of which back substitution finds what D B asks for. Either way the
    /// branches of the factor that neither window nor nodes are in are passed over, so put nodes in the order of their place. A cyclic
    /// gear has the same modes in all its windows. Other windows of a general gear, whose boundary is not last in the
    /// factor, take solves: S = D B K^-1 R' K^, R the window's freedoms.
    ///
    /// # Errors
    /// [`ReductionError::Fem`] when a node does not exist.
    pub fn stress_modes(&self, window: &Window, nodes: &[u32]) -> Result<StressModes, ReductionError> {
        let operator = StressOperator::new(self.gear().mesh(), self.material(), self.elements(), self.dofs(), nodes)?;
        let columns = window.reduced.coordinates();
        let modes = if 6 * nodes.len() <= columns {
            self.modes_by_rows(window, &operator)?
        } else {
            self.modes_by_columns(window, &operator)?
        };
        Ok(StressModes { nodes: nodes.to_vec(), modes })
    }

    /// Row by row of D B.
    fn modes_by_rows(&self, window: &Window, operator: &StressOperator) -> Result<Mat<f64>, ReductionError> {
        let (m, count) = (operator.node_count(), window.reduced.coordinates());
        let first = self.is_first(window);
        let dofs = node_dofs(self.dofs(), &window.reduced.nodes);
        let mut rows = Mat::<f64>::zeros(6 * m, count);
        for start in (0..m).step_by(COLUMN_BLOCK / 6) {
            let end = m.min(start + COLUMN_BLOCK / 6);
            let block = operator.transposed(start..end)?;
            let mut result = rows.as_mut().subrows_mut(6 * start, 6 * (end - start));
            if first {
                result.copy_from(self.factor().condense(block.as_ref())?.transpose());
            } else {
                result.copy_from(self.factor().solve_rows(block.as_ref(), &dofs)?.transpose());
            }
        }
        Ok(if first { rows } else { times_stiffness(&rows, window) })
    }

    /// Column by column of T.
    fn modes_by_columns(&self, window: &Window, operator: &StressOperator) -> Result<Mat<f64>, ReductionError> {
        let (m, count) = (operator.node_count(), window.reduced.coordinates());
        let first = self.is_first(window);
        let dofs = node_dofs(self.dofs(), &window.reduced.nodes);
        let (support, operator) = operator.on_support();
        let mut stress = Mat::<f64>::zeros(6 * m, count);
        for start in (0..count).step_by(COLUMN_BLOCK) {
            let width = (count - start).min(COLUMN_BLOCK);
            let field = if first {
                let unit = Mat::from_fn(count, width, |i, j| f64::from(u8::from(i == start + j)));
                self.factor().expand_rows(unit.as_ref(), &support)?
            } else {
                let mut force = Mat::<f64>::zeros(self.dofs().free_count(), width);
                (0..width).for_each(|j| force[(dofs[start + j], j)] = 1.0);
                self.factor().solve_rows(force.as_ref(), &support)?
            };
            stress.as_mut().subcols_mut(start, width).copy_from(operator.apply(field.as_ref())?);
        }
        Ok(if first { stress } else { times_stiffness(&stress, window) })
    }

    /// Whether the window's boundary is last in the factor.
    fn is_first(&self, window: &Window) -> bool {
        Arc::ptr_eq(&window.reduced, self.first_window())
    }
}

/// From stress of unit forces on the window to that of its unit displacements: the forces that these take are K^.
fn times_stiffness(by_force: &Mat<f64>, window: &Window) -> Mat<f64> {
    let stiffness = window.reduced.stiffness.as_ref();
    let mut modes = Mat::<f64>::zeros(by_force.nrows(), stiffness.ncols());
    modes.as_mut().par_col_chunks_mut(64).zip(stiffness.par_col_chunks(64)).for_each(|(modes, stiffness)| {
        matmul(modes, Accum::Replace, by_force.as_ref(), stiffness, 1.0, Par::Seq);
    });
    modes
}
