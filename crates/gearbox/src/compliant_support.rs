//! Rolling bearings among the seats: where they are, and what they do there. Theory (84), (101).

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Vector5, Vector6};

use crate::{
    Assembly, Structure, Supports,
    rolling_bearing::{RollingBearing, RollingReply, RollingState},
    seats::Seats,
};

/// A rolling bearing between a seat of its shaft and an open seat of the housing, or the ground.
pub(crate) struct CompliantBearing {
    /// Number of the bearing.
    pub bearing: usize,
    law: Arc<RollingBearing>,
    /// First coordinates of both among those of the seats.
    shaft: usize,
    housing: Option<usize>,
}

impl CompliantBearing {
    /// All of them, but those of shafts that do not move.
    pub fn all(assembly: &Assembly, seats: &Seats, held: &[bool]) -> Vec<Self> {
        let own = assembly.structure().bearings.iter().enumerate();
        let moving = own.filter(|(_, b)| !held[b.shaft]);
        let one = |(bearing, b): (usize, &crate::Bearing)| {
            let law = Arc::clone(b.law.as_ref()?);
            let shaft = seats.of_node(assembly.bearing(bearing))?;
            let housing = assembly.open_seat(bearing).and_then(|at| seats.of_open(assembly, at));
            Some(Self { bearing, law, shaft, housing })
        };
        moving.filter_map(one).collect()
    }

    /// All of them, but those of shafts that do not move, among the coordinates of [`Supports`].
    pub fn at_supports(structure: &Structure, supports: &Supports, held: &[bool]) -> Vec<Self> {
        let own = structure.bearings.iter().enumerate().filter(|(_, b)| !held[b.shaft]);
        let one = |(bearing, b): (usize, &crate::Bearing)| {
            let law = Arc::clone(b.law.as_ref()?);
            let open = supports.open().iter().position(|i| *i == bearing);
            let housing = open.map(|at| 6 * (structure.bearings.len() + at));
            Some(Self { bearing, law, shaft: 6 * bearing, housing })
        };
        own.filter_map(one).collect()
    }

    /// Puts its seat in the housing, if it has one, at displacements in the order of the six axes.
    pub fn set_housing(&self, y: &mut DVector<f64>, seat: impl Fn(usize) -> f64) {
        if let Some(at) = self.housing {
            (0..6).for_each(|k| y[at + k] = seat(k));
        }
    }

    /// Displacement of the shaft against the housing at those of the seats.
    pub fn relative(&self, y: &DVector<f64>) -> Vector6<f64> {
        Vector6::from_fn(|k, _| y[self.shaft + k] - self.housing.map_or(0.0, |at| y[at + k]))
    }

    /// Adds its forces and -dV2/dy2 to those of the seats.
    pub fn add(&self, y: &DVector<f64>, forces: &mut DVector<f64>, slopes: &mut DMatrix<f64>) -> RollingReply {
        let u = self.relative(y);
        let reply = self.law.evaluate(&Vector5::from_fn(|k, _| u[k]));
        for (at, sign) in self.ends() {
            for k in 0..5 {
                forces[at + k] += sign * reply.force[k];
            }
        }
        self.add_stiffness(&(-reply.stiffness6()), slopes);
        reply
    }

    /// Adds a stiffness between both ends.
    pub fn add_stiffness(&self, own: &nalgebra::Matrix6<f64>, all: &mut DMatrix<f64>) {
        for ((a, sign), (b, other)) in self.ends().flat_map(|x| self.ends().map(move |y| (x, y))) {
            for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
                all[(a + i, b + j)] += sign * other * own[(i, j)];
            }
        }
    }

    /// What is told of it after a last step of the seats from where `reply` was.
    pub fn state(&self, reply: &RollingReply, y: &DVector<f64>, step: &DVector<f64>) -> RollingState {
        RollingState::new(reply, self.relative(y), &self.relative(step))
    }

    fn ends(&self) -> impl Iterator<Item = (usize, f64)> + use<> {
        [(self.shaft, 1.0)].into_iter().chain(self.housing.map(|at| (at, -1.0)))
    }
}
