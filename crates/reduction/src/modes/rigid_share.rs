//! Inertia that modes share with the rigid motion of their gear, in axes that do not rotate. Theory (62).

use nalgebra::{DMatrix, Matrix6, Vector6};

use super::GearModes;

impl GearModes {
    /// L D: inertia that each mode shares with displacements along and rotations about fixed axes, when the gear's own
    /// frame is at `angle` (rad, about +z), m x 6: t^(1/2), t^(1/2) mm.
    pub fn coupling_at(&self, angle: f64) -> DMatrix<f64> {
        let (sin, cos) = angle.sin_cos();
        let own = self.coupling();
        DMatrix::from_fn(own.len(), 6, |i, axis| match axis % 3 {
            // L turned back: the gear's x axis stands at the angle in the common frame.
            0 => cos * own[i][axis] - sin * own[i][axis + 1],
            1 => sin * own[i][axis - 1] + cos * own[i][axis],
            _ => own[i][axis],
        })
    }

    /// Derivative d(L D)/d(angle) at an angle (rad), m x 6.
    pub fn coupling_rate_at(&self, angle: f64) -> DMatrix<f64> {
        let mut rate = self.coupling_at(angle + std::f64::consts::FRAC_PI_2);
        [2, 5].into_iter().for_each(|axis| rate.column_mut(axis).fill(0.0));
        rate
    }

    /// L' L, averaged over a rotation; for a cyclic gear it is the same at every angle. Units t, t mm, t mm^2.
    pub fn shared_inertia(&self) -> Matrix6<f64> {
        let own = self.coupling().iter().fold(Matrix6::zeros(), |sum: Matrix6<f64>, row| {
            let l = Vector6::from_column_slice(row);
            sum + l * l.transpose()
        });
        let mut round = Matrix6::zeros();
        for (a, b) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
            let (same, across) = (own[(a, b)] + own[(a + 1, b + 1)], own[(a, b + 1)] - own[(a + 1, b)]);
            (round[(a, b)], round[(a + 1, b + 1)]) = (0.5 * same, 0.5 * same);
            (round[(a, b + 1)], round[(a + 1, b)]) = (0.5 * across, -0.5 * across);
            round[(a + 2, b + 2)] = own[(a + 2, b + 2)];
        }
        round
    }
}
