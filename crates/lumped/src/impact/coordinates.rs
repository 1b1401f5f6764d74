//! Free coordinates of rigid gears, and their displacements.

use dynamics::{COORDINATES, Displacement};
use geometry::GearPair;
use ltca::StaticOptions;
use nalgebra::{DMatrix, DVector};

/// Free coordinates of a pair and what they do to the gears: d = T q.
///
/// The coordinate of the driven gear is its lag in mm on the base circle: the dynamic transmission error without its
/// kinematic part. It keeps all its digits after any number of rotations.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidCoordinates {
    /// T, 12 x n.
    map: DMatrix<f64>,
    lag: usize,
    driver_turn: Option<usize>,
}

impl RigidCoordinates {
    /// `free[g][i]`: whether coordinate i of gear g is free; the driven gear's turn always is.
    pub(super) fn new(pair: &GearPair, running: &StaticOptions, free: &[[bool; COORDINATES]; 2]) -> Self {
        let (gears, driven) = ([&pair.pinion, &pair.wheel], running.driven());
        let [turn, driver] = [driven, 1 - driven].map(|gear| COORDINATES * (gear + 1) - 1);
        let (mut lag, mut driver_turn) = (0, None);
        let mut columns: Vec<Displacement> = Vec::new();
        for (own, is_free) in free.concat().into_iter().enumerate() {
            let mut column = Displacement::zeros();
            if own == turn {
                column[own] = running.side().sign() / gears[driven].base_radius();
                lag = columns.len();
            } else if is_free {
                column[own] = 1.0;
            } else {
                continue;
            }
            if own == driver {
                // The driver turns on: the driven gear follows in the ratio of the teeth.
                column[turn] = -gears[1 - driven].signed_teeth() / gears[driven].signed_teeth();
                driver_turn = Some(columns.len());
            }
            columns.push(column);
        }
        Self { map: DMatrix::from_fn(2 * COORDINATES, columns.len(), |i, j| columns[j][i]), lag, driver_turn }
    }

    /// T.
    pub fn map(&self) -> &DMatrix<f64> {
        &self.map
    }

    /// Number of free coordinates n.
    pub fn count(&self) -> usize {
        self.map.ncols()
    }

    /// Number of the coordinate that is the driven gear's lag, mm.
    pub fn lag(&self) -> usize {
        self.lag
    }

    /// Number of the coordinate that is the driver's turn (rad), where a torque drives it.
    pub fn driver_turn(&self) -> Option<usize> {
        self.driver_turn
    }

    /// Sizes of the coordinates that belong to a displacement of `length` (mm) at the flanks: turns are taken over a
    /// lever of `lever` (mm).
    pub(super) fn scales(&self, length: f64, lever: f64) -> DVector<f64> {
        let turns =
            |j: usize| j != self.lag && (0..2 * COORDINATES).any(|i| i % COORDINATES >= 3 && self.map[(i, j)] != 0.0);
        DVector::from_fn(self.count(), |j, _| if turns(j) { length / lever } else { length })
    }

    /// d = T q, and the same for velocities.
    pub fn displacement(&self, q: &DVector<f64>) -> Displacement {
        let mut d = Displacement::zeros();
        d.gemv(1.0, &self.map, q, 0.0);
        d
    }
}
