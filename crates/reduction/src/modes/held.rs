//! A body with several coordinates held.

use faer::{Mat, MatRef};
use fem::dense;

use super::pencil::Pencil;
use crate::{ReductionError, load::Load};

/// Rows of a body's vectors that a unit load acts on, and their shares.
pub(super) type Rows = Vec<(usize, f64)>;

/// A body whose coordinates P'u are held at zero.
///
/// ```text
/// K_held^-1 f = v - K^-1 P C^-1 P' v,   v = K^-1 f,   C = P' K^-1 P
/// ```
pub(super) struct Held<'a> {
    body: &'a dyn Pencil,
    loads: Vec<Rows>,
    /// L of C = L L'.
    factor: Mat<f64>,
}

/// Unit loads that are solved for at a time.
const COLUMNS: usize = 128;

impl<'a> Held<'a> {
    /// Holds the coordinates on which `loads` do work.
    pub fn new(body: &'a dyn Pencil, loads: Vec<Rows>) -> Result<Self, ReductionError> {
        let n = loads.len();
        let mut compliance = Mat::<f64>::zeros(n, n);
        for start in (0..n).step_by(COLUMNS) {
            let width = (n - start).min(COLUMNS);
            let field = unit_fields(body, &loads, start, width)?;
            compliance.as_mut().subcols_mut(start, width).copy_from(means(&loads, &field));
        }
        let compliance = Mat::from_fn(n, n, |i, j| 0.5 * (compliance[(i, j)] + compliance[(j, i)]));
        Self::with_compliance(body, loads, &compliance)
    }

    /// The held body, if C is known, mm/N.
    pub fn with_compliance(
        body: &'a dyn Pencil,
        loads: Vec<Rows>,
        compliance: &Mat<f64>,
    ) -> Result<Self, ReductionError> {
        Ok(Self { body, factor: dense::cholesky(compliance.as_ref())?, loads })
    }

    /// K^-1 P L^-T: displacements of the body under forces on the held coordinates alone. Each force vector has unit
    /// strain energy and does no work on the displacements of the others.
    pub fn constraint_modes(&self) -> Result<Mat<f64>, ReductionError> {
        let n = self.loads.len();
        let mut modes = Mat::zeros(n, self.order());
        for start in (0..n).step_by(COLUMNS) {
            let width = (n - start).min(COLUMNS);
            let field = unit_fields(self.body, &self.loads, start, width)?;
            modes.as_mut().subrows_mut(start, width).copy_from(field.transpose());
        }
        dense::solve_lower(self.factor.as_ref(), modes.as_mut());
        Ok(modes.transpose().to_owned())
    }
}

/// Each load along three axes, on the rows that `row` gives its nodes.
pub(super) fn on_rows(loads: &[Load], row: impl Fn(u32, usize) -> Option<usize>) -> Vec<Rows> {
    let along = |load: &Load, axis: usize| load.iter().filter_map(|&(n, w)| Some((row(n, axis)?, w))).collect();
    loads.iter().flat_map(|load| [0, 1, 2].map(|axis| along(load, axis))).collect()
}

/// K^-1 P for the loads start .. start + width.
fn unit_fields(body: &dyn Pencil, loads: &[Rows], start: usize, width: usize) -> Result<Mat<f64>, ReductionError> {
    let unit = Mat::from_fn(loads.len(), width, |i, j| f64::from(u8::from(i == start + j)));
    body.follow(spread(loads, &unit, body.order()).as_ref())
}

/// P f.
fn spread(loads: &[Rows], f: &Mat<f64>, rows: usize) -> Mat<f64> {
    let mut force = Mat::zeros(rows, f.ncols());
    for (i, load) in loads.iter().enumerate() {
        for &(row, weight) in load {
            (0..f.ncols()).for_each(|j| force[(row, j)] += weight * f[(i, j)]);
        }
    }
    force
}

/// P' u.
fn means(loads: &[Rows], u: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(loads.len(), u.ncols(), |i, j| loads[i].iter().map(|&(row, w)| w * u[(row, j)]).sum())
}

impl Pencil for Held<'_> {
    fn order(&self) -> usize {
        self.body.order()
    }

    fn inertia(&self, x: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        self.body.inertia(x)
    }

    fn follow(&self, f: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let mut free = self.body.follow(f)?;
        let mut reaction = means(&self.loads, &free);
        dense::solve_lower(self.factor.as_ref(), reaction.as_mut());
        dense::solve_lower_transposed(self.factor.as_ref(), reaction.as_mut());
        free -= self.body.follow(spread(&self.loads, &reaction, self.order()).as_ref())?;
        Ok(free)
    }
}
