//! Force, moment and tangent of a bearing at given displacements.

use nalgebra::{Matrix5, Matrix6, Vector5, Vector6};

/// Reply of a bearing at displacements of its inner ring relative to the outer one: x, y, z (mm) and the rotations
/// about x and y (rad). It rotates about z without a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingReply {
    /// Elastic energy, N mm.
    pub energy: f64,
    /// Force (N) and moment about the bearing's middle (N mm) on the inner ring, -dV/dd.
    pub force: Vector5<f64>,
    /// Tangent d2V/dd2, symmetric and positive semi-definite: N/mm, N, N mm.
    pub stiffness: Matrix5<f64>,
    /// Largest force of a rolling element, N.
    pub element_force: f64,
    /// Largest pressure of a contact, MPa.
    pub pressure: f64,
    /// Number of loaded rolling elements of all rows.
    pub loaded: usize,
}

impl RollingReply {
    /// A bearing that carries nothing.
    pub(super) fn nothing() -> Self {
        let (force, stiffness) = (Vector5::zeros(), Matrix5::zeros());
        Self { energy: 0.0, force, stiffness, element_force: 0.0, pressure: 0.0, loaded: 0 }
    }

    /// Counts an element that carries.
    pub(super) fn count(&mut self, force: f64, pressure: f64) {
        self.element_force = self.element_force.max(force);
        self.pressure = self.pressure.max(pressure);
        self.loaded += 1;
    }

    /// The force with a moment about z, which is zero.
    pub(crate) fn force6(&self) -> Vector6<f64> {
        Vector6::from_fn(|i, _| if i < 5 { self.force[i] } else { 0.0 })
    }

    /// The tangent with the turn about z, which meets nothing.
    pub(crate) fn stiffness6(&self) -> Matrix6<f64> {
        with_turn(&self.stiffness)
    }
}

/// Five coordinates as six.
pub(super) fn with_turn(m: &Matrix5<f64>) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| if i < 5 && j < 5 { m[(i, j)] } else { 0.0 })
}
