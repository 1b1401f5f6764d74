//! One sparse Cholesky factor that holds the condensed stiffness, the compliance and the constraint modes. Theory (13).
//!
//! With the interior I eliminated first and the boundary B last, `K = L L'` reads
//!
//! ```text
//! K_II = L_II L_II',   K_BI = L_BI L_II',   K^ = K_BB - K_BI K_II^-1 K_IB = L_BB L_BB'
//! C = K^^-1 = L_BB^-T L_BB^-1,              Phi_IC = -K_II^-1 K_IB = -L_II^-T L_BI'
//! ```
//! so that K^ and C come without a single solve, and interior displacements by back substitution alone.
//! Source: the Schur complement of Guyan, AIAA J. 3(2), 1965; multifrontal view of Liu, SIAM Review 34, 1992.

mod substitution;

use dyn_stack::{MemBuffer, MemStack};
use faer::{
    Mat, MatMut, MatRef, Par, Side, Spec,
    linalg::cholesky::llt::factor::LltError,
    sparse::linalg::cholesky::{SymbolicCholesky, supernodal::SupernodalLltRef},
};
use rayon::prelude::*;

use crate::{
    FemError, SymmetricMatrix, dense,
    ordering::{Ordering, supernodal, try_zeroed},
};

/// Columns that go through the factor together; measured: 16 are 1.8 times slower, 250 no faster.
const COLUMN_BLOCK: usize = 64;

/// A pivot this small against its diagonal entry is round-off of a body that can move freely.
///
/// Gears have ratios above 1e-8 even where an element is a thousand times thinner than the body.
const SMALLEST_PIVOT_RATIO: f64 = 1e-12;

/// Cholesky factor of a symmetric positive definite matrix with chosen degrees of freedom last.
///
/// All results are the same bits for any number of threads. Columns are in the order of `boundary`.
pub struct BoundaryLastFactor {
    ordering: Ordering,
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    boundary: Vec<usize>,
}

