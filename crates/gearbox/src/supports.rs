//! Bearings in series with the housing: what holds the shafts at their bearing seats. Theory (79).

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::{GearboxError, Structure};

/// Stiffness of bearings and housing, seen from the shafts; six coordinates a bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Supports {
    /// Stiffness for displacements of the shafts at the bearings.
    pub stiffness: DMatrix<f64>,
    /// Damping of the same.
    pub damping: DMatrix<f64>,
    /// Bearings alone, block by block.
    bearings: DMatrix<f64>,
    /// What the seats follow by: u_seat = R u_shaft.
    seats: DMatrix<f64>,
    housing: Option<DMatrix<f64>>,
}

impl Supports {
    /// Of the bearings and the housing of a structure that has been checked.
    ///
    /// ```text
    /// (K_b + K_h) u_seat = K_b u_shaft,   u_seat = R u_shaft,   S = K_b (1 - R),   C = (1 - R)' C_b (1 - R)
    /// ```
    /// Seats have no mass. A coordinate that neither bearing nor housing holds stays where it is.
    pub(crate) fn new(structure: &Structure) -> Result<Self, GearboxError> {
        let n = 6 * structure.bearings.len();
        let [mut bearings, mut dampers] = [0; 2].map(|_| DMatrix::zeros(n, n));
        for (i, bearing) in structure.bearings.iter().enumerate() {
            bearings.fixed_view_mut::<6, 6>(6 * i, 6 * i).copy_from(&bearing.stiffness);
            dampers.fixed_view_mut::<6, 6>(6 * i, 6 * i).copy_from(&bearing.damping);
        }
        // Files have digits: half the sum with the transpose is symmetric to the last one.
        bearings = 0.5 * (&bearings + bearings.transpose());
        dampers = 0.5 * (&dampers + dampers.transpose());
        let housing = structure.housing.as_ref().map(|k| 0.5 * (k + k.transpose()));
        let mut seats = DMatrix::zeros(n, n);
        if let Some(housing) = &housing {
            let sum = &bearings + housing;
            let held: Vec<usize> = (0..n).filter(|&i| sum[(i, i)] > 0.0).collect();
            let scale: Vec<f64> = held.iter().map(|&i| sum[(i, i)].sqrt().recip()).collect();
            let own = DMatrix::from_fn(held.len(), held.len(), |i, j| sum[(held[i], held[j])] * scale[i] * scale[j]);
            let right = DMatrix::from_fn(held.len(), n, |i, j| bearings[(held[i], j)] * scale[i]);
            let free = || fem::FemError::NotPositiveDefinite { dof: 0, pivot_ratio: 0.0 };
            let follow = Cholesky::new(own).ok_or_else(free)?.solve(&right);
            for (i, &row) in held.iter().enumerate() {
                (0..n).for_each(|j| seats[(row, j)] = scale[i] * follow[(i, j)]);
            }
        }
        let relative = DMatrix::identity(n, n) - &seats;
        let series = &bearings * &relative;
        let stiffness = 0.5 * (&series + series.transpose());
        let damping = relative.transpose() * dampers * &relative;
        Ok(Self { stiffness, damping, bearings, seats, housing })
    }

    /// Displacements of the seats in the housing when the shafts move by `u`, mm, rad.
    pub fn seats(&self, u: &DVector<f64>) -> DVector<f64> {
        &self.seats * u
    }

    /// Forces of the bearings on the shafts when these move by `u`: N, N mm.
    pub fn forces(&self, u: &DVector<f64>) -> DVector<f64> {
        -(&self.bearings * (u - self.seats(u)))
    }

    /// Twice the strain energy of each bearing, and of the housing, N mm.
    pub fn energies(&self, u: &DVector<f64>) -> (Vec<f64>, Option<f64>) {
        let seats = self.seats(u);
        let relative = u - &seats;
        let of = |i: usize| {
            let own = relative.rows(6 * i, 6);
            own.dot(&(self.bearings.view((6 * i, 6 * i), (6, 6)) * own))
        };
        let each = (0..u.len() / 6).map(of).collect();
        (each, self.housing.as_ref().map(|k| seats.dot(&(k * &seats))))
    }
}
