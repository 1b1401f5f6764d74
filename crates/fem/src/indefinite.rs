//! Sparse L B L' factor of a symmetric indefinite matrix, such as that of a system with constraints.
//!
//! ```text
//! [ K  G' ] [ u ]   [ f ]
//! [ G  -C ] [ p ] = [ g ]
//! ```
//! Pivots of size 1 x 1 or 2 x 2 are chosen inside each supernode (Bunch and Kaufman, Math. Comp. 31, 1977).
//! Constraints and coordinates without stiffness of their own should be put `last`: they then share one dense
//! supernode, in which the choice of pivots is free.

use dyn_stack::{MemBuffer, MemStack};
use faer::{
    Conj, MatMut, Par, Side, Spec,
    perm::PermRef,
    sparse::linalg::cholesky::{IntranodeLbltRef, SymbolicCholesky},
};
use rayon::prelude::*;

use crate::{
    FemError, SymmetricMatrix,
    column_blocks::ColumnBlocksMut,
    ordering::{Ordering, supernodal, try_zeroed},
};

/// Columns that go through the factor together.
const COLUMN_BLOCK: usize = 64;

/// Factor of a symmetric matrix that need not be definite.
pub struct IndefiniteFactor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    subdiagonal: Vec<f64>,
    pivots: Vec<usize>,
    pivots_inverse: Vec<usize>,
}

impl IndefiniteFactor {
    /// Orders `matrix` (nested dissection, `last` at the end in the given order), analyses and factors it.
    ///
    /// Nothing is reused from one matrix to the next. This is the cost of a general code at each step of Newton's
    /// method when the contact set changes.
    ///
    /// # Errors
    /// [`FemError::Singular`] for a pivot that is zero or not finite, [`FemError::BadDof`],
    /// [`FemError::NotFinite`], [`FemError::OutOfMemory`], [`FemError::TooLarge`], [`FemError::Ordering`].
    pub fn new(matrix: &SymmetricMatrix, last: &[usize]) -> Result<Self, FemError> {
        if let Some((row, column, _)) = matrix.entries().find(|(_, _, v)| !v.is_finite()) {
            return Err(FemError::NotFinite { row, column });
        }
        let n = matrix.n();
        let ordering = Ordering::new(matrix, last)?;
        let symbolic = ordering.symbolic(matrix.lower().symbolic())?;
        let mut values = try_zeroed(symbolic.len_val())?;
        let mut subdiagonal = vec![0.0; n];
        let (mut pivots, mut pivots_inverse) = (vec![0; n], vec![0; n]);
        let scratch = symbolic.factorize_numeric_intranode_lblt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch)
            .map_err(|_| FemError::OutOfMemory { bytes: scratch.unaligned_bytes_required() })?;
        symbolic.factorize_numeric_intranode_lblt(
            &mut values,
            &mut subdiagonal,
            &mut pivots,
            &mut pivots_inverse,
            matrix.lower(),
            Side::Lower,
            Par::Seq,
            MemStack::new(&mut memory),
            Spec::default(),
        );
        let factor = Self { symbolic, values, subdiagonal, pivots, pivots_inverse };
        factor.check_pivots(&ordering)?;
        Ok(factor)
    }

    /// Order of the matrix.
    pub fn n(&self) -> usize {
        self.pivots.len()
    }

    /// Number of entries of the factor, including explicit zeros inside supernodes.
    pub fn nonzeros(&self) -> usize {
        self.values.len()
    }

    /// Solves A x = b in place for one or many columns.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `rhs` does not have n rows.
    pub fn solve(&self, rhs: MatMut<'_, f64>) -> Result<(), FemError> {
        if rhs.nrows() != self.n() {
            return Err(FemError::Shape { what: "rows", expected: self.n(), found: rhs.nrows() });
        }
        let order = PermRef::new_checked(&self.pivots, &self.pivots_inverse, self.n());
        let factor = IntranodeLbltRef::new(&self.symbolic, &self.values, &self.subdiagonal, order);
        rhs.par_col_chunks_mut(COLUMN_BLOCK).for_each(|block| {
            let scratch = self.symbolic.solve_in_place_scratch::<f64>(block.ncols(), Par::Seq);
            let mut memory = MemBuffer::new(scratch);
            factor.solve_in_place_with_conj(Conj::No, block, Par::Seq, MemStack::new(&mut memory));
        });
        Ok(())
    }

    /// Every 1 x 1 and 2 x 2 pivot must be invertible.
    fn check_pivots(&self, ordering: &Ordering) -> Result<(), FemError> {
        let Some(structure) = supernodal(&self.symbolic) else {
            return Ok(());
        };
        for k in 0..structure.n_supernodes() {
            let (start, end) = (structure.supernode_begin()[k], structure.supernode_end()[k]);
            let height = end - start + structure.supernode(k).pattern().len();
            let first = structure.col_ptr_for_val()[k];
            let diagonal = |c: usize| self.values[first + (c - start) * (height + 1)];
            let mut c = start;
            while c < end {
                let coupling = self.subdiagonal[c];
                let (determinant, size) = if coupling == 0.0 || c + 1 == end {
                    (diagonal(c), 1)
                } else {
                    (diagonal(c) * diagonal(c + 1) - coupling * coupling, 2)
                };
                if determinant == 0.0 || !determinant.is_finite() {
                    return Err(FemError::Singular { dof: ordering.forward[self.pivots[c]] });
                }
                c += size;
            }
        }
        Ok(())
    }
}

impl std::fmt::Debug for IndefiniteFactor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("IndefiniteFactor").field("n", &self.n()).field("nonzeros", &self.nonzeros()).finish()
    }
}
