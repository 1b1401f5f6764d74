//! A motion that nothing holds.

use nalgebra::{DMatrix, DVector, DefaultAllocator, Dim, Dyn, OMatrix, allocator::Allocator};

/// A direction of the coordinates along which no force acts: r with K r = 0, r' M r = 1.
///
/// Two motions that differ along it, by a turn of all gears or its speed, are one motion seen at two places: such a
/// difference neither grows nor dies out as others do, and would hide the exponent of those.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeDirection {
    direction: DVector<f64>,
    /// M r.
    momentum: DVector<f64>,
}

impl FreeDirection {
    /// Free direction along r, for which r' M r = 1.
    pub fn new(direction: DVector<f64>, mass: &DMatrix<f64>) -> Self {
        let momentum = mass * &direction;
        Self { direction, momentum }
    }

    /// r.
    pub fn direction(&self) -> &DVector<f64> {
        &self.direction
    }

    /// Takes it out of coordinates or velocities, column by column.
    pub fn remove<C: Dim>(&self, x: &mut OMatrix<f64, Dyn, C>)
    where
        DefaultAllocator: Allocator<Dyn, C>,
    {
        for mut column in x.column_iter_mut() {
            let share = self.momentum.dot(&column);
            column.axpy(-share, &self.direction, 1.0);
        }
    }
}
