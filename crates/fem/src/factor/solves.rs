//! Displacements, forces and solutions from a factor by substitution, one block of columns after the other.

use faer::{Mat, MatMut, MatRef};
use rayon::prelude::*;

use super::BoundaryLastFactor;
use crate::{
    FemError,
    column_blocks::{ColumnBlocks, ColumnBlocksMut},
};

/// Columns that go through the factor together; measured: 16 are 1.8 times slower, 250 no faster.
pub(super) const COLUMN_BLOCK: usize = 64;

impl BoundaryLastFactor {
    /// Displacement of every degree of freedom for given boundary displacements, with the interior unloaded.
    ///
    /// ```text
    /// u = T u_B = [Phi_IC u_B; u_B],   L_II' u_I = -L_BI' u_B
    /// ```
    /// `boundary`: n_B x k (mm); result: n x k (mm) in the numbering of the matrix. The same map holds for any boundary
    /// quantity, such as velocities.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `boundary` does not have n_B rows.
    pub fn expand(&self, boundary: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.boundary.len(), boundary.nrows())?;
        let whole = self.whole();
        let mut result = Mat::zeros(self.n(), boundary.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(boundary.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(mut result, boundary)| {
                let mut x = Mat::zeros(self.n(), boundary.ncols());
                x.as_mut().subrows_mut(interior, boundary.nrows()).copy_from(boundary);
                self.backward(&whole, x.as_mut(), interior, &whole);
                self.unpermute(x.as_ref(), result.as_mut());
            },
        );
        Ok(result)
    }

    /// Displacement of every degree of freedom under forces on the interior, with the boundary held at given
    /// displacements.
    ///
    /// ```text
    /// u = [u_I; u_B],   u_I = K_II^-1 (f_I - K_IB u_B)
    /// ```
    /// `force`: n x k (N) in the numbering of the matrix, its boundary rows have no effect; `boundary`: n_B x k (mm);
    /// result: n x k (mm).
    ///
    /// # Errors
    /// [`FemError::Shape`] if `force` does not have n rows, `boundary` does not have n_B rows, or they have different
    /// numbers of columns.
    pub fn solve_held(&self, force: MatRef<'_, f64>, boundary: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.n(), force.nrows())?;
        check_rows(self.boundary.len(), boundary.nrows())?;
        if force.ncols() != boundary.ncols() {
            return Err(FemError::Shape { what: "columns", expected: force.ncols(), found: boundary.ncols() });
        }
        let whole = self.whole();
        let mut result = Mat::zeros(self.n(), force.ncols());
        let given = force.par_col_chunks(COLUMN_BLOCK).zip(boundary.par_col_chunks(COLUMN_BLOCK));
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(given).for_each(|(mut result, (force, boundary))| {
            let mut x = self.permute(force);
            self.forward(&whole, x.as_mut(), interior);
            x.as_mut().subrows_mut(interior, boundary.nrows()).copy_from(boundary);
            self.backward(&whole, x.as_mut(), interior, &whole);
            self.unpermute(x.as_ref(), result.as_mut());
        });
        Ok(result)
    }

