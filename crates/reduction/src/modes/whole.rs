//! A whole gear with one factor.

use faer::{Mat, MatRef};
use fem::SymmetricMatrix;

use super::pencil::Pencil;
use crate::{ReductionError, general::GeneralGear};

/// Bore held, flanks free; vectors are the free freedoms of the mesh.
pub(super) struct Whole<'a> {
    pub gear: &'a GeneralGear,
    pub mass: SymmetricMatrix,
}

impl Pencil for Whole<'_> {
    fn order(&self) -> usize {
        self.mass.n()
    }

    fn inertia(&self, x: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        Ok(self.mass.multiply(x)?)
    }

    fn follow(&self, f: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let mut u = f.to_owned();
        self.gear.solve(u.as_mut())?;
        Ok(u)
    }
}
