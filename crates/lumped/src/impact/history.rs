//! Rigid gears in motion at one time.

use dynamics::Displacement;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::ImpactMechanism;
use crate::{LumpedError, equilibrium};

/// One instant of a pair of rigid gears.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImpactRow {
    /// Time, s.
    pub time: f64,
    /// Phase of the mesh cycle, 0 .. 1.
    pub mesh_phase: f64,
    /// Speed of pinion and wheel about +z, rad/s.
    pub speed: [f64; 2],
    /// Dynamic transmission error, um; positive when the driven gear lags.
    pub transmission_error_um: f64,
    /// Sum of normal forces on driving and coast flanks, N.
    pub normal_force: [f64; 2],
    /// Smallest normal force of a slice in contact, N: never below zero.
    pub least_slice_force: f64,
    /// Deepest overlap of driving and coast flanks, mm; below zero where they are apart.
    pub overlap: [f64; 2],
    /// Length of driving slices in contact, mm.
    pub contact_line_length: f64,
    /// Pairs in contact on the driving side, by the running number of the pinion's tooth, and their normal forces, N.
    pub pair_forces: Vec<(i64, f64)>,
    /// Forces x, y, z (N) and moments about x, y, z (N mm) of the flanks on pinion and wheel, about their centres.
    pub wrench: [[f64; 6]; 2],
    /// The part of them that is friction.
    pub friction: [[f64; 6]; 2],
}

fn halves(d: &Displacement) -> [[f64; 6]; 2] {
    [0, 1].map(|g| std::array::from_fn(|i| d[6 * g + i]))
}

impl ImpactMechanism {
    /// The instant at a state.
    pub fn row(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> ImpactRow {
        let (d, rate) = (self.coordinates().displacement(q), self.coordinates().displacement(v));
        let [driving, coast] = self.flank_forces(t, &d, &rate);
        let cycles = self.cycles(t);
        let least = match (driving.length > 0.0, coast.length > 0.0) {
            (true, true) => driving.least_force.min(coast.least_force),
            (true, false) => driving.least_force,
            (false, _) => coast.least_force,
        };
        ImpactRow {
            time: t,
            mesh_phase: cycles - cycles.floor(),
            speed: [0, 1].map(|g| self.speeds(t)[g] + rate[6 * g + 5]),
            transmission_error_um: 1e3 * q[self.coordinates().lag()],
            normal_force: [driving.normal_force, coast.normal_force],
            least_slice_force: least,
            overlap: [driving.overlap, coast.overlap],
            contact_line_length: driving.length,
            wrench: halves(&(driving.wrench() + coast.wrench())),
            friction: halves(&(driving.friction + coast.friction)),
            pair_forces: driving.pairs,
        }
    }

    /// What counts as a large motion of each coordinate, for an integrator: a thirtieth of the normal module, or the turn
    /// that moves a flank by as much.
    pub fn scale(&self) -> DVector<f64> {
        let radius = self.pair().pinion.base_radius().max(self.pair().wheel.base_radius());
        self.coordinates().scales(self.pair().pinion.data().normal_module / 30.0, radius)
    }

    /// Static equilibrium under the mean load at the phase of t = 0, in the order of the coordinates: gears that stand still, so that
    /// neither damping nor friction bears any load. A driver that a torque turns is held.
    ///
    /// # Errors
    /// [`LumpedError::NoEquilibrium`] when some coordinate has nothing to rest on.
    pub fn static_state(&self) -> Result<DVector<f64>, LumpedError> {
        self.standing_still()?.balance()
    }

    /// Coordinates at which forces balance in the nominal motion at t = 0: where a run begins without a jolt. Damping of
    /// flanks that roll into contact, and friction, bear their part of the load.
    ///
    /// # Errors
    /// As [`ImpactMechanism::static_state`].
    pub fn rolling_state(&mut self) -> Result<DVector<f64>, LumpedError> {
        self.balance()
    }

    fn balance(&mut self) -> Result<DVector<f64>, LumpedError> {
        let held: Vec<usize> = self.coordinates().driver_turn().into_iter().collect();
        let mut start = DVector::zeros(self.coordinates().count());
        start[self.coordinates().lag()] = self.guessed_lag();
        let scale = self.scale();
        let Ok(found) = equilibrium(self, 0.0, &start, &held, &scale);
        found.ok_or(LumpedError::NoEquilibrium)
    }
}
