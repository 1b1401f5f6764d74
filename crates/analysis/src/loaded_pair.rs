//! A pair under its torque in the units of the solvers: the inputs of closed-form formulas.

use contact::line::hertz;
use geometry::{Driver, GearPair, Sense, Side};
use lumped::{
    LumpedError,
    iso::{IsoPair, IsoStiffness, stiffness},
};
use scene::Scene;

/// Geometry, materials and load of a pair: mm, N, MPa.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadedPair<'a> {
    /// The exact pair.
    pub pair: &'a GearPair,
    /// Young's modulus (MPa) and Poisson's ratio of pinion and wheel.
    pub elasticity: [(f64, f64); 2],
    /// Torque on the driven gear, N mm, 0 or more.
    pub torque: f64,
    /// Which gear drives.
    pub driver: Driver,
    /// Sense in which the pinion turns.
    pub sense: Sense,
}

impl<'a> LoadedPair<'a> {
    /// Loaded pair of a scene.
    pub fn of(scene: &Scene, pair: &'a GearPair) -> Self {
        Self {
            pair,
            elasticity: scene.elasticity(),
            torque: scene.operation.torque(),
            driver: scene.operation.driver,
            sense: scene.operation.rotation,
        }
    }

    /// The side of the pinion's teeth that the torque loads.
    pub fn side(&self) -> Side {
        self.driver.loaded_side(self.sense)
    }

    /// Base radius of the driven gear, mm, positive also for a ring.
    pub fn driven_base_radius(&self) -> f64 {
        [&self.pair.pinion, &self.pair.wheel][self.driver.driven()].base_radius().abs()
    }

    /// Force F_bt, N: torque on the driven gear divided by its base radius.
    pub fn base_force(&self) -> f64 {
        self.torque / self.driven_base_radius()
    }

    /// Force F_t at the reference circle of the pinion, N.
    pub fn tangential_force(&self) -> f64 {
        self.base_force() * self.pair.pinion.transverse_pressure_angle().cos()
    }

    /// Young's moduli of pinion and wheel, MPa.
    pub fn young(&self) -> [f64; 2] {
        self.elasticity.map(|(young, _)| young)
    }

    /// Poisson's ratios of pinion and wheel.
    pub fn poisson(&self) -> [f64; 2] {
        self.elasticity.map(|(_, poisson)| poisson)
    }

    /// Effective modulus E* of both materials, MPa: `1/E* = sum (1 - nu^2)/E`.
    pub fn effective_modulus(&self) -> f64 {
        hertz::effective_modulus(self.elasticity)
    }

    /// `1/E* = sum (1 - nu^2)/E`, mm^2/N.
    pub fn compliance(&self) -> f64 {
        self.elasticity.map(|(young, poisson)| (1.0 - poisson.powi(2)) / young).iter().sum()
    }

    /// Stiffness of the pair after ISO 6336-1.
    ///
    /// # Errors
    /// [`LumpedError`] if the standard does not cover the pair.
    pub fn iso_stiffness(&self) -> Result<IsoStiffness, LumpedError> {
        let gears = [self.pair.pinion.data(), self.pair.wheel.data()];
        stiffness(&IsoPair {
            teeth: gears.map(|g| g.teeth),
            internal: self.pair.is_internal(),
            profile_shift: gears.map(|g| g.profile_shift),
            helix_angle: gears[0].helix_angle,
            normal_pressure_angle: gears[0].normal_pressure_angle,
            dedendum_coefficient: gears.map(|g| g.dedendum_coefficient),
            young: self.young(),
            eps_alpha: self.pair.transverse_contact_ratio(),
            line_load: self.tangential_force() / self.pair.face_width(),
        })
    }
}
