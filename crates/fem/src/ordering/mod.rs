//! Order of elimination: nested dissection of the interior, chosen degrees of freedom last.
//!
//! METIS dissects the graph of nodes (a browser, which has no C library, orders by minimum degree); degrees of freedom with the same neighbours count as one node. A postorder of the
//! elimination tree then groups columns of equal structure. This gives fewer and larger supernodes with the same fill.

mod graph;
#[cfg(not(target_family = "wasm"))]
mod metis;
#[cfg(any(test, target_family = "wasm"))]
mod minimum_degree;

use dyn_stack::{MemBuffer, MemStack};
use faer::{
    Side,
    perm::PermRef,
    sparse::{
        SparseColMat, SymbolicSparseColMat, SymbolicSparseColMatRef,
        linalg::{
            SupernodalThreshold,
            cholesky::{
                CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
                factorize_symbolic_cholesky, supernodal::SymbolicSupernodalCholesky,
            },
        },
        utils::{permute_self_adjoint_scratch, permute_self_adjoint_to_unsorted},
    },
};

use crate::{FemError, SymmetricMatrix};
use graph::Graph;
#[cfg(not(target_family = "wasm"))]
use metis::nested_dissection;
#[cfg(target_family = "wasm")]
use minimum_degree::nested_dissection;

/// What a dissection makes of a graph.
#[derive(Debug, PartialEq)]
struct Dissection {
    /// `order[new] = group`, with little fill.
    order: Vec<usize>,
    /// Piece of each group; [`SEPARATOR`] of those between pieces.
    piece: Vec<u32>,
}

/// In place of the number of a piece: groups that pieces have been parted by.
const SEPARATOR: u32 = u32::MAX;

/// An order of elimination and its inverse.
#[derive(Debug, Clone)]
pub struct Ordering {
    /// `forward[new] = old`.
    pub forward: Vec<usize>,
    /// `inverse[old] = new`.
    pub inverse: Vec<usize>,
    /// Number of interior degrees of freedom; the others come last, in the given order.
    pub interior: usize,
}

impl Ordering {
    /// Nested dissection of all matrix rows except `last`, followed by `last` in the given order.
    ///
    /// # Errors
    /// [`FemError::BadDof`] for a row that does not exist or is named twice, [`FemError::TooLarge`],
    /// [`FemError::Ordering`].
    pub fn new(matrix: &SymmetricMatrix, last: &[usize]) -> Result<Self, FemError> {
        Ok(Self::in_pieces(matrix, last, 1)?.0)
    }

    /// The same order, and for each matrix row the number of its piece among `pieces` (a power of 2) that share no entry
    /// of the matrix; `None` for rows between pieces, and for `last`.
    ///
    /// # Errors
    /// As [`Ordering::new`].
    pub(crate) fn in_pieces(
        matrix: &SymmetricMatrix,
        last: &[usize],
        pieces: usize,
    ) -> Result<(Self, Vec<Option<u32>>), FemError> {
        let n = matrix.n();
        let mut is_last = vec![false; n];
        for &dof in last {
            match is_last.get_mut(dof) {
                Some(seen) if !*seen => *seen = true,
                _ => return Err(FemError::BadDof { dof, count: n }),
            }
        }
        let graph = Graph::new(matrix, &is_last)?;
        let dissection = nested_dissection(&graph, pieces)?;
        let order = graph.postorder(&dissection.order);
        let mut piece_of = vec![None; n];
        for (group, &piece) in dissection.piece.iter().enumerate().filter(|(_, piece)| **piece != SEPARATOR) {
            graph.members(group).iter().for_each(|&dof| piece_of[dof] = Some(piece));
        }
        let mut forward: Vec<usize> = order.iter().flat_map(|&group| graph.members(group)).copied().collect();
        forward.extend_from_slice(last);
        let mut inverse = vec![0; n];
        for (new, &old) in forward.iter().enumerate() {
            inverse[old] = new;
        }
        Ok((Self { forward, inverse, interior: n - last.len() }, piece_of))
    }

    /// Rows as they are, those from `interior` on last.
    pub(crate) fn as_given(n: usize, interior: usize) -> Self {
        Self { forward: (0..n).collect(), inverse: (0..n).collect(), interior }
    }

    /// The matrix in this order, rows of a column unsorted: what a factor reads.
    ///
    /// # Errors
    /// [`FemError::OutOfMemory`].
    pub(crate) fn permuted(&self, matrix: &SymmetricMatrix) -> Result<SparseColMat<usize, f64>, FemError> {
        let (n, count) = (matrix.n(), matrix.stored());
        let mut values = try_zeroed(count)?;
        let (mut starts, mut rows) = (try_zeroed(n + 1)?, try_zeroed(count)?);
        let scratch = permute_self_adjoint_scratch::<usize>(n);
        let mut memory = MemBuffer::try_new(scratch)
            .map_err(|_| FemError::OutOfMemory { bytes: scratch.unaligned_bytes_required() })?;
        let order = PermRef::new_checked(&self.forward, &self.inverse, n);
        permute_self_adjoint_to_unsorted(
            &mut values,
            &mut starts,
            &mut rows,
            matrix.lower(),
            order,
            Side::Lower,
            Side::Lower,
            MemStack::new(&mut memory),
        );
        Ok(SparseColMat::new(SymbolicSparseColMat::new_unsorted_checked(n, n, starts, None, rows), values))
    }

    /// Symbolic supernodal factor of the matrix in this order, from its lower triangle.
    pub(crate) fn symbolic(
        &self,
        lower: SymbolicSparseColMatRef<'_, usize>,
    ) -> Result<SymbolicCholesky<usize>, FemError> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let order = PermRef::new_checked(&self.forward, &self.inverse, lower.ncols());
        let order = SymmetricOrdering::Custom(order);
        factorize_symbolic_cholesky(lower, Side::Lower, order, params)
            .map_err(|_| FemError::OutOfMemory { bytes: size_of_val(lower.row_idx()) })
    }
}

/// The supernodal structure, which the symbolic factor has been forced to have.
pub(crate) fn supernodal(symbolic: &SymbolicCholesky<usize>) -> Option<&SymbolicSupernodalCholesky<usize>> {
    match symbolic.raw() {
        SymbolicCholeskyRaw::Supernodal(structure) => Some(structure),
        SymbolicCholeskyRaw::Simplicial(_) => None,
    }
}

/// Zeroed memory for a factor, or a typed error where the system refuses it.
pub(crate) fn try_zeroed<T: Copy + Default>(count: usize) -> Result<Vec<T>, FemError> {
    let mut values = Vec::new();
    values
        .try_reserve_exact(count)
        .map_err(|_| FemError::OutOfMemory { bytes: count.saturating_mul(size_of::<T>()) })?;
    values.resize(count, T::default());
    Ok(values)
}