impl BoundaryLastFactor {
    /// Factors `stiffness` with `boundary` (matrix rows, in the order wanted) last. May be empty.
    ///
    /// # Errors
    /// [`FemError::NotPositiveDefinite`] when something can move freely, [`FemError::BadDof`],
    /// [`FemError::NotFinite`], [`FemError::OutOfMemory`], [`FemError::TooLarge`], [`FemError::Ordering`].
    pub fn new(stiffness: &SymmetricMatrix, boundary: &[usize]) -> Result<Self, FemError> {
        if let Some((row, column, _)) = stiffness.entries().find(|(_, _, v)| !v.is_finite()) {
            return Err(FemError::NotFinite { row, column });
        }
        let ordering = Ordering::new(stiffness, boundary)?;
        let symbolic = ordering.symbolic(stiffness)?;
        let mut values = try_zeroed(symbolic.len_val())?;
        // sequential inside: two gears are factored side by side instead, and the bits stay the same
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch)
            .map_err(|_| FemError::OutOfMemory { bytes: scratch.unaligned_bytes_required() })?;
        let result = symbolic.factorize_numeric_llt(
            &mut values,
            stiffness.lower(),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Spec::default(),
        );
        if let Err(LltError::NonPositivePivot { index }) = result {
            let dof = ordering.forward.get(index).copied().unwrap_or(index);
            return Err(FemError::NotPositiveDefinite { dof, pivot_ratio: 0.0 });
        }
        let factor = Self { ordering, symbolic, values, boundary: boundary.to_vec() };
        factor.check_pivots(stiffness)?;
        Ok(factor)
    }

    /// Finds pivots that are positive by luck of round-off.
    fn check_pivots(&self, stiffness: &SymmetricMatrix) -> Result<(), FemError> {
        let diagonal = stiffness.diagonal();
        let mut worst = (f64::INFINITY, 0);
        for node in self.supernodes() {
            for column in 0..node.columns {
                let (pivot, dof) = (node.values[(column, column)], self.ordering.forward[node.start + column]);
                let ratio = pivot * pivot / diagonal[dof];
                if ratio.is_nan() || ratio < worst.0 {
                    worst = (ratio, dof);
                }
            }
        }
        let (pivot_ratio, dof) = worst;
        if pivot_ratio > SMALLEST_PIVOT_RATIO {
            Ok(())
        } else {
            Err(FemError::NotPositiveDefinite { dof, pivot_ratio })
        }
    }

    /// Order of the matrix, n.
    pub fn n(&self) -> usize {
        self.ordering.forward.len()
    }

    /// The boundary's matrix rows, in the order of the condensed matrices.
    pub fn boundary(&self) -> &[usize] {
        &self.boundary
    }

    /// Entries of L below and on the diagonal, explicit zeros inside supernodes included.
    pub fn nonzeros(&self) -> usize {
        self.supernodes().map(|s| s.columns * (s.columns + 1) / 2 + s.columns * s.pattern.len()).sum()
    }

    /// Floating-point operations of the factorisation, estimated from the structure of L.
    pub fn flops(&self) -> f64 {
        let heights = self.supernodes().flat_map(|s| (0..s.columns).map(move |c| s.values.nrows() - c));
        heights.map(|h| (h as f64) * (h as f64)).sum()
    }

    /// Condensed stiffness K^ = L_BB L_BB' (N/mm), n_B x n_B, both triangles.
    pub fn condensed_stiffness(&self) -> Mat<f64> {
        dense::times_transpose(self.boundary_factor().as_ref())
    }

    /// Compliance C = K^^-1 (mm/N) of the boundary, n_B x n_B, both triangles.
    pub fn compliance(&self) -> Mat<f64> {
        dense::inverse_of_product(self.boundary_factor().as_ref())
    }

    /// Displacement of every degree of freedom for given boundary displacements, interior unloaded.
    ///
    /// ```text
    /// u = T u_B = [Phi_IC u_B; u_B],   L_II' u_I = -L_BI' u_B
    /// ```
    /// `boundary`: n_B x k (mm); result: n x k (mm) in the matrix's own numbering. The same map carries any
    /// boundary quantity, velocities for instance.
    ///
    /// # Errors
    /// [`FemError::Shape`] when `boundary` does not have n_B rows.
    pub fn expand(&self, boundary: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.boundary.len(), boundary.nrows())?;
        let mut result = Mat::zeros(self.n(), boundary.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(boundary.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(mut result, boundary)| {
                let mut x = Mat::zeros(self.n(), boundary.ncols());
                x.as_mut().subrows_mut(interior, boundary.nrows()).copy_from(boundary);
                self.backward(x.as_mut(), interior, None);
                self.unpermute(x.as_ref(), result.as_mut());
            },
        );
        Ok(result)
    }

    /// Displacement of every degree of freedom under forces on the interior, the boundary held where it is.
    ///
    /// ```text
    /// u = [u_I; u_B],   u_I = K_II^-1 (f_I - K_IB u_B)
    /// ```
    /// `force`: n x k (N) in the matrix's own numbering, its boundary rows have no effect; `boundary`: n_B x k (mm); result:
    /// n x k (mm).
    ///
    /// # Errors
    /// [`FemError::Shape`] when `force` does not have n rows, `boundary` not n_B, or they differ in columns.
    pub fn solve_held(&self, force: MatRef<'_, f64>, boundary: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.n(), force.nrows())?;
        check_rows(self.boundary.len(), boundary.nrows())?;
        if force.ncols() != boundary.ncols() {
            return Err(FemError::Shape { what: "columns", expected: force.ncols(), found: boundary.ncols() });
        }
        let mut result = Mat::zeros(self.n(), force.ncols());
        let given = force.par_col_chunks(COLUMN_BLOCK).zip(boundary.par_col_chunks(COLUMN_BLOCK));
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(given).for_each(|(mut result, (force, boundary))| {
            let mut x = self.permute(force);
            self.forward(x.as_mut(), interior);
            x.as_mut().subrows_mut(interior, boundary.nrows()).copy_from(boundary);
            self.backward(x.as_mut(), interior, None);
            self.unpermute(x.as_ref(), result.as_mut());
        });
        Ok(result)
    }

    /// Rows `wanted` of [`BoundaryLastFactor::expand`], in that order.
    ///
    /// Back substitution passes over all branches of the elimination tree that hold none of them: for one region of a gear
    /// that is most of the factor.
    ///
    /// # Errors
    /// [`FemError::Shape`] as for [`BoundaryLastFactor::expand`]; [`FemError::BadDof`] for a degree of freedom that does not exist.
    pub fn expand_rows(&self, boundary: MatRef<'_, f64>, wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.boundary.len(), boundary.nrows())?;
        let near = self.near(wanted)?;
        let mut result = Mat::zeros(wanted.len(), boundary.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(boundary.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(mut result, boundary)| {
                let mut x = Mat::zeros(self.n(), boundary.ncols());
                x.as_mut().subrows_mut(interior, boundary.nrows()).copy_from(boundary);
                self.backward(x.as_mut(), interior, Some(&near.branches));
                near.pick(x.as_ref(), result.as_mut());
            },
        );
        Ok(result)
    }

    /// Forces on the boundary that do the same work as given forces on all degrees of freedom.
    ///
    /// ```text
    /// f^ = T' f = f_B - L_BI L_II^-1 f_I
    /// ```
    /// `force`: n x k (N) in the matrix's own numbering; result: n_B x k (N). The adjoint of
    /// [`BoundaryLastFactor::expand`].
    ///
    /// # Errors
    /// [`FemError::Shape`] when `force` does not have n rows.
    pub fn condense(&self, force: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        let interior = self.ordering.interior;
        check_rows(self.n(), force.nrows())?;
        let mut result = Mat::zeros(self.boundary.len(), force.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(force.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(mut result, force)| {
                let mut x = self.permute(force);
                self.forward(x.as_mut(), interior);
                result.copy_from(x.as_ref().subrows(interior, self.boundary.len()));
            },
        );
        Ok(result)
    }

    /// Solves K x = b in place for one or many columns; `rhs`: n x k, b (N) in, x (mm) out.
    ///
    /// # Errors
    /// [`FemError::Shape`] when `rhs` does not have n rows.
    pub fn solve(&self, rhs: MatMut<'_, f64>) -> Result<(), FemError> {
        check_rows(self.n(), rhs.nrows())?;
        rhs.par_col_chunks_mut(COLUMN_BLOCK).for_each(|mut rhs| {
            let mut x = self.permute(rhs.as_ref());
            self.forward(x.as_mut(), self.n());
            self.backward(x.as_mut(), self.n(), None);
            self.unpermute(x.as_ref(), rhs.as_mut());
        });
        Ok(())
    }

    /// Rows `wanted` of K^-1 b, in that order; `rhs`: n x k, b (N).
    ///
    /// Forward substitution passes over what meets zeros only, back substitution over branches without a wanted row.
    ///
    /// # Errors
    /// [`FemError::Shape`], [`FemError::BadDof`] as for [`BoundaryLastFactor::expand_rows`].
    pub fn solve_rows(&self, rhs: MatRef<'_, f64>, wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        check_rows(self.n(), rhs.nrows())?;
        let near = self.near(wanted)?;
        let mut result = Mat::zeros(wanted.len(), rhs.ncols());
        result.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(rhs.par_col_chunks(COLUMN_BLOCK)).for_each(
            |(mut result, rhs)| {
                let mut x = self.permute(rhs);
                self.forward(x.as_mut(), self.n());
                self.backward(x.as_mut(), self.n(), Some(&near.branches));
                near.pick(x.as_ref(), result.as_mut());
            },
        );
        Ok(result)
    }

    /// Where the freedoms `wanted` are, and which supernodes back substitution needs for them: those that hold one, and all
    /// their ancestors.
    fn near(&self, wanted: &[usize]) -> Result<Near, FemError> {
        let mut owner = vec![0; self.n()];
        let mut needed = Vec::new();
        for node in self.supernodes() {
            owner[node.start..node.start + node.columns].fill(node.index);
            needed.push(false);
        }
        let places: Vec<usize> = wanted
            .iter()
            .map(|&dof| {
                let place = self.ordering.inverse.get(dof).copied();
                place.ok_or(FemError::BadDof { dof, count: self.n() })
            })
            .collect::<Result<_, _>>()?;
        for &place in &places {
            needed[owner[place]] = true;
        }
        for node in self.supernodes() {
            // The rows below a supernode all belong to ancestors, the first of them to its parent.
            if let (true, Some(&row)) = (needed[node.index], node.pattern.first()) {
                needed[owner[row]] = true;
            }
        }
        Ok(Near { places, branches: needed })
    }

    /// L_BB, n_B x n_B, zeros above the diagonal: K^ = L_BB L_BB'.
    pub fn boundary_factor(&self) -> Mat<f64> {
        let (interior, size) = (self.ordering.interior, self.boundary.len());
        let mut l = Mat::zeros(size, size);
        for node in self.supernodes().filter(|s| s.start + s.columns > interior) {
            // a supernode may begin in the interior: its later columns are the boundary's
            for c in interior.saturating_sub(node.start)..node.columns {
                let column = node.start + c - interior;
                for r in c..node.columns {
                    l[(node.start + r - interior, column)] = node.values[(r, c)];
                }
                for (k, &row) in node.pattern.iter().enumerate() {
                    l[(row - interior, column)] = node.values[(node.columns + k, c)];
                }
            }
        }
        l
    }

    /// The supernodes in order of elimination.
    fn supernodes(&self) -> impl DoubleEndedIterator<Item = Supernode<'_>> {
        let structure = supernodal(&self.symbolic);
        structure.into_iter().flat_map(move |structure| {
            let factor = SupernodalLltRef::<usize, f64>::new(structure, &self.values);
            (0..structure.n_supernodes()).map(move |k| {
                let node = factor.supernode(k);
                let values = node.val();
                Supernode { index: k, start: node.start(), columns: values.ncols(), pattern: node.pattern(), values }
            })
        })
    }
}

