//! The motion that nothing holds: gears that turn on together.

use ::lumped::modes::linearised;
use integrate::Mechanism;
use nalgebra::{Cholesky, DMatrix, DVector, SVD};

use super::mechanism::{BoxedMechanism, ModelFailure};

/// Stiffness over the largest below which a direction is free.
const FREE: f64 = 1e-11;

/// A direction of the coordinates along which no force acts: r with K r = 0, r' M r = 1.
///
/// Two motions that differ along it, by a turn of all gears or its speed, are one motion seen at two places: such a
/// difference neither grows nor dies out as others do, and would hide the exponent of those.
pub(crate) struct FreeTurn {
    pub direction: DVector<f64>,
    /// M r.
    momentum: DVector<f64>,
}

impl FreeTurn {
    /// Of a model that stands under its load, flanks in contact; `None` where everything is held.
    ///
    /// # Errors
    /// [`ModelFailure`] where there is nothing to stand on.
    pub fn of(model: &mut BoxedMechanism) -> Result<Option<Self>, ModelFailure> {
        let start = model.start()?;
        let found = linearised(model, start.time, &start.q);
        let (stiffness, _) = found.map_err(ModelFailure::at(start.time))?;
        let (mass, n) = (model.mass().clone(), start.q.len());
        let Some(lower) = Cholesky::new(mass.clone()).map(|c| c.l()) else { return Ok(None) };
        let Some(inverse) = lower.solve_lower_triangular(&DMatrix::identity(n, n)) else { return Ok(None) };
        let svd = SVD::new(&inverse * stiffness * inverse.transpose(), false, true);
        let (Some(right), Some(i)) =
            (&svd.v_t, svd.singular_values.iter().position(|s| *s == svd.singular_values.min()))
        else {
            return Ok(None);
        };
        if svd.singular_values[i] > FREE * svd.singular_values.max() {
            return Ok(None);
        }
        let direction = inverse.transpose() * right.row(i).transpose();
        let momentum = mass * &direction;
        Ok(Some(Self { direction, momentum }))
    }

    /// Takes the free turn out of coordinates or velocities, a column.
    pub fn remove(&self, x: &mut DMatrix<f64>) {
        let share = self.momentum.dot(&x.column(0));
        x.column_mut(0).axpy(-share, &self.direction, 1.0);
    }
}
