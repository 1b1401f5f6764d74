//! Free rigid coordinates of a pair, and their displacements.

use geometry::{Gear, GearPair};
use nalgebra::{DMatrix, DVector, SVector};

use crate::body::{COORDINATES, RigidBody};
use ltca::StaticOptions;

/// Displacements (mm) and turns (rad) of pinion and wheel from their nominal motion, twelve in all.
pub type Displacement = SVector<f64, 12>;

/// Free coordinates of a pair and what they do to the gears.
///
/// ```text
/// d = T q
/// ```
/// The driven gear's turn is a coordinate in mm on its base circle, positive when it lags: the dynamic transmission
/// error itself (less the kinematic one), so that it keeps its digits however far the driver has turned.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinates {
    /// T, 12 x n.
    map: DMatrix<f64>,
    names: Vec<&'static str>,
    lag: usize,
    driver_turn: Option<usize>,
}

const NAMES: [[&str; COORDINATES]; 2] = [
    ["pinion x", "pinion y", "pinion z", "pinion tilt x", "pinion tilt y", "pinion turn"],
    ["wheel x", "wheel y", "wheel z", "wheel tilt x", "wheel tilt y", "wheel turn"],
];

impl Coordinates {
    /// `free[g][i]`: whether coordinate i of gear g is free; the driven gear's turn always is.
    pub fn new(pair: &GearPair, options: &StaticOptions, free: [[bool; COORDINATES]; 2]) -> Self {
        let driven = options.driven();
        let mut columns: Vec<(SVector<f64, 12>, &'static str)> = Vec::new();
        let (mut lag, mut driver_turn) = (0, None);
        let teeth = [&pair.pinion, &pair.wheel].map(Gear::signed_teeth);
        let base = [pair.pinion.base_radius(), pair.wheel.base_radius()];
        for gear in 0..2 {
            for axis in 0..COORDINATES {
                let mut column = SVector::zeros();
                let own = COORDINATES * gear + axis;
                if axis == COORDINATES - 1 && gear == driven {
                    column[own] = options.side().sign() / base[driven];
                    lag = columns.len();
                } else if free[gear][axis] {
                    column[own] = 1.0;
                    if axis == COORDINATES - 1 {
                        driver_turn = Some(columns.len());
                        // The driver turns on: the driven gear follows in the ratio of the teeth.
                        column[COORDINATES * driven + axis] = -teeth[gear] / teeth[driven];
                    }
                } else {
                    continue;
                }
                let name =
                    if axis == COORDINATES - 1 && gear == driven { "transmission error" } else { NAMES[gear][axis] };
                columns.push((column, name));
            }
        }
        let map = DMatrix::from_fn(12, columns.len(), |i, j| columns[j].0[i]);
        Self { map, names: columns.iter().map(|c| c.1).collect(), lag, driver_turn }
    }

    /// Number of free coordinates n.
    pub fn count(&self) -> usize {
        self.map.ncols()
    }

    /// Names, in order.
    pub fn names(&self) -> &[&'static str] {
        &self.names
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
    pub fn scales(&self, length: f64, lever: f64) -> DVector<f64> {
        let is_turn = |name: &&str| name.contains("tilt") || name.contains("turn");
        DVector::from_iterator(
            self.count(),
            self.names.iter().map(|n| if is_turn(n) { length / lever } else { length }),
        )
    }

    /// d = T q, and the same for velocities; what comes behind the first n is not looked at.
    pub fn displacement(&self, q: &DVector<f64>) -> Displacement {
        let mut d = Displacement::zeros();
        for (column, x) in self.map.as_slice().chunks_exact(d.len()).zip(q.iter()) {
            d.as_mut_slice().iter_mut().zip(column).for_each(|(d, t)| *d += t * x);
        }
        d
    }

    /// T' f added to `out`.
    pub fn add_force(&self, f: &Displacement, out: &mut DVector<f64>) {
        for j in 0..self.count() {
            out[j] += (0..12).map(|i| self.map[(i, j)] * f[i]).sum::<f64>();
        }
    }

    /// T' A T times `scale` added to `out`.
    pub fn add_matrix(&self, a: &nalgebra::SMatrix<f64, 12, 12>, scale: f64, out: &mut DMatrix<f64>) {
        let right = a * &self.map;
        *out += scale * self.map.transpose() * right;
    }

    /// T' diag(M_1, M_2) T.
    pub fn mass(&self, bodies: &[RigidBody; 2]) -> DMatrix<f64> {
        let mut full = nalgebra::SMatrix::<f64, 12, 12>::zeros();
        for (g, body) in bodies.iter().enumerate() {
            full.fixed_view_mut::<6, 6>(6 * g, 6 * g).copy_from(&body.matrix());
        }
        let mut mass = DMatrix::zeros(self.count(), self.count());
        self.add_matrix(&full, 1.0, &mut mass);
        mass
    }
}
