//! Displacements, forces and solutions from a factor in pieces.

use std::collections::BTreeMap;

use faer::{
    Mat, MatMut, MatRef,
    reborrow::{Reborrow, ReborrowMut},
};
use rayon::prelude::*;

use super::{
    super::{
        part::Part,
        solves::{COLUMN_BLOCK, check_rows},
    },
    PartedFactor, Place,
};
use crate::{
    FemError,
    column_blocks::{ColumnBlocks, ColumnBlocksMut},
};

/// Rows that are asked for: number in the result, and row of a piece or the top.
type Asked = Vec<(usize, usize)>;

/// Forces of each column: row, N.
type Forces = Vec<Vec<(usize, f64)>>;

/// What forward substitution has left of a piece's rows.
struct Loaded {
    part: Part,
    x: Mat<f64>,
}

impl PartedFactor {
    /// Compliance C = K^^-1 (mm/N) of the boundary, both triangles.
    pub fn compliance(&self) -> Mat<f64> {
        self.top.compliance()
    }

    /// The same as [`BoundaryLastFactor::expand`](super::BoundaryLastFactor::expand).
    ///
    /// # Errors
    /// The same errors, and those of [`PartedFactor::new`] for the factor of a piece.
    pub fn expand(&self, boundary: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        let top = self.top.expand(boundary)?;
        let mut x = Mat::zeros(self.n(), boundary.ncols());
        self.substitute_back(x.as_mut(), &top, None)?;
        Ok(x)
    }

    /// The same as [`BoundaryLastFactor::condense`](super::BoundaryLastFactor::condense).
    ///
    /// # Errors
    /// The errors of [`PartedFactor::expand`].
    pub fn condense(&self, force: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        check_rows(self.n(), force.nrows())?;
        let mut x = force.to_owned();
        let top = self.eliminate(x.as_mut())?;
        self.top.condense(top.as_ref())
    }

    /// The same as [`BoundaryLastFactor::solve`](super::BoundaryLastFactor::solve).
    ///
    /// # Errors
    /// The errors of [`PartedFactor::expand`].
    pub fn solve(&self, mut rhs: MatMut<'_, f64>) -> Result<(), FemError> {
        check_rows(self.n(), rhs.nrows())?;
        let mut top = self.eliminate(rhs.rb_mut())?;
        self.top.solve(top.as_mut())?;
        self.substitute_back(rhs, &top, None)
    }

    /// The same as [`BoundaryLastFactor::solve_rows`](super::BoundaryLastFactor::solve_rows).
    ///
    /// # Errors
    /// The errors of [`PartedFactor::expand`], and [`FemError::BadDof`].
    pub fn solve_rows(&self, rhs: MatRef<'_, f64>, wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        check_rows(self.n(), rhs.nrows())?;
        let asked = self.asked(wanted)?;
        let mut x = rhs.to_owned();
        let mut top = self.eliminate(x.as_mut())?;
        self.top.solve(top.as_mut())?;
        self.substitute_back(x.as_mut(), &top, Some(&asked.0))?;
        Ok(Mat::from_fn(wanted.len(), rhs.ncols(), |i, j| x[(wanted[i], j)]))
    }

    /// The same as [`BoundaryLastFactor::expand_rows`](super::BoundaryLastFactor::expand_rows). Pieces without a wanted
    /// row are skipped.
    ///
    /// # Errors
    /// The errors of [`PartedFactor::expand`], and [`FemError::BadDof`].
    pub fn expand_rows(&self, boundary: MatRef<'_, f64>, wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        let asked = self.asked(wanted)?;
        let needed = self.needed(&asked);
        let top = self.top.expand_rows(boundary, &needed)?;
        self.rows_below(wanted.len(), &asked, (&needed, &top), BTreeMap::new())
    }

