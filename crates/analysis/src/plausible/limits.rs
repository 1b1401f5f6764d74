//! Limits of results beyond which linear elasticity is not valid.

use contact::line::hertz;
use geometry::{Gear, GearPair, Side};
use scene::{MisalignmentScene, Scene};

use super::flanks::largest_depth;
use crate::certificate::Check;

/// Deflection over the normal module from which on a result is none: a tooth is some 2 modules thick and high, and its
/// root would be strained by some 5 %. Plastic gears at their limits reach 0.1.
pub(super) const DEFLECTION_BOUND: f64 = 0.3;
/// Pressure over E* likewise: half the width of a Hertz band is 0.6 of the radius of the flanks. Steel yields at 0.02,
/// plastics at 0.1.
pub(super) const PRESSURE_BOUND: f64 = 0.3;

const HINT: &str = "elasticity here is linear and holds for small deflections: is the torque in N m, Young's modulus in MPa, the face width in mm, micro-geometry in um? Do springs under a bore hold the gear?";

/// E* of the materials of both gears, MPa: `1/E* = sum (1 - nu^2)/E`.
pub(crate) fn effective_modulus(scene: &Scene) -> f64 {
    hertz::effective_modulus(scene.elasticity())
}

/// The largest deflection of a pair over its module (both mm).
pub(crate) fn deflection_check(module_mm: f64, deflection_mm: f64) -> Check {
    let value = deflection_mm / module_mm;
    Check { name: "deflection_over_module".into(), value, bound: DEFLECTION_BOUND, hint: HINT }
}

/// The largest pressure over E* (both MPa).
pub(crate) fn pressure_check(modulus_mpa: f64, pressure_mpa: f64) -> Check {
    let value = pressure_mpa / modulus_mpa;
    Check { name: "pressure_over_modulus".into(), value, bound: PRESSURE_BOUND, hint: HINT }
}

/// Deflection (mm) at the least that a transmission error between two values (mm) stands for in a motion, whose flanks
/// may part: what backlash, micro-geometry, pitch errors and misalignment can bring at the most is left out.
pub(crate) fn deflection_in_motion(
    misalignment: &MisalignmentScene,
    pair: &GearPair,
    [least, largest]: [f64; 2],
) -> f64 {
    let depth = |gear: &Gear| {
        let flanks = [Side::Left, Side::Right].map(|side| largest_depth(gear, side)).into_iter().fold(0.0, f64::max);
        let pitch = gear.modifications().pitch_errors.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        flanks + 2.0 * pitch
    };
    let rigid = depth(&pair.pinion) + depth(&pair.wheel) + misalignment.size_mm();
    // What is no number is not lost.
    if least.is_nan() || largest.is_nan() {
        return f64::NAN;
    }
    (largest - rigid).max(-least - pair.backlash() - rigid).max(0.0)
}
