//! Checks of static positions.

use ltca::StaticPosition;

use scene::Scene;

use crate::{
    certificate::{Check, Checks},
    plausible::{deflection_check, effective_modulus, pressure_check},
};

/// Moment of the contact forces on the driven gear against the torque on it.
const TORQUE: f64 = 1e-8;
/// Gaps below zero, pulling forces, forces across gaps: over the largest approach and force.
const COMPLEMENTARITY: f64 = 1e-6;
/// Sum of the forces on both gears over the largest.
const ACTION_REACTION: f64 = 1e-8;
/// What the pose is off by over the approach of the flanks: the solver's own bound where forces jump.
const POSE: f64 = 2e-3;
/// Round-off of places over the approach of the flanks.
pub(crate) const ROUND_OFF: f64 = 1e-2;

const HINT: &str = "the contact solver has not found what it was asked for: is the torque in N m, and are loads and sizes those of gears? See `certificate_checks` in summary.json";

/// The worst values of all positions of a scene: torque balance, complementarity, action and reaction, remaining
/// digits, and the range of deflection and pressure in which linear elasticity is valid.
pub fn static_certificate(scene: &Scene, positions: &[StaticPosition]) -> Checks {
    let worst = |value: fn(&StaticPosition) -> f64| positions.iter().map(value).fold(0.0, worse);
    let check = |name: &'static str, value, bound| Check::new(name, value, bound, HINT);
    Checks::new([
        // The first that fails is named: below round-off it is the cause of all others.
        check("round_off_share", worst(|p| p.certificate.round_off_share), ROUND_OFF),
        check("torque_residual", worst(|p| p.certificate.torque_residual), TORQUE),
        check("complementarity_residual", worst(|p| p.certificate.complementarity_residual), COMPLEMENTARITY),
        check("action_reaction_residual", worst(|p| p.certificate.action_reaction_residual), ACTION_REACTION),
        check("pose_residual", worst(|p| p.certificate.pose_residual), POSE),
    ])
    .and(Checks::new([
        deflection_check(scene.pair.normal_module_mm, worst(deflection)),
        pressure_check(effective_modulus(scene), worst(|p| p.max_pressure)),
    ]))
}

/// Deflection along the line of action, mm: the transmission error without that of the unloaded flanks.
fn deflection(position: &StaticPosition) -> f64 {
    (position.transmission_error - position.kinematic_transmission_error).abs()
}

/// The larger value; a NaN counts as the worst and is not ignored, as it would be in `f64::max`.
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || a >= b { a } else { b }
}
