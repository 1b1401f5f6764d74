//! A sparse symmetric matrix, stored as its lower triangle.

use faer::{
    Mat, MatMut, MatRef,
    reborrow::ReborrowMut,
    sparse::{SparseColMat, SparseColMatRef, SymbolicSparseColMat},
};
use rayon::prelude::*;

use crate::{
    FemError,
    column_blocks::{ColumnBlocks, ColumnBlocksMut},
};

/// A real symmetric sparse matrix: the lower triangle in compressed columns, rows ascending.
#[derive(Debug, Clone)]
pub struct SymmetricMatrix {
    lower: SparseColMat<usize, f64>,
}

/// Columns that are multiplied together: enough to reuse each matrix entry, few enough to stay in cache.
const COLUMN_BLOCK: usize = 8;

impl SymmetricMatrix {
    /// Wraps arrays that are known to be a sorted lower triangle.
    pub(crate) fn from_sorted_columns(n: usize, column_starts: Vec<usize>, rows: Vec<usize>, values: Vec<f64>) -> Self {
        let symbolic = SymbolicSparseColMat::new_checked(n, n, column_starts, None, rows);
        Self { lower: SparseColMat::new(symbolic, values) }
    }

    /// A matrix of order `n` from entries (row, column, value) of its lower triangle.
    ///
    /// Entries at the same position are summed in the given order. An entry above the diagonal counts as its mirror
    /// image, so give each pair once.
    ///
    /// # Errors
    /// [`FemError::BadDof`] for an index out of range, [`FemError::NotFinite`].
    pub fn from_triplets(n: usize, triplets: &[(usize, usize, f64)]) -> Result<Self, FemError> {
        let mut entries = Vec::with_capacity(triplets.len());
        for &(row, column, value) in triplets {
            let (row, column) = (row.max(column), row.min(column));
            if row >= n {
                return Err(FemError::BadDof { dof: row, count: n });
            }
            if !value.is_finite() {
                return Err(FemError::NotFinite { row, column });
            }
            entries.push((row, column, value));
        }
        entries.sort_by_key(|&(row, column, _)| (column, row)); // stable: sums keep their order
        let (mut starts, mut rows, mut values) = (vec![0; n + 1], Vec::new(), Vec::<f64>::new());
        let mut last = None;
        for (row, column, value) in entries {
            if last == Some((row, column)) {
                if let Some(sum) = values.last_mut() {
                    *sum += value;
                }
                continue;
            }
            last = Some((row, column));
            rows.push(row);
            values.push(value);
            starts[column + 1] += 1;
        }
        for column in 0..n {
            starts[column + 1] += starts[column];
        }
        Ok(Self::from_sorted_columns(n, starts, rows, values))
    }

    /// Order of the matrix.
    pub fn n(&self) -> usize {
        self.lower.ncols()
    }

    /// Number of stored entries (lower triangle).
    pub fn stored(&self) -> usize {
        self.lower.val().len()
    }

    /// The lower triangle.
    pub fn lower(&self) -> SparseColMatRef<'_, usize, f64> {
        self.lower.as_ref()
    }

    /// Starts of the columns, row indices and values of the lower triangle.
    pub(crate) fn arrays(&self) -> (&[usize], &[usize], &[f64]) {
        let symbolic = self.lower.symbolic();
        (symbolic.col_ptr(), symbolic.row_idx(), self.lower.val())
    }

    /// All stored entries of the lower triangle as (row, column, value), column by column.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let (starts, rows, values) = self.arrays();
        (0..self.n())
            .flat_map(move |column| (starts[column]..starts[column + 1]).map(move |k| (rows[k], column, values[k])))
    }

    /// Adds a value to one stored entry of the lower triangle, or to that and its mirror image.
    ///
    /// # Errors
    /// [`FemError::BadDof`] if no such entry is stored.
    pub fn add(&mut self, row: usize, column: usize, value: f64) -> Result<(), FemError> {
        let (row, column, count) = (row.max(column), row.min(column), self.n());
        let (starts, rows, _) = self.arrays();
        let bad = FemError::BadDof { dof: row, count };
        let (Some(&start), Some(&end)) = (starts.get(column), starts.get(column + 1)) else { return Err(bad) };
        let at = start + rows[start..end].binary_search(&row).map_err(|_| bad)?;
        self.lower.val_mut()[at] += value;
        Ok(())
    }

    /// Entries of the diagonal.
    pub fn diagonal(&self) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.n()];
        for (row, column, value) in self.entries() {
            if row == column {
                diagonal[row] = value;
            }
        }
        diagonal
    }

    /// Product A x for one or many columns.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `x` does not have `n()` rows.
    pub fn multiply(&self, x: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        if x.nrows() != self.n() {
            return Err(FemError::Shape { what: "rows", expected: self.n(), found: x.nrows() });
        }
        let mut product = Mat::zeros(x.nrows(), x.ncols());
        product
            .as_mut()
            .par_col_chunks_mut(COLUMN_BLOCK)
            .zip(x.par_col_chunks(COLUMN_BLOCK))
            .for_each(|(y, x)| self.add_product(y, x));
        Ok(product)
    }

    /// Product A x for one vector.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `x` does not have `n()` entries.
    pub fn multiply_vector(&self, x: &[f64]) -> Result<Vec<f64>, FemError> {
        let product = self.multiply(MatRef::from_column_major_slice(x, x.len(), 1))?;
        Ok(product.col_as_slice(0).to_vec())
    }

    /// y += A x, entry by entry in stored order.
    fn add_product(&self, mut y: MatMut<'_, f64>, x: MatRef<'_, f64>) {
        let (starts, rows, values) = self.arrays();
        for c in 0..x.ncols() {
            let (Some(x), Some(y)) = (x.col(c).try_as_col_major(), y.rb_mut().col_mut(c).try_as_col_major_mut()) else {
                add_strided(self, y.rb_mut(), x, c);
                continue;
            };
            let (x, y) = (x.as_slice(), y.as_slice_mut());
            for column in 0..self.n() {
                let (own, mut sum) = (x[column], 0.0);
                for k in starts[column]..starts[column + 1] {
                    let (row, value) = (rows[k], values[k]);
                    y[row] += value * own;
                    if row != column {
                        sum += value * x[row];
                    }
                }
                y[column] += sum;
            }
        }
    }

    /// The full matrix, both triangles; for small orders and for tests.
    pub fn to_dense(&self) -> Mat<f64> {
        let mut dense = Mat::zeros(self.n(), self.n());
        for (row, column, value) in self.entries() {
            dense[(row, column)] = value;
            dense[(column, row)] = value;
        }
        dense
    }
}

/// y[:, c] += A x[:, c] for columns that are not contiguous.
fn add_strided(a: &SymmetricMatrix, mut y: MatMut<'_, f64>, x: MatRef<'_, f64>, c: usize) {
    for (row, column, value) in a.entries() {
        y[(row, c)] += value * x[(column, c)];
        if row != column {
            y[(column, c)] += value * x[(row, c)];
        }
    }
}
