//! One sparse Cholesky factor that gives the condensed stiffness, the compliance and the constraint modes. Theory (13).
//!
//! If the interior I is eliminated first and the boundary B last, `K = L L'` reads
//!
//! ```text
//! K_II = L_II L_II',   K_BI = L_BI L_II',   K^ = K_BB - K_BI K_II^-1 K_IB = L_BB L_BB'
//! C = K^^-1 = L_BB^-T L_BB^-1,              Phi_IC = -K_II^-1 K_IB = -L_II^-T L_BI'
//! ```
//! So K^ and C follow without a single solve, and interior displacements by back substitution alone. Source: Schur
//! complement of Guyan, AIAA J. 3(2), 1965; multifrontal method of Liu, SIAM Review 34, 1992.

mod kept;
mod part;
mod parted;
mod solves;
mod structure;
mod substitution;

pub use kept::KeptFactor;
pub use parted::PartedFactor;

use std::borrow::Cow;

use dyn_stack::{MemBuffer, MemStack};
use faer::{
    Mat, MatRef, Par, Spec,
    linalg::cholesky::llt::factor::LltError,
    sparse::{
        SparseColMat,
        linalg::cholesky::{
            SymbolicCholesky,
            supernodal::{factorize_supernodal_numeric_llt, factorize_supernodal_numeric_llt_scratch},
        },
    },
};

use crate::{
    FemError, SymmetricMatrix, Wanted, dense,
    ordering::{Ordering, supernodal, try_zeroed},
    unless_unwanted,
};
use structure::Structure;

/// A pivot this small against its diagonal entry is round-off of a body that can move freely.
///
/// Gears have ratios above 1e-8 even where an element is a thousand times thinner than the body.
const SMALLEST_PIVOT_RATIO: f64 = 1e-12;

/// Cholesky factor of a symmetric positive definite matrix in which chosen degrees of freedom come last.
///
/// All results have the same bits for any number of threads. Columns are in the order of `boundary`.
pub struct BoundaryLastFactor {
    ordering: Ordering,
    structure: Structure,
    values: Vec<f64>,
    boundary: Vec<usize>,
}

impl BoundaryLastFactor {
    /// Factors `stiffness` with the matrix rows `boundary` last, in the given order. `boundary` may be empty.
    ///
    /// # Errors
    /// [`FemError::NotPositiveDefinite`] if some part can move freely; [`FemError::BadDof`], [`FemError::NotFinite`],
    /// [`FemError::OutOfMemory`], [`FemError::TooLarge`], [`FemError::Ordering`].
    pub fn new(stiffness: &SymmetricMatrix, boundary: &[usize]) -> Result<Self, FemError> {
        Self::new_while(stiffness, boundary, &|| true)
    }

    /// As [`BoundaryLastFactor::new`], but can be cancelled: before and after ordering and factorisation `wanted` is
    /// asked whether to continue.
    ///
    /// # Errors
    /// The errors of [`BoundaryLastFactor::new`], and [`FemError::Unwanted`].
    pub fn new_while(stiffness: &SymmetricMatrix, boundary: &[usize], wanted: Wanted<'_>) -> Result<Self, FemError> {
        Self::of(Cow::Borrowed(stiffness), boundary, wanted)
    }

    /// Factors a matrix and frees it as soon as it has been permuted into the order of elimination. Only one copy of it
    /// is in memory beside the factor.
    ///
    /// # Errors
    /// The errors of [`BoundaryLastFactor::new_while`].
    pub fn in_place_of(stiffness: SymmetricMatrix, boundary: &[usize], wanted: Wanted<'_>) -> Result<Self, FemError> {
        Self::of(Cow::Owned(stiffness), boundary, wanted)
    }

    fn of(stiffness: Cow<'_, SymmetricMatrix>, boundary: &[usize], wanted: Wanted<'_>) -> Result<Self, FemError> {
        unless_unwanted(wanted)?;
        if let Some((row, column, _)) = stiffness.entries().find(|(_, _, v)| !v.is_finite()) {
            return Err(FemError::NotFinite { row, column });
        }
        let ordering = Ordering::new(&stiffness, boundary)?;
        unless_unwanted(wanted)?;
        let symbolic = ordering.symbolic(stiffness.lower().symbolic())?;
        let (diagonal, permuted) = (stiffness.diagonal(), ordering.permuted(&stiffness)?);
        drop(stiffness);
        let factor = Self::numeric((ordering, symbolic), permuted, &diagonal)?;
        unless_unwanted(wanted)?;
        Ok(factor)
    }

    /// Factor of a matrix in the order of elimination, of which the lower triangle is given; rows from `interior` on are
    /// the boundary. `diagonal`: what pivots are measured by.
    ///
    /// # Errors
    /// As [`BoundaryLastFactor::new`].
    fn in_order(lower: SparseColMat<usize, f64>, interior: usize, diagonal: &[f64]) -> Result<Self, FemError> {
        let ordering = Ordering::as_given(lower.ncols(), interior);
        let symbolic = ordering.symbolic(lower.symbolic())?;
        Self::numeric((ordering, symbolic), lower, diagonal)
    }

    /// Factor of `permuted`, with the boundary in the order of elimination.
    fn numeric(
        (ordering, symbolic): (Ordering, SymbolicCholesky<usize>),
        permuted: SparseColMat<usize, f64>,
        diagonal: &[f64],
    ) -> Result<Self, FemError> {
        let mut values = try_zeroed(symbolic.len_val())?;
        let structure = supernodal(&symbolic).map(Structure::of).unwrap_or_default();
        if let Some(structure) = supernodal(&symbolic) {
            // sequential inside: two gears are factored side by side instead, and the bits stay the same
            let scratch = factorize_supernodal_numeric_llt_scratch::<usize, f64>(structure, Par::Seq, Spec::default());
            let mut memory = MemBuffer::try_new(scratch)
                .map_err(|_| FemError::OutOfMemory { bytes: scratch.unaligned_bytes_required() })?;
            let (matrix, stack) = (permuted.as_ref(), MemStack::new(&mut memory));
            let free = Default::default();
            let result = factorize_supernodal_numeric_llt(
                &mut values,
                matrix,
                free,
                structure,
                Par::Seq,
                stack,
                Spec::default(),
            );
            if let Err(LltError::NonPositivePivot { index }) = result {
                let dof = ordering.forward.get(index).copied().unwrap_or(index);
                return Err(FemError::NotPositiveDefinite { dof, pivot_ratio: 0.0 });
            }
        }
        drop(permuted);
        let factor = Self::assembled(ordering, structure, values);
        factor.check_pivots(diagonal)?;
        Ok(factor)
    }

    fn assembled(ordering: Ordering, structure: Structure, values: Vec<f64>) -> Self {
        let boundary = ordering.forward[ordering.interior..].to_vec();
        Self { ordering, structure, values, boundary }
    }

    /// Finds pivots that are positive by luck of round-off.
    fn check_pivots(&self, diagonal: &[f64]) -> Result<(), FemError> {
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

    /// Matrix rows of the boundary, in the order of the condensed matrices.
    pub fn boundary(&self) -> &[usize] {
        &self.boundary
    }

    /// Number of entries of L below and on the diagonal, including explicit zeros inside supernodes.
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

    /// L_BB of K^ = L_BB L_BB', n_B x n_B, with zeros above the diagonal.
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
        self.structure.supernodes(&self.values)
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

impl std::fmt::Debug for BoundaryLastFactor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BoundaryLastFactor")
            .field("n", &self.n())
            .field("boundary", &self.boundary.len())
            .field("nonzeros", &self.nonzeros())
            .finish()
    }
}
