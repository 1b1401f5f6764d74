//! Nominal load of a pair, and its stiffness under it after ISO 6336-1.

use geometry::GearPair;
use lumped::{
    LumpedError,
    iso::{IsoPair, IsoStiffness, stiffness},
};
use scene::{Driver, Scene};

/// F_bt, N: torque on the driven gear over its base radius.
pub fn base_force(scene: &Scene, pair: &GearPair) -> f64 {
    let driven = match scene.operation.driver {
        Driver::Pinion => &pair.wheel,
        Driver::Wheel => &pair.pinion,
    };
    scene.operation.torque() / driven.base_radius()
}

/// Stiffness of the pair after ISO 6336-1.
///
/// # Errors
/// [`LumpedError`] where the standard does not hold.
pub fn iso_stiffness(scene: &Scene, pair: &GearPair) -> Result<IsoStiffness, LumpedError> {
    let tangential = base_force(scene, pair) * pair.pinion.transverse_pressure_angle().cos();
    stiffness(&IsoPair {
        teeth: [scene.pinion.teeth, scene.wheel.teeth],
        profile_shift: [scene.pinion.profile_shift, scene.wheel.profile_shift],
        helix_angle: scene.pinion.helix_angle(),
        normal_pressure_angle: scene.pair.normal_pressure_angle(),
        dedendum_coefficient: [scene.pair.dedendum_coefficient; 2],
        young: [scene.pinion.material.young_mpa, scene.wheel.material.young_mpa],
        eps_alpha: pair.transverse_contact_ratio(),
        line_load: tangential / pair.face_width(),
    })
}
