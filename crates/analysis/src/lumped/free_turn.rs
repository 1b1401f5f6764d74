//! The motion that nothing holds: all gears rotate together.

use ::lumped::modes::linearised;
use gearbox::GearboxError;
use integrate::Mechanism;
use nalgebra::{Cholesky, DMatrix, SVD};
use periodic::FreeDirection;

use super::mechanism::BoxedMechanism;
use crate::AnalysisError;

/// Stiffness over the largest below which a direction is free.
const FREE: f64 = 1e-11;

/// The turn of all gears of a model that stands under its load, flanks in contact; `None` where everything is held.
///
/// # Errors
/// [`AnalysisError`] where there is nothing to stand on.
pub(crate) fn free_turn(model: &mut BoxedMechanism) -> Result<Option<FreeDirection>, AnalysisError> {
    let start = model.start()?;
    let found = linearised(model, start.time, &start.q);
    let (stiffness, _) = found.map_err(GearboxError::at(start.time))?;
    let (mass, n) = (model.mass().clone(), start.q.len());
    let Some(lower) = Cholesky::new(mass.clone()).map(|c| c.l()) else { return Ok(None) };
    let Some(inverse) = lower.solve_lower_triangular(&DMatrix::identity(n, n)) else { return Ok(None) };
    let svd = SVD::new(&inverse * stiffness * inverse.transpose(), false, true);
    let (Some(right), Some(i)) = (&svd.v_t, svd.singular_values.iter().position(|s| *s == svd.singular_values.min()))
    else {
        return Ok(None);
    };
    if svd.singular_values[i] > FREE * svd.singular_values.max() {
        return Ok(None);
    }
    Ok(Some(FreeDirection::new(inverse.transpose() * right.row(i).transpose(), &mass)))
}