    /// The same as [`BoundaryLastFactor::solve_few`](super::BoundaryLastFactor::solve_few). Pieces without a force and
    /// without a wanted row are skipped.
    ///
    /// # Errors
    /// The errors of [`PartedFactor::expand`], and [`FemError::BadDof`].
    pub fn solve_few(&self, forces: &[Vec<(usize, f64)>], wanted: &[usize]) -> Result<Mat<f64>, FemError> {
        let asked = self.asked(wanted)?;
        let (mut on_top, mut on_pieces): (Forces, BTreeMap<usize, Forces>) =
            (vec![Vec::new(); forces.len()], BTreeMap::new());
        for (c, column) in forces.iter().enumerate() {
            for &(dof, force) in column {
                match self.place(dof)? {
                    Place::Top { row } => on_top[c].push((row, force)),
                    Place::Piece { piece, row } => {
                        let own = on_pieces.entry(piece).or_insert_with(|| vec![Vec::new(); forces.len()]);
                        own[c].push((row, force));
                    }
                }
            }
        }
        let mut loaded = BTreeMap::new();
        for (&piece, own) in &on_pieces {
            let rows = asked.0.get(&piece).into_iter().flatten().map(|&(_, row)| row);
            let below = self.forward_few(piece, own, rows)?;
            let interior = self.pieces.rows(piece).len();
            for (at, &row) in self.pieces.border(piece).iter().enumerate() {
                for (c, column) in on_top.iter_mut().enumerate() {
                    let force = below.x[(below.part.row(interior + at), c)];
                    if force != 0.0 {
                        column.push((row, force));
                    }
                }
            }
            loaded.insert(piece, below);
        }
        let needed = self.needed(&asked);
        let top = self.top.solve_few(&on_top, &needed)?;
        self.rows_below(wanted.len(), &asked, (&needed, &top), loaded)
    }

    /// Forward substitution of a piece on the branches of its `forces` and of the rows `asked`.
    fn forward_few(
        &self,
        piece: usize,
        forces: &Forces,
        asked: impl Iterator<Item = usize>,
    ) -> Result<Loaded, FemError> {
        let (factor, interior) = (self.factor(piece)?, self.pieces.rows(piece).len());
        let on_forces = forces.iter().flatten().map(|&(row, _)| row);
        let part = factor.part((interior..factor.n()).chain(on_forces).chain(asked));
        let mut x = Mat::zeros(part.rows(), forces.len());
        x.as_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(forces.par_chunks(COLUMN_BLOCK)).for_each(|(mut x, forces)| {
            for (c, column) in forces.iter().enumerate() {
                column.iter().for_each(|&(row, force)| x[(part.row(row), c)] += force);
            }
            factor.forward(&part, x, interior);
        });
        Ok(Loaded { part, x })
    }

    /// Displacements of `count` rows, those of the top given: its rows, and displacements of these.
    fn rows_below(
        &self,
        count: usize,
        (in_pieces, in_top): &(BTreeMap<usize, Asked>, Asked),
        (needed, top): (&[usize], &Mat<f64>),
        mut loaded: BTreeMap<usize, Loaded>,
    ) -> Result<Mat<f64>, FemError> {
        let width = top.ncols();
        let mut result = Mat::zeros(count, width);
        // `needed` has all rows that are asked for.
        let of_top = |row: usize, c: usize| needed.binary_search(&row).map_or(0.0, |at| top[(at, c)]);
        for &(to, row) in in_top {
            (0..width).for_each(|c| result[(to, c)] = of_top(row, c));
        }
        // Factors at hand first, before others take their place.
        let (first, then): (Vec<_>, Vec<_>) = in_pieces.iter().partition(|(piece, _)| self.is_held(**piece));
        for (&piece, asked) in first.into_iter().chain(then) {
            let (factor, interior) = (self.factor(piece)?, self.pieces.rows(piece).len());
            let rows = || asked.iter().map(|&(_, row)| row);
            let near = factor.part(rows());
            let Loaded { part, mut x } = loaded.remove(&piece).unwrap_or_else(|| {
                let part = factor.part((interior..factor.n()).chain(rows()));
                let x = Mat::zeros(part.rows(), width);
                Loaded { part, x }
            });
            for (at, &row) in self.pieces.border(piece).iter().enumerate() {
                (0..width).for_each(|c| x[(part.row(interior + at), c)] = of_top(row, c));
            }
            x.as_mut().par_col_chunks_mut(COLUMN_BLOCK).for_each(|x| factor.backward(&part, x, interior, &near));
            for &(to, row) in asked {
                (0..width).for_each(|c| result[(to, c)] = x[(part.row(row), c)]);
            }
        }
        Ok(result)
    }

