//! The part of a factor on which some degrees of freedom depend.

use faer::{MatMut, MatRef};

use super::BoundaryLastFactor;
use crate::FemError;

/// Some supernodes of a factor with all their ancestors, and a row of a dense block for each of their columns.
///
/// Substitution with right sides on one region of a gear, for displacements of one region, goes through the branches of
/// the elimination tree that hold them and through nothing else: its time and memory are those of a few branches.
pub(super) struct Part {
    /// Whether each supernode belongs to it.
    holds: Vec<bool>,
    /// Row of each column of L; of columns outside of it without meaning.
    row: Vec<usize>,
    /// Number of rows.
    rows: usize,
}

impl Part {
    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Whether a supernode belongs to it.
    pub(super) fn holds(&self, supernode: usize) -> bool {
        self.holds[supernode]
    }

    /// Row of a column of L.
    pub(super) fn row(&self, column: usize) -> usize {
        self.row[column]
    }

    /// Rows at these `places` of L out of a block of this part.
    pub(super) fn pick(&self, places: &[usize], x: MatRef<'_, f64>, mut result: MatMut<'_, f64>) {
        for c in 0..x.ncols() {
            for (i, &place) in places.iter().enumerate() {
                result[(i, c)] = x[(self.row[place], c)];
            }
        }
    }
}

impl BoundaryLastFactor {
    /// All of the factor.
    pub(super) fn whole(&self) -> Part {
        Part { holds: vec![true; self.supernodes().count()], row: (0..self.n()).collect(), rows: self.n() }
    }

    /// The branches that hold columns of L.
    pub(super) fn part(&self, columns: impl IntoIterator<Item = usize>) -> Part {
        let mut owner = vec![0; self.n()];
        let mut holds = Vec::new();
        for node in self.supernodes() {
            owner[node.start..node.start + node.columns].fill(node.index);
            holds.push(false);
        }
        for column in columns {
            holds[owner[column]] = true;
        }
        let (mut row, mut rows) = (vec![0; self.n()], 0);
        for node in self.supernodes() {
            if !holds[node.index] {
                continue;
            }
            // The rows below a supernode all belong to ancestors, the first of them to its parent.
            if let Some(&parent) = node.pattern.first() {
                holds[owner[parent]] = true;
            }
            for (own, at) in row[node.start..node.start + node.columns].iter_mut().zip(rows..) {
                *own = at;
            }
            rows += node.columns;
        }
        Part { holds, row, rows }
    }

    /// Places in L of matrix rows.
    ///
    /// # Errors
    /// [`FemError::BadDof`] for a row that does not exist.
    pub(super) fn places(&self, dofs: &[usize]) -> Result<Vec<usize>, FemError> {
        let place =
            |&dof: &usize| self.ordering.inverse.get(dof).copied().ok_or(FemError::BadDof { dof, count: self.n() });
        dofs.iter().map(place).collect()
    }
}
