//! Factor of a large body with only part of it in memory at a time. Theory (13c).
//!
//! The first cuts of the nested dissection leave pieces P that share no entry of the matrix. The separators and the
//! boundary together form the top T:
//!
//! ```text
//! S = K_TT - sum over P of K_TP K_PP^-1 K_PT = L_TT L_TT'
//! ```
//! S is a small part of the factor and is kept. The factor of a piece is made to find its contribution to S and is then
//! freed. It is made again when a solution in this piece is needed.

mod pieces;
mod solves;
mod top;

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::BoundaryLastFactor;
use crate::{FemError, SymmetricMatrix, Wanted, ordering::Ordering, unless_unwanted};
use pieces::{Pieces, Place};

/// Rows of a piece at most, unless there is but one: 10^5 rows of quadratic hexahedra are 0.5 GB of factor.
const MOST_ROWS: usize = 100_000;

/// Pieces whose factors are held at a time: solutions for one tooth of a gear are in a piece, or in two neighbours.
const HELD: usize = 2;

/// Rows of a piece at least, in the mean.
const LEAST_ROWS: usize = 64;

/// Cholesky factor, in pieces, of a symmetric positive definite matrix in which chosen degrees of freedom come last.
///
/// All results have the same bits for any number of threads and any order of calls. Columns are in the order of
/// `boundary`.
pub struct PartedFactor {
    pieces: Pieces,
    factors: Factors,
    /// Matrix rows of the boundary.
    boundary: Vec<usize>,
    /// Factor of S, the boundary last.
    top: BoundaryLastFactor,
}

/// Factors of the pieces.
enum Factors {
    /// There are few pieces, all are held.
    All(Vec<Arc<BoundaryLastFactor>>),
    /// Made again from the matrix.
    Some(Box<SymmetricMatrix>, Mutex<Held>),
}

/// Factors of pieces that are at hand.
#[derive(Default)]
struct Held {
    /// By number of the piece, the last one that was asked for last.
    factors: Vec<(usize, Arc<BoundaryLastFactor>)>,
    /// Whether none goes.
    all: bool,
}

impl PartedFactor {
    /// Factors `stiffness` with the matrix rows `boundary` last, in the given order. `boundary` may be empty. Between
    /// its steps `wanted` is asked whether to continue.
    ///
    /// # Errors
    /// The errors of [`BoundaryLastFactor::new_while`].
    pub fn new(stiffness: SymmetricMatrix, boundary: &[usize], wanted: Wanted<'_>) -> Result<Self, FemError> {
        let times = halvings(stiffness.n());
        Self::halved(stiffness, boundary, times, wanted)
    }

    /// Approximate number of rows, of n, whose part of the factor is in memory at a time.
    pub fn rows_held(n: usize) -> usize {
        n.div_ceil(1 << halvings(n)).saturating_mul(HELD).min(n)
    }

    /// As [`PartedFactor::new`], with the matrix halved `times` times in succession if it is large enough.
    ///
    /// # Errors
    /// The errors of [`PartedFactor::new`].
    pub fn halved(
        stiffness: SymmetricMatrix,
        boundary: &[usize],
        times: u32,
        wanted: Wanted<'_>,
    ) -> Result<Self, FemError> {
        unless_unwanted(wanted)?;
        if let Some((row, column, _)) = stiffness.entries().find(|(_, _, v)| !v.is_finite()) {
            return Err(FemError::NotFinite { row, column });
        }
        let count = 1_usize << times.min((stiffness.n() / LEAST_ROWS).max(1).ilog2());
        let pieces = {
            let (ordering, piece_of) = Ordering::in_pieces(&stiffness, boundary, count)?;
            Pieces::new(&stiffness, &ordering, &piece_of, count)
        };
        let (mut shares, mut factors) = (Vec::with_capacity(count), Vec::new());
        for some in (0..count).collect::<Vec<_>>().chunks(HELD) {
            unless_unwanted(wanted)?;
            // Side by side as many as are held later.
            let made = some.par_iter().map(|&piece| {
                let factor = pieces.factor(&stiffness, piece)?;
                let share = pieces.share(piece, &stiffness, &factor);
                Ok(((count <= HELD).then(|| Arc::new(factor)), share))
            });
            for (factor, share) in made.collect::<Result<Vec<_>, FemError>>()? {
                factors.extend(factor);
                shares.push(share);
            }
        }
        unless_unwanted(wanted)?;
        let top = pieces.top_factor(&stiffness, &shares, boundary.len())?;
        let factors =
            if count <= HELD { Factors::All(factors) } else { Factors::Some(Box::new(stiffness), Mutex::default()) };
        Ok(Self { pieces, factors, boundary: boundary.to_vec(), top })
    }

    /// Order of the matrix, n.
    pub fn n(&self) -> usize {
        self.pieces.places().len()
    }

    /// Matrix rows of the boundary, in the order of the condensed matrices.
    pub fn boundary(&self) -> &[usize] {
        &self.boundary
    }

    /// Who goes through the whole body does so again and again: from now on no factor of a piece goes.
    fn hold_all(&self) {
        if let Factors::Some(_, held) = &self.factors {
            lock(held).all = true;
        }
    }

    /// Factor of a piece.
    fn factor(&self, piece: usize) -> Result<Arc<BoundaryLastFactor>, FemError> {
        let (stiffness, held) = match &self.factors {
            Factors::All(factors) => return Ok(factors[piece].clone()),
            Factors::Some(stiffness, held) => (stiffness, held),
        };
        // Another thread that asks meanwhile waits: nothing under this lock is shared out.
        let mut held = lock(held);
        if let Some(at) = held.factors.iter().position(|(own, _)| *own == piece) {
            let found = held.factors.remove(at);
            held.factors.push(found.clone());
            return Ok(found.1);
        }
        if !held.all && held.factors.len() == HELD {
            held.factors.remove(0);
        }
        let factor = Arc::new(self.pieces.factor(stiffness, piece)?);
        held.factors.push((piece, factor.clone()));
        Ok(factor)
    }

    /// Whether the factor of a piece is at hand.
    fn is_held(&self, piece: usize) -> bool {
        match &self.factors {
            Factors::All(_) => true,
            Factors::Some(_, held) => lock(held).factors.iter().any(|(own, _)| *own == piece),
        }
    }
}

/// How often a body of `n` rows is halved.
fn halvings(n: usize) -> u32 {
    n.div_ceil(MOST_ROWS).max(1).next_power_of_two().ilog2()
}

fn lock(held: &Mutex<Held>) -> MutexGuard<'_, Held> {
    held.lock().unwrap_or_else(PoisonError::into_inner)
}

impl std::fmt::Debug for PartedFactor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PartedFactor")
            .field("n", &self.n())
            .field("boundary", &self.boundary.len())
            .field("pieces", &self.pieces)
            .finish_non_exhaustive()
    }
}
