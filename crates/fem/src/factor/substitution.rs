//! Forward and backward substitution through the supernodes, up to a chosen column.

use faer::{
    Accum, Mat, MatMut, MatRef, Par,
    linalg::{
        matmul::matmul,
        triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place},
    },
    reborrow::{Reborrow, ReborrowMut},
};

use super::{BoundaryLastFactor, Supernode, part::Part};

impl Supernode<'_> {
    /// Columns of this supernode that lie before column `end` of L.
    fn columns_before(&self, end: usize) -> usize {
        self.columns.min(end.saturating_sub(self.start))
    }

    /// Row of L behind entry `k` of the block below the first `columns` rows.
    fn row_below(&self, columns: usize, k: usize) -> usize {
        let inside = self.columns - columns;
        if k < inside { self.start + columns + k } else { self.pattern[k - inside] }
    }
}

impl BoundaryLastFactor {
    /// Eliminates columns 0..`end`: x_top = L_top^-1 x_top, then x_below -= L_below x_top.
    ///
    /// With `end` = n this is L^-1 x; with `end` = interior the boundary rows become f_B - L_BI L_II^-1 f_I.
    ///
    /// Supernodes that only meet zeros are passed over: columns with few entries near each other (one fillet's stress,
    /// one tooth's load) touch their own branch of the elimination tree and nothing else. `x` has the rows of `part`.
    pub(super) fn forward(&self, part: &Part, mut x: MatMut<'_, f64>, end: usize) {
        let width = x.ncols();
        for node in self.supernodes().take_while(|s| s.start < end).filter(|s| part.holds(s.index)) {
            let columns = node.columns_before(end);
            let (top, below) = node.values.subcols(0, columns).split_at_row(columns);
            let mut x_top = x.rb_mut().subrows_mut(part.row(node.start), columns);
            if x_top.rb().col_iter().all(|c| c.iter().all(|&v| v == 0.0)) {
                continue;
            }
            solve_lower_triangular_in_place(top, x_top.rb_mut(), Par::Seq);
            let mut update = Mat::<f64>::zeros(below.nrows(), width);
            matmul(update.as_mut(), Accum::Replace, below, x_top.rb(), 1.0, Par::Seq);
            let rows: Vec<usize> = (0..below.nrows()).map(|k| part.row(node.row_below(columns, k))).collect();
            for c in 0..width {
                for (k, &row) in rows.iter().enumerate() {
                    x[(row, c)] -= update[(k, c)];
                }
            }
        }
    }

    /// Solves for rows 0..`end` with the rows from `end` on given: x_top = L_top^-T (x_top - L_below' x_below).
    ///
    /// With `end` = n this is L^-T x. `x` has the rows of `part`; supernodes that are not in `wanted` keep what they
    /// hold.
    pub(super) fn backward(&self, part: &Part, mut x: MatMut<'_, f64>, end: usize, wanted: &Part) {
        let width = x.ncols();
        let wanted = |s: &Supernode<'_>| s.start < end && wanted.holds(s.index);
        for node in self.supernodes().rev().filter(wanted) {
            let columns = node.columns_before(end);
            let (top, below) = node.values.subcols(0, columns).split_at_row(columns);
            let mut x_below = Mat::<f64>::zeros(below.nrows(), width);
            let rows: Vec<usize> = (0..below.nrows()).map(|k| part.row(node.row_below(columns, k))).collect();
            for c in 0..width {
                for (k, &row) in rows.iter().enumerate() {
                    x_below[(k, c)] = x[(row, c)];
                }
            }
            let mut x_top = x.rb_mut().subrows_mut(part.row(node.start), columns);
            matmul(x_top.rb_mut(), Accum::Add, below.transpose(), x_below.as_ref(), -1.0, Par::Seq);
            solve_upper_triangular_in_place(top.transpose(), x_top, Par::Seq);
        }
    }

    /// From the matrix's numbering into the order of elimination.
    pub(super) fn permute(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        Mat::from_fn(x.nrows(), x.ncols(), |new, c| x[(self.ordering.forward[new], c)])
    }

    /// Back from the order of elimination.
    pub(super) fn unpermute(&self, x: MatRef<'_, f64>, mut result: MatMut<'_, f64>) {
        for c in 0..x.ncols() {
            for (old, &new) in self.ordering.inverse.iter().enumerate() {
                result[(old, c)] = x[(new, c)];
            }
        }
    }
}
