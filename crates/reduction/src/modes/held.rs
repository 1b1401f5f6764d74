//! The same body with some coordinates held.

use faer::{Mat, MatRef};
use fem::dense;

use super::krylov::Pencil;
use crate::ReductionError;

/// A body whose coordinates P'u are held at zero.
///
/// ```text
/// K_held^-1 f = v - K^-1 P C^-1 P' v,   v = K^-1 f,   C = P' K^-1 P
/// ```
pub(super) struct Held<'a> {
    body: &'a dyn Pencil,
    /// Rows and shares of each coordinate.
    loads: Vec<Vec<(usize, f64)>>,
    /// L of C = L L'.
    factor: Mat<f64>,
}

/// Unit loads that are solved for at a time.
const COLUMNS: usize = 128;

impl<'a> Held<'a> {
    /// With the compliance C (mm/N) of the coordinates, if it is known.
    pub fn new(
        body: &'a dyn Pencil,
        loads: Vec<Vec<(usize, f64)>>,
        compliance: Option<MatRef<'_, f64>>,
    ) -> Result<Self, ReductionError> {
        let factor = match compliance {
            Some(c) => dense::cholesky(c)?,
            None => dense::cholesky(compliance_of(body, &loads)?.as_ref())?,
        };
        Ok(Self { body, loads, factor })
    }
}

/// C = P' K^-1 P, mm/N.
pub(super) fn compliance_of(body: &dyn Pencil, loads: &[Vec<(usize, f64)>]) -> Result<Mat<f64>, ReductionError> {
    let n = loads.len();
    let mut compliance = Mat::<f64>::zeros(n, n);
    for start in (0..n).step_by(COLUMNS) {
        let width = (n - start).min(COLUMNS);
        let unit = Mat::from_fn(n, width, |i, j| f64::from(u8::from(i == start + j)));
        let field = body.follow(spread(loads, &unit, body.order()).as_ref())?;
        compliance.as_mut().subcols_mut(start, width).copy_from(means(loads, &field));
    }
    Ok(Mat::from_fn(n, n, |i, j| 0.5 * (compliance[(i, j)] + compliance[(j, i)])))
}

/// P f.
pub(super) fn spread(loads: &[Vec<(usize, f64)>], f: &Mat<f64>, rows: usize) -> Mat<f64> {
    let mut force = Mat::zeros(rows, f.ncols());
    for (i, load) in loads.iter().enumerate() {
        for &(row, weight) in load {
            (0..f.ncols()).for_each(|j| force[(row, j)] += weight * f[(i, j)]);
        }
    }
    force
}

/// P' u.
pub(super) fn means(loads: &[Vec<(usize, f64)>], u: &Mat<f64>) -> Mat<f64> {
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
