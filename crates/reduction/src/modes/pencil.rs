//! The interface of a vibrating body.

use faer::{Mat, MatRef};

use crate::ReductionError;

/// A body that vibrates: symmetric positive definite K and M, known by what they do.
pub(crate) trait Pencil: Sync {
    /// Rows of a vector.
    fn order(&self) -> usize;

    /// M x (t mm), column by column.
    fn inertia(&self, x: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError>;

    /// K^-1 f (mm) for forces f (N), column by column.
    fn follow(&self, f: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError>;
}