    /// Rows `wanted` of [`BoundaryLastFactor::expand`], in this order.
    ///
    /// Back substitution skips all branches of the elimination tree without a wanted row. For one region of a gear
    /// these are most of the factor.
    ///
    /// # Errors
    /// [`FemError::Shape`] as for [`BoundaryLastFactor::expand`]; [`FemError::BadDof`] for a degree of freedom that
    /// does not exist.
    pub fn expand_rows(&self, boundary: MatRef<'_, f64>, wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.boundary.len(), boundary.nrows())?;
        let places = self.places(wanted)?;
        let (near, part) = (self.part(places.clone()), self.part(places.iter().copied().chain(interior..self.n())));
        let mut result = Mat::zeros(wanted.len(), boundary.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(boundary.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(result, boundary)| {
                let mut x = Mat::zeros(part.rows(), boundary.ncols());
                for c in 0..boundary.ncols() {
                    (0..boundary.nrows()).for_each(|i| x[(part.row(interior + i), c)] = boundary[(i, c)]);
                }
                self.backward(&part, x.as_mut(), interior, &near);
                part.pick(&places, x.as_ref(), result);
            },
        );
        Ok(result)
    }

    /// Forces on the boundary that do the same work as the given forces on all degrees of freedom.
    ///
    /// ```text
    /// f^ = T' f = f_B - L_BI L_II^-1 f_I
    /// ```
    /// `force`: n x k (N) in the numbering of the matrix; result: n_B x k (N). The adjoint of
    /// [`BoundaryLastFactor::expand`].
    ///
    /// # Errors
    /// [`FemError::Shape`] if `force` does not have n rows.
    pub fn condense(&self, force: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.n(), force.nrows())?;
        let whole = self.whole();
        let mut result = Mat::zeros(self.boundary.len(), force.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(force.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(mut result, force)| {
                let mut x = self.permute(force);
                self.forward(&whole, x.as_mut(), interior);
                result.copy_from(x.as_ref().subrows(interior, self.boundary.len()));
            },
        );
        Ok(result)
    }

    /// Solves K x = b in place for one or many columns. `rhs`: n x k, on entry b (N), on return x (mm).
    ///
    /// # Errors
    /// [`FemError::Shape`] if `rhs` does not have n rows.
    pub fn solve(&self, rhs: MatMut<'_, f64>) -> Result<(), FemError> {
        check_rows(self.n(), rhs.nrows())?;
        let whole = self.whole();
        rhs.par_col_chunks_mut(COLUMN_BLOCK).for_each(|mut rhs| {
            let mut x = self.permute(rhs.as_ref());
            self.forward(&whole, x.as_mut(), self.n());
            self.backward(&whole, x.as_mut(), self.n(), &whole);
            self.unpermute(x.as_ref(), rhs.as_mut());
        });
        Ok(())
    }

    /// Rows `wanted` of K^-1 b, in this order; `rhs`: n x k, b (N).
    ///
    /// Forward substitution skips branches whose right-hand side is zero; back substitution skips branches without a
    /// wanted row.
    ///
    /// # Errors
    /// [`FemError::Shape`], [`FemError::BadDof`] as for [`BoundaryLastFactor::expand_rows`].
    pub fn solve_rows(&self, rhs: MatRef<'_, f64>, wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        check_rows(self.n(), rhs.nrows())?;
        let (whole, places) = (self.whole(), self.places(wanted)?);
        let near = self.part(places.clone());
        let mut result = Mat::zeros(wanted.len(), rhs.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(rhs.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(result, rhs)| {
                let mut x = self.permute(rhs);
                self.forward(&whole, x.as_mut(), self.n());
                self.backward(&whole, x.as_mut(), self.n(), &near);
                whole.pick(&places, x.as_ref(), result);
            },
        );
        Ok(result)
    }

    /// Rows `wanted` of K^-1 b, in this order, for columns b with a few forces each: degree of freedom and force, N.
    ///
    /// Only branches of the elimination tree with a force or a wanted row are visited and need memory. The columns of
    /// one tooth of a gear need a share of the factor that hardly grows with the number of teeth.
    ///
    /// # Errors
    /// [`FemError::BadDof`] for a degree of freedom that does not exist.
    pub fn solve_few(&self, forces: &[Vec<(usize, f64)>], wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        let placed = |column: &Vec<(usize, f64)>| -> Result<Vec<(usize, f64)>, FemError> {
            let dofs: Vec<usize> = column.iter().map(|force| force.0).collect();
            Ok(self.places(&dofs)?.into_iter().zip(column.iter().map(|force| force.1)).collect())
        };
        let forces: Vec<Vec<(usize, f64)>> = forces.iter().map(placed).collect::<Result<_, _>>()?;
        let places = self.places(wanted)?;
        let near = self.part(places.clone());
        let loaded = forces.iter().flatten().map(|force| force.0);
        let part = self.part(places.iter().copied().chain(loaded));
        let mut result = Mat::zeros(wanted.len(), forces.len());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(forces.par_chunks(COLUMN_BLOCK)).for_each(
            |(result, forces)| {
                let mut x = Mat::zeros(part.rows(), forces.len());
                for (c, column) in forces.iter().enumerate() {
                    column.iter().for_each(|&(place, force)| x[(part.row(place), c)] += force);
                }
                self.forward(&part, x.as_mut(), self.n());
                self.backward(&part, x.as_mut(), self.n(), &near);
                part.pick(&places, x.as_ref(), result);
            },
        );
        Ok(result)
    }
}

pub(super) fn check_rows(expected: usize, found: usize) -> Result<(), FemError> {
    if expected == found { Ok(()) } else { Err(FemError::Shape { what: "rows", expected, found }) }
}