    /// Forward substitution in all pieces; gives what is left on the top.
    fn eliminate(&self, mut x: MatMut<'_, f64>) -> Result<Mat<f64>, FemError> {
        self.hold_all();
        let mut top = Mat::from_fn(self.pieces.top().len(), x.ncols(), |i, j| x[(self.pieces.top()[i], j)]);
        for piece in 0..self.pieces.count() {
            let factor = self.factor(piece)?;
            let (whole, rows, border) = (factor.whole(), self.pieces.rows(piece), self.pieces.border(piece));
            let columns =
                x.rb_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(top.as_mut().par_col_chunks_mut(COLUMN_BLOCK));
            columns.for_each(|(mut x, mut top)| {
                let mut own = Mat::zeros(factor.n(), x.ncols());
                for c in 0..x.ncols() {
                    rows.iter().enumerate().for_each(|(i, &dof)| own[(i, c)] = x[(dof, c)]);
                }
                factor.forward(&whole, own.as_mut(), rows.len());
                for c in 0..x.ncols() {
                    rows.iter().enumerate().for_each(|(i, &dof)| x[(dof, c)] = own[(i, c)]);
                    border.iter().enumerate().for_each(|(i, &row)| top[(row, c)] += own[(rows.len() + i, c)]);
                }
            });
        }
        Ok(top)
    }

    /// Back substitution from the top's displacements in all pieces, or in the branches of the rows `asked`.
    fn substitute_back(
        &self,
        mut x: MatMut<'_, f64>,
        top: &Mat<f64>,
        asked: Option<&BTreeMap<usize, Asked>>,
    ) -> Result<(), FemError> {
        self.hold_all();
        for piece in (0..self.pieces.count()).filter(|piece| asked.is_none_or(|asked| asked.contains_key(piece))) {
            let factor = self.factor(piece)?;
            let whole = factor.whole();
            let near = asked.and_then(|asked| asked.get(&piece)).map(|a| factor.part(a.iter().map(|&(_, row)| row)));
            let (near, rows, border) =
                (near.as_ref().unwrap_or(&whole), self.pieces.rows(piece), self.pieces.border(piece));
            let columns = x.rb_mut().par_col_chunks_mut(COLUMN_BLOCK).zip(top.as_ref().par_col_chunks(COLUMN_BLOCK));
            columns.for_each(|(mut x, top)| {
                let mut own = Mat::zeros(factor.n(), x.ncols());
                for c in 0..x.ncols() {
                    rows.iter().enumerate().for_each(|(i, &dof)| own[(i, c)] = x[(dof, c)]);
                    border.iter().enumerate().for_each(|(i, &row)| own[(rows.len() + i, c)] = top[(row, c)]);
                }
                factor.backward(&whole, own.as_mut(), rows.len(), near);
                for c in 0..x.ncols() {
                    rows.iter().enumerate().for_each(|(i, &dof)| x[(dof, c)] = own[(i, c)]);
                }
            });
        }
        for c in 0..x.ncols() {
            self.pieces.top().iter().enumerate().for_each(|(i, &dof)| x[(dof, c)] = top.rb()[(i, c)]);
        }
        Ok(())
    }

    fn place(&self, dof: usize) -> Result<Place, FemError> {
        self.pieces.places().get(dof).copied().ok_or(FemError::BadDof { dof, count: self.n() })
    }

    /// Rows that are asked for, by piece, and those of the top.
    fn asked(&self, wanted: &[usize]) -> Result<(BTreeMap<usize, Asked>, Asked), FemError> {
        let (mut in_pieces, mut in_top) = (BTreeMap::<usize, Asked>::new(), Asked::new());
        for (to, &dof) in wanted.iter().enumerate() {
            match self.place(dof)? {
                Place::Top { row } => in_top.push((to, row)),
                Place::Piece { piece, row } => in_pieces.entry(piece).or_default().push((to, row)),
            }
        }
        Ok((in_pieces, in_top))
    }

    /// Rows of the top that displacements of these need, ascending.
    fn needed(&self, (in_pieces, in_top): &(BTreeMap<usize, Asked>, Asked)) -> Vec<usize> {
        let borders = in_pieces.keys().flat_map(|&piece| self.pieces.border(piece)).copied();
        let mut needed: Vec<usize> = borders.chain(in_top.iter().map(|&(_, row)| row)).collect();
        needed.sort_unstable();
        needed.dedup();
        needed
    }
}
