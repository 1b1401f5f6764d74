//! What must hold of a gearbox that was solved.

use answer::{Check, Checks};
use scene::gearbox::Gearbox;

use super::GearboxResult;
use crate::{AnalysisError, accuracy::Accuracy};

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

const STIFF: &str = "are bearings and shafts many decades stiffer than the teeth? `held` is rigid";
const SMALL: &str = "elasticity here is linear and holds for small deflections: are torques in N m, and bearings stiff \
                     enough for them?";

impl GearboxResult {
    /// Balance of forces, deflections and pressures that linear elasticity holds for; in motion energy, the range of maps
    /// and springs, frequencies of the reduced shafts.
    pub fn checks(&self) -> Checks {
        let [left, body] = self.certificate;
        let mut all = vec![Check::new("residual", left, LEFT, STIFF), Check::new("body_balance", body, BALANCE, STIFF)];
        for (i, mesh) in self.meshes.iter().enumerate() {
            let [deflection, pressure] = mesh.over_limits;
            let name = |what: &str| format!("mesh_{}_{what}", i + 1);
            all.push(Check::new(name("deflection_over_module"), deflection, DEFLECTION, SMALL));
            all.push(Check::new(name("pressure_over_modulus"), pressure, PRESSURE, SMALL));
        }
        if let Some(motion) = &self.motion {
            let hint = "take more `steps_per_cycle`, a smaller `error_tolerance` where one is stated, or `method = \"energy\"`";
            all.push(Check::new("energy_residual", motion.energy.open_over_vibration, ENERGY, hint));
        }
        let of_motion = self.motion.as_ref().map(|own| (&own.reach, &own.reduction));
        let of_branch = self.branch.as_ref().map(|own| (&own.reach, &own.reduction));
        if let Some((reach, reduction)) = of_motion.or(of_branch) {
            let beyond = reach.iter().copied().fold(0.0, crate::worse);
            let hint = match &self.motion {
                Some(_) => "take `mesh = \"exact\"`, or let it run with more damping",
                None => "give it more damping, or a larger load",
            };
            all.push(Check::new("map_use", beyond, 1.0, hint));
            let hint = "state a lower or higher `highest_frequency_hz`: modes up to twice that are kept";
            all.push(Check::new("shaft_frequency_error", reduction.error, FREQUENCIES, hint));
        }
        let all = Checks::new(all);
        match &self.branch {
            Some(branch) => all.and(branch.checks.clone()),
            None => all,
        }
    }

    /// Whether every check holds, and the result is as exact as was asked.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]; [`AnalysisError::Refused`] of a result less exact than asked.
    pub fn verdict(&self, file: &Gearbox) -> Result<(), AnalysisError> {
        let judged = match self.checks().failed() {
            Some(failed) => Err(AnalysisError::Certificate(failed)),
            None => self.accuracy.as_ref().map_or(Ok(()), Accuracy::verdict).map_err(AnalysisError::from),
        };
        judged.map_err(|e| e.in_file(&file.file))
    }
}
