//! Rigid bodies and their bearings.

use nalgebra::{Matrix3, Matrix6, SVector};
use serde::{Deserialize, Serialize};

/// Order of a gear's rigid coordinates: displacements x, y, z (mm) of its centre and rotations about x, y, z (rad).
pub const COORDINATES: usize = 6;
/// Displacements (mm) and rotations (rad) of pinion and wheel from their nominal motion, twelve in all.
pub type Displacement = SVector<f64, { 2 * COORDINATES }>;

/// Mass and inertia of a gear and the parts that rotate with it, about the gear's centre at mid-face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RigidBody {
    /// Mass, t.
    pub mass: f64,
    /// Inertia about an axis perpendicular to the gear's own, t mm^2.
    pub transverse_inertia: f64,
    /// Inertia about the gear's own axis, t mm^2.
    pub polar_inertia: f64,
}

impl RigidBody {
    /// Body with a mass and an inertia tensor about the gear's centre. The tensor is averaged over the rotation,
    /// because a rotating gear is treated as axisymmetric.
    pub fn of_tensor(mass: f64, inertia: [[f64; 3]; 3]) -> Self {
        Self { mass, transverse_inertia: 0.5 * (inertia[0][0] + inertia[1][1]), polar_inertia: inertia[2][2] }
    }

    /// The body with the inertia (t mm^2) of an engine, a load or a shaft on the same axis added.
    #[must_use]
    pub fn with_polar(self, added: f64) -> Self {
        Self { polar_inertia: self.polar_inertia + added, ..self }
    }

    /// Mass matrix diag(m, m, m, J_t, J_t, J_p).
    pub fn matrix(&self) -> Matrix6<f64> {
        let (m, t) = (self.mass, self.transverse_inertia);
        Matrix6::from_diagonal(&[m, m, m, t, t, self.polar_inertia].into())
    }

    /// Gyroscopic moments of a rotating body whose axis tilts, per tilt rate: m_x = -J_p Omega w_y, m_y = J_p Omega
    /// w_x. They do no work.
    pub fn gyroscopic(&self, omega: f64) -> Matrix3<f64> {
        let g = self.polar_inertia * omega;
        Matrix3::new(0.0, g, 0.0, -g, 0.0, 0.0, 0.0, 0.0, 0.0)
    }
}

/// Linear support of a gear's centre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bearing {
    /// Stiffness, 6 x 6, N/mm, N, N mm; symmetric. Zero in directions that are not held.
    pub stiffness: Matrix6<f64>,
    /// Damping, 6 x 6, N s/mm, N s, N mm s.
    pub damping: Matrix6<f64>,
}

impl Default for Bearing {
    fn default() -> Self {
        Self { stiffness: Matrix6::zeros(), damping: Matrix6::zeros() }
    }
}
