//! A pair and its operation, as every lumped model needs them.

use dynamics::RigidBody;
use geometry::{Driver, GearPair, Sense};
use serde::{Deserialize, Serialize};

use crate::{
    FourierTorque, LumpedError, MeshClock, MeshCycle, MeshFrame, PlaneOfAction,
    error::{not_negative, positive},
};

/// Driver and driven gear of a pair, their excitation and their load: what the lumped models have in common.
///
/// Index 0 is the driver (i, or the seeds' p where the pinion drives), index 1 the driven gear (j, g).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LumpedPair {
    /// Directions.
    pub frame: MeshFrame,
    /// Contact lines: split at the pitch line, length, centre.
    pub plane: PlaneOfAction,
    /// Whether the driver is the pinion; results are stated for pinion and wheel.
    pub pinion_drives: bool,
    /// Base radii r_b, mm.
    pub base_radii: [f64; 2],
    /// Masses and inertias, t and t mm^2.
    pub bodies: [RigidBody; 2],
    /// Speed of the driver.
    pub clock: MeshClock,
    /// Stiffness and unloaded error.
    pub cycle: MeshCycle,
    /// Torque on the driver in its sense, and load on the driven gear against its own, N mm.
    pub torques: [FourierTorque; 2],
    /// Coefficient of friction mu, 0 .. 1.
    pub friction: f64,
}

/// Operation of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operation {
    /// Driving gear.
    pub driver: Driver,
    /// Sense of rotation of the driver.
    pub sense: Sense,
    /// Speed of the driver, rad/s, > 0.
    pub speed: f64,
    /// Torque on the driven gear, N mm, >= 0.
    pub torque: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

impl LumpedPair {
    /// Pair of exact geometry, operation, bodies of pinion and wheel, and the mesh cycle (ISO's, given, or fed by
    /// another model). The driver's torque balances the load.
    ///
    /// # Errors
    /// [`LumpedError`] for what has no meaning.
    pub fn new(
        pair: &GearPair,
        operation: &Operation,
        bodies: [RigidBody; 2],
        cycle: MeshCycle,
    ) -> Result<Self, LumpedError> {
        let frame = MeshFrame::of_pair(pair, operation.driver, operation.sense);
        let plane = PlaneOfAction::of_pair(pair, operation.driver, &frame);
        let pinion_drives = operation.driver == Driver::Pinion;
        let by_role = |pinion, wheel| if pinion_drives { [pinion, wheel] } else { [wheel, pinion] };
        let base_radii = by_role(pair.pinion.base_radius(), pair.wheel.base_radius());
        let [driver, driven] = if pinion_drives { bodies } else { [bodies[1], bodies[0]] };
        let teeth = if pinion_drives { pair.pinion.teeth() } else { pair.wheel.teeth() };
        let made = Self {
            frame,
            plane,
            pinion_drives,
            base_radii,
            bodies: [driver, driven],
            clock: MeshClock::steady(teeth, operation.speed),
            cycle,
            torques: [operation.torque * base_radii[0] / base_radii[1], operation.torque].map(FourierTorque::constant),
            friction: operation.friction,
        };
        made.check()?;
        Ok(made)
    }

    /// Mean force on the transverse line of action that the load asks for, N.
    pub fn mean_force(&self) -> f64 {
        self.torques[1].mean() / self.base_radii[1]
    }

    /// Reduced mass on the line of action, t.
    ///
    /// ```text
    /// m_e = J_1 J_2 / (J_2 r_b1^2 + J_1 r_b2^2)
    /// ```
    /// (Seed 004 prints J_g R_b^2 + J_p r_b^2 below the line: each inertia belongs with the *other* gear's radius.)
    pub fn reduced_mass(&self) -> f64 {
        let [j1, j2] = self.bodies.map(|b| b.polar_inertia);
        let [r1, r2] = self.base_radii;
        j1 * j2 / (j2 * r1 * r1 + j1 * r2 * r2)
    }

    /// sqrt(k_m / m_e): the gears turning against each other on the mean mesh stiffness, rad/s.
    pub fn natural_frequency(&self) -> f64 {
        (self.cycle.stiffness.mean / self.reduced_mass()).sqrt()
    }

    /// k and e on the transverse line of action and the rate of e, at time `t` (s): N/mm, mm, mm/s.
    pub fn excitation(&self, t: f64) -> [f64; 3] {
        let [angle, rate] = self.clock.angle(t);
        let [e, slope] = self.cycle.error.with_slope(angle);
        [self.cycle.stiffness.at(angle), e, slope * rate]
    }

    /// Length of the contact lines at time `t`, mm.
    pub fn line_length(&self, t: f64) -> f64 {
        let cycles = self.clock.cycles(t);
        match &self.cycle.length {
            Some(series) => series.at(self.clock.angle(t)[0]),
            None => self.plane.at(cycles).length,
        }
    }

    /// Everything that must be positive is, and every number is one.
    ///
    /// # Errors
    /// [`LumpedError`] naming the first that is not.
    pub fn check(&self) -> Result<(), LumpedError> {
        self.frame.check()?;
        self.plane.check()?;
        self.clock.check()?;
        self.cycle.check()?;
        for (radius, body) in self.base_radii.iter().zip(&self.bodies) {
            positive("base radius in mm", *radius)?;
            positive("mass in t", body.mass)?;
            positive("polar inertia in t mm^2", body.polar_inertia)?;
            positive("transverse inertia in t mm^2", body.transverse_inertia)?;
        }
        self.torques[0].check("torque on the driver in N mm")?;
        self.torques[1].check("load on the driven gear in N mm")?;
        not_negative("coefficient of friction", self.friction)?;
        if self.friction < 1.0 {
            return Ok(());
        }
        Err(LumpedError::OutOfRange {
            quantity: "coefficient of friction",
            value: self.friction,
            method: "Coulomb friction here",
            allowed: "0 up to, not including, 1",
        })
    }
}
