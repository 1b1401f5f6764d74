//! Number of modes, and how modes of equal frequency are counted.

use std::f64::consts::TAU;

use super::krylov::Until;

/// Selection of the normal modes to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModeChoice {
    /// This number of lowest modes. Modes of equal frequency stay together, so there may be one more.
    Count(usize),
    /// All modes up to a frequency.
    Below {
        /// Upper limit, Hz.
        hz: f64,
    },
}

/// Squares this near to each other, relatively, belong to one frequency.
const SAME: f64 = 1e-6;

impl ModeChoice {
    /// What to look for: of a number two more, to see where a frequency ends.
    pub(super) fn until(self) -> Until {
        match self {
            Self::Count(0) => Until::Count(0),
            Self::Count(count) => Until::Count(count.saturating_add(2)),
            Self::Below { hz } => Until::Below((TAU * hz.max(0.0)).powi(2)),
        }
    }

    /// How many of the squares found (ascending) to keep.
    pub(super) fn cut(self, squares: &[f64]) -> usize {
        let Self::Count(count) = self else { return squares.len() };
        let apart = |&k: &usize| k == 0 || k >= squares.len() || squares[k] > (1.0 + SAME) * squares[k - 1];
        (count.min(squares.len())..=squares.len()).find(apart).unwrap_or(squares.len())
    }
}
