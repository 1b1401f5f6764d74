//! Assigns rows to pieces; extracts the pieces of the matrix.

use faer::{
    Mat,
    sparse::{SparseColMat, SymbolicSparseColMat},
};

use super::super::BoundaryLastFactor;
use crate::{
    FemError, SymmetricMatrix,
    ordering::{Ordering, try_zeroed},
};

/// Where a matrix row is: its number in a piece, or in the top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Piece { piece: usize, row: usize },
    Top { row: usize },
}

/// All pieces.
pub(super) struct Pieces {
    /// Of each matrix row.
    places: Vec<Place>,
    pieces: Vec<Piece>,
    /// Matrix rows of the top in order of elimination, the boundary last.
    top: Vec<usize>,
}

/// One piece.
struct Piece {
    /// Its matrix rows, in order of elimination.
    rows: Vec<usize>,
    /// Rows of the top that it has entries with, ascending.
    border: Vec<usize>,
}

impl Pieces {
    pub(super) fn new(
        stiffness: &SymmetricMatrix,
        ordering: &Ordering,
        piece_of: &[Option<u32>],
        count: usize,
    ) -> Self {
        let mut pieces: Vec<Piece> = (0..count).map(|_| Piece { rows: Vec::new(), border: Vec::new() }).collect();
        let (mut places, mut top) = (vec![Place::Top { row: 0 }; stiffness.n()], Vec::new());
        for &dof in &ordering.forward {
            places[dof] = match piece_of[dof] {
                Some(piece) => {
                    let (piece, rows) = (piece as usize, &mut pieces[piece as usize].rows);
                    rows.push(dof);
                    Place::Piece { piece, row: rows.len() - 1 }
                }
                None => {
                    top.push(dof);
                    Place::Top { row: top.len() - 1 }
                }
            };
        }
        let mut meets = vec![vec![false; top.len()]; count];
        for (row, column, _) in stiffness.entries() {
            match (places[row], places[column]) {
                (Place::Top { row }, Place::Piece { piece, .. }) | (Place::Piece { piece, .. }, Place::Top { row }) => {
                    meets[piece][row] = true;
                }
                _ => {}
            }
        }
        for (piece, meets) in pieces.iter_mut().zip(meets) {
            piece.border = meets.iter().enumerate().filter(|(_, meets)| **meets).map(|(row, _)| row).collect();
        }
        Self { places, pieces, top }
    }

    pub(super) fn count(&self) -> usize {
        self.pieces.len()
    }

    /// Where each matrix row is.
    pub(super) fn places(&self) -> &[Place] {
        &self.places
    }

    /// Matrix rows of the top.
    pub(super) fn top(&self) -> &[usize] {
        &self.top
    }

    /// Matrix rows of a piece, in order of elimination.
    pub(super) fn rows(&self, piece: usize) -> &[usize] {
        &self.pieces[piece].rows
    }

    /// Rows of the top about a piece, ascending.
    pub(super) fn border(&self, piece: usize) -> &[usize] {
        &self.pieces[piece].border
    }

    /// Factor of a piece with its border last.
    ///
    /// ```text
    /// [K_PP K_PB; K_BP K_BB]
    /// ```
    /// All that is about a piece is held, so it cannot move freely: this matrix is positive definite as K is.
    pub(super) fn factor(&self, stiffness: &SymmetricMatrix, piece: usize) -> Result<BoundaryLastFactor, FemError> {
        let Piece { rows, border } = &self.pieces[piece];
        let (interior, n) = (rows.len(), rows.len() + border.len());
        let mut on_border = vec![None; self.top.len()];
        border.iter().zip(interior..).for_each(|(&row, at)| on_border[row] = Some(at));
        let place = |dof: usize| match self.places[dof] {
            Place::Piece { piece: own, row } => (own == piece).then_some(row),
            Place::Top { row } => on_border[row],
        };
        let (starts, matrix_rows, entries) = stiffness.arrays();
        // Row, column and value of all entries.
        let visit = |tell: &mut dyn FnMut(usize, usize, f64)| {
            for (own, &column) in rows.iter().chain(border.iter().map(|&row| &self.top[row])).enumerate() {
                for k in starts[column]..starts[column + 1] {
                    if let Some(other) = place(matrix_rows[k]) {
                        tell(own.max(other), own.min(other), entries[k]);
                    }
                }
            }
        };
        let mut counts = vec![0; n + 1];
        visit(&mut |_, column, _| counts[column + 1] += 1);
        for column in 0..n {
            counts[column + 1] += counts[column];
        }
        let (mut lower_rows, mut values) = (try_zeroed(counts[n])?, try_zeroed(counts[n])?);
        let (mut next, mut diagonal) = (counts.clone(), vec![0.0; n]);
        visit(&mut |row, column, value| {
            lower_rows[next[column]] = row;
            values[next[column]] = value;
            next[column] += 1;
            if row == column {
                diagonal[row] = value;
            }
        });
        let symbolic = SymbolicSparseColMat::new_unsorted_checked(n, n, counts, None, lower_rows);
        let in_matrix = |local: usize| rows.get(local).copied().unwrap_or_else(|| self.top[border[local - interior]]);
        BoundaryLastFactor::in_order(SparseColMat::new(symbolic, values), interior, &diagonal)
            .map_err(|e| named(e, in_matrix))
    }

    /// What a piece adds to S on its border: - K_BP K_PP^-1 K_PB.
    pub(super) fn share(&self, piece: usize, stiffness: &SymmetricMatrix, factor: &BoundaryLastFactor) -> Mat<f64> {
        let (mut share, border) = (factor.condensed_stiffness(), self.border(piece));
        let (starts, rows, entries) = stiffness.arrays();
        for (own, &row) in border.iter().enumerate() {
            let dof = self.top[row];
            for k in starts[dof]..starts[dof + 1] {
                let Place::Top { row } = self.places[rows[k]] else { continue };
                if let Ok(other) = border.binary_search(&row) {
                    share[(own.max(other), own.min(other))] -= entries[k];
                }
            }
        }
        share
    }
}

/// An error of a factor with the matrix row in place of its own.
pub(super) fn named(error: FemError, in_matrix: impl Fn(usize) -> usize) -> FemError {
    match error {
        FemError::NotPositiveDefinite { dof, pivot_ratio } => {
            FemError::NotPositiveDefinite { dof: in_matrix(dof), pivot_ratio }
        }
        other => other,
    }
}

impl std::fmt::Debug for Pieces {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sizes = self.pieces.iter().map(|piece| [piece.rows.len(), piece.border.len()]);
        f.debug_struct("Pieces").field("top", &self.top.len()).field("sizes", &sizes.collect::<Vec<_>>()).finish()
    }
}