/// Some freedoms and the part of the factor that they depend on.
struct Near {
    /// Their places in the order of elimination.
    places: Vec<usize>,
    /// For each supernode whether back substitution has to go through it.
    branches: Vec<bool>,
}

impl Near {
    /// Their rows of `x` (in the order of elimination) into `result`.
    fn pick(&self, x: MatRef<'_, f64>, mut result: MatMut<'_, f64>) {
        for c in 0..x.ncols() {
            for (i, &place) in self.places.iter().enumerate() {
                result[(i, c)] = x[(place, c)];
            }
        }
    }
}

/// A run of columns of L with one structure: a dense lower triangle on top of a dense block.
struct Supernode<'a> {
    /// Number in order of elimination.
    index: usize,
    /// First column.
    start: usize,
    /// Number of columns.
    columns: usize,
    /// Rows of the block below the triangle.
    pattern: &'a [usize],
    /// Triangle (upper part unused) and block, (columns + pattern) x columns.
    values: MatRef<'a, f64>,
}

fn check_rows(expected: usize, found: usize) -> Result<(), FemError> {
    if expected == found { Ok(()) } else { Err(FemError::Shape { what: "rows", expected, found }) }
}

impl std::fmt::Debug for BoundaryLastFactor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BoundaryLastFactor")
            .field("n", &self.n())
            .field("boundary", &self.boundary.len())
            .field("nonzeros", &self.nonzeros())
            .finish()
    }
}
