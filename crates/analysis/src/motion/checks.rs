//! What must hold of any motion.

use ale::AleError;
use dynamics::PairMechanism;
use ltca::StaticError;

use crate::certificate::Check;

/// Energy that an integrator may add or take, over the work done.
const ENERGY: f64 = 1e-2;
const ENERGY_WAY_OUT: &str = "take smaller steps (`steps_per_mesh_cycle`, `steps_per_resonance`), or `method = \"energy\"`, which keeps energy at any step";
/// What to do where a motion does not hold.
pub const MOTION_WAY_OUT: &str = ENERGY_WAY_OUT;
/// Forces that should not be, over the largest normal force.
const CONTACT: f64 = 1e-6;
/// The same of a jump at a tooth change, which is the difference of two forces found from different starts: up to some
/// 1e-6 with long steps.
const JUMP: f64 = 1e-4;
const EXCURSION_WAY_OUT: &str = "the flanks are a module or more in each other or apart, as no teeth are: look at the units of torque, stiffnesses and masses, give \
                                 bearings that hold the gears in mesh, or more damping";
const CONTACT_WAY_OUT: &str = "take smaller steps, and let the window grow (leave `window_teeth` out)";

/// Energy that does not close (mJ), over the work that goes through the pair (mJ) or over all work that changed the
/// motion,
/// whichever is more.
pub fn energy_check(residual_mj: f64, through_mj: f64, over_turnover: f64) -> Check {
    let both = [over(residual_mj, through_mj), over_turnover].map(f64::abs);
    // Of two numbers the smaller; a NaN is not lost.
    let value = if both.iter().any(|x| x.is_nan()) { f64::NAN } else { both[0].min(both[1]) };
    Check { name: "energy_residual", value, bound: ENERGY, way_out: ENERGY_WAY_OUT }
}

/// The least force of a slice in contact (N), below zero where a flank pulls, over the largest normal force (N).
pub fn pulling_check(least_n: f64, largest_n: f64) -> Check {
    // Zero or above is fine, a NaN is not.
    contact_check("pulling_force", if least_n >= 0.0 { 0.0 } else { -least_n }, largest_n)
}

/// The largest jump of the normal force that a tooth change set off (N), over the largest normal force (N).
pub fn force_jump_check(jump_n: f64, largest_n: f64) -> Check {
    Check { bound: JUMP, ..contact_check("force_jump", jump_n, largest_n) }
}

/// Tooth changes of a pair's window that set off such a jump, as an error: a wider window may do.
pub fn dropped_by(system: &PairMechanism, jump_n: f64, largest_n: f64) -> Option<StaticError> {
    let window = system.options().statics.window_teeth(system.pair());
    let holds = force_jump_check(jump_n, largest_n).holds();
    (!holds).then_some(StaticError::Window(AleError::Dropped { window, jump_n, largest_n }))
}

/// How far flanks are in each other or apart beyond their clearances (mm), over the module (mm): from a whole module on
/// teeth have passed each other, and no law of a mesh holds.
pub fn excursion_check(farthest_mm: f64, module_mm: f64) -> Check {
    Check { name: "flank_excursion", value: farthest_mm / module_mm, bound: 1.0, way_out: EXCURSION_WAY_OUT }
}

/// A force that should not be (N) over the largest normal force (N).
fn contact_check(name: &'static str, force_n: f64, largest_n: f64) -> Check {
    Check { name, value: over(force_n, largest_n), bound: CONTACT, way_out: CONTACT_WAY_OUT }
}

/// A share; nothing is no share of anything.
fn over(value: f64, scale: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value / scale }
}
