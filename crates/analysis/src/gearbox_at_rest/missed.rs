//! What does not hold of a gearbox that was solved.

use super::GearboxResult;

/// Share of loads that may be left over before the last small step.
const LEFT: f64 = 1e-6;
/// Share of the largest force or moment on a shaft that may be left over.
const BALANCE: f64 = 1e-8;
/// Energy that steps may add or take by themselves, over that of the vibration.
const ENERGY: f64 = 1e-3;
/// Error of the natural frequencies of reduced shafts.
const FREQUENCIES: f64 = 0.03;

/// Transmission error in modules, shafts and bearings that give way in it, and pressure over E*: what lies beyond is no
/// small strain.
const DEFLECTION: f64 = 1.0;
const PRESSURE: f64 = 0.3;

/// A certificate that was missed.
#[derive(Debug, Clone, PartialEq)]
pub struct Missed {
    /// What does not hold, in words.
    pub what: String,
    /// What to do about it.
    pub hint: &'static str,
}

impl GearboxResult {
    /// What does not hold: balance of forces; in motion energy, the range of maps and springs, frequencies of the reduced
    /// shafts. Empty where all does.
    pub fn missed(&self) -> Vec<Missed> {
        let mut all = Vec::new();
        let mut say = |what: String, hint| all.push(Missed { what, hint });
        let hint = "are bearings and shafts many decades stiffer than the teeth? `held` is rigid";
        let [left, body] = self.certificate;
        if left.is_nan() || left > LEFT {
            say(format!("{left:.1e} of the load is left over, allowed is {LEFT:.0e}"), hint);
        }
        if body.is_nan() || body > BALANCE {
            say(format!("forces on a shaft leave {body:.1e} of the largest over, allowed is {BALANCE:.0e}"), hint);
        }
        for mesh in &self.meshes {
            let [deflection, pressure] = mesh.over_limits;
            let hint = "elasticity here is linear and holds for small deflections: are torques in N m, and bearings stiff \
                        enough for them?";
            if deflection.is_nan() || deflection > DEFLECTION {
                say(
                    format!(
                        "mesh {}: the transmission error is {deflection:.2} modules, the bound is {DEFLECTION}",
                        mesh.name
                    ),
                    hint,
                );
            }
            if pressure.is_nan() || pressure > PRESSURE {
                say(
                    format!("mesh {}: the pressure is {pressure:.2} times E*, the bound is {PRESSURE}", mesh.name),
                    hint,
                );
            }
        }
        let Some(motion) = &self.motion else { return all };
        let (left, beyond) = (motion.energy.open_over_vibration, motion.reach.iter().copied().fold(0.0, crate::worse));
        if left.is_nan() || left > ENERGY {
            let what = format!("{left:.1e} of the energy of the motion comes from nowhere");
            say(what, "take more `steps_per_cycle`, or `method = \"energy\"`");
        }
        if beyond.is_nan() || beyond > 1.0 {
            let what = format!("the motion goes {beyond:.2} times as far as the maps or springs of the contact hold");
            say(what, "take `mesh = \"exact\"`, or let it run with more damping");
        }
        let off = motion.reduction.error;
        if off.is_nan() || off > FREQUENCIES {
            let what = format!("natural frequencies of the reduced shafts are off by {off:.1e}");
            say(what, "state a lower or higher `highest_frequency_hz`: modes up to twice that are kept");
        }
        all
    }
}
