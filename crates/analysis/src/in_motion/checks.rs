//! Checks of any motion.

use answer::Remark;
use geometry::GearPair;
use scene::Scene;

use super::StepKeys;
use crate::{
    certificate::Check,
    plausible::{deflection_check, deflection_in_motion},
    remark,
};

/// Energy that an integrator may add or take, over that of the vibration, of a pair: in a free vibration a share
/// s is a damping ratio of 2 s / pi by the steps alone, here 0.6 %, an eighth of what a mesh has by default.
const ENERGY: f64 = 1e-2;
/// The same from which on a user should hear of it.
const OPEN_ENERGY: f64 = 1e-3;
/// Forces that should not be, over the largest normal force.
const CONTACT: f64 = 1e-6;
/// The same of a jump at a tooth change, which is the difference of two forces found from different starts: up to some
/// 1e-6 with long steps.
const JUMP: f64 = 1e-4;
const EXCURSION_HINT: &str = "the flanks are a module or more in each other or apart, as no teeth are: look at the units of torque, stiffnesses and masses, give \
                                 bearings that hold the gears in mesh, or more damping";
const CONTACT_HINT: &str = "take smaller steps, and let the window grow (leave `window_teeth` out)";

/// Energy that steps add or take by themselves, over the kinetic and elastic energy that comes and goes in them
/// ([`integrate::Ledger::open_over_vibration`]). What goes through the pair is no measure of it: in a light vibration it
/// is many thousand times the energy of that.
pub(crate) fn energy_check(open_over_vibration: f64, keys: StepKeys) -> Check {
    Check { name: "energy_residual".into(), value: open_over_vibration, bound: ENERGY, hint: keys.energy() }
}

/// The same where it is told, and the check holds.
pub(crate) fn energy_remark(open_over_vibration: f64, keys: StepKeys) -> Option<Remark> {
    (open_over_vibration > OPEN_ENERGY)
        .then(|| remark::vibration_energy_open(open_over_vibration, OPEN_ENERGY, keys.energy()))
}

/// The smallest force of a slice in contact (N), negative if a flank pulls, divided by the largest normal force (N).
pub fn pulling_check(least_n: f64, largest_n: f64) -> Check {
    // Zero or above is fine, a NaN is not.
    contact_check("pulling_force", if least_n >= 0.0 { 0.0 } else { -least_n }, largest_n)
}

/// The largest jump of the normal force caused by a tooth change (N), divided by the largest normal force (N).
pub fn force_jump_check(jump_n: f64, largest_n: f64) -> Check {
    Check { bound: JUMP, ..contact_check("force_jump", jump_n, largest_n) }
}

/// Deflection of the teeth estimated from transmission errors (mm) of a motion, divided by the module.
pub fn deflection_check_in_motion(scene: &Scene, pair: &GearPair, errors: impl Iterator<Item = f64>) -> Check {
    // A NaN is neither smaller nor larger, and not lost.
    let ends = errors.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, largest], e| {
        if e.is_nan() { [e; 2] } else { [if e < least { e } else { least }, if e > largest { e } else { largest }] }
    });
    let deflection = deflection_in_motion(&scene.pair.misalignment, pair, ends);
    Check { name: "dynamic_deflection_over_module".into(), ..deflection_check(scene.pair.normal_module_mm, deflection) }
}

/// Overlap or separation of flanks beyond their clearances (mm), divided by the module (mm). From a whole module on,
/// teeth have passed each other, and no mesh law is valid.
pub fn excursion_check(farthest_mm: f64, module_mm: f64) -> Check {
    Check { name: "flank_excursion".into(), value: farthest_mm / module_mm, bound: 1.0, hint: EXCURSION_HINT }
}

/// Error of a map relative to the mean approach with the largest permitted error, and the used share of its forces and
/// tilts; `instead` is the alternative that solves the contact itself.
pub fn map_checks([error, worst]: [f64; 2], reach: f64, instead: [&'static str; 2]) -> [Check; 2] {
    let [solved, or_damped] = instead;
    [Check::new("map_error", error, worst, solved), map_excess(reach, or_damped)]
}

/// Used share of the forces and tilts of a map, or of a spring instead of it; `instead` is the alternative without such
/// a limit.
pub fn map_excess(reach: f64, instead: &'static str) -> Check {
    Check::new("map_excess", reach, 1.0, instead)
}

/// A force that should not be (N) over the largest normal force (N).
fn contact_check(name: &'static str, force_n: f64, largest_n: f64) -> Check {
    Check { name: name.into(), value: over(force_n, largest_n), bound: CONTACT, hint: CONTACT_HINT }
}

/// A share; nothing is no share of anything.
fn over(value: f64, scale: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value / scale }
}
