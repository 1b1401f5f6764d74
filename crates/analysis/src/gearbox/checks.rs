//! Checks of a solved gearbox.

use answer::{Check, Checks};
use scene::gearbox::Gearbox;

use super::{
    GearboxResult,
    motion_checks::{DEFLECTION, SMALL},
};
use crate::{AnalysisError, accuracy::Accuracy};

/// Share of loads that may be left over before the last small step.
const LEFT: f64 = 1e-6;
/// Share of the largest force or moment on a shaft that may be left over.
const BALANCE: f64 = 1e-8;
/// Pressure over E*: what lies beyond is no small strain.
const PRESSURE: f64 = 0.3;

const STIFF: &str = "are bearings and shafts many decades stiffer than the teeth? `held` is rigid";

impl GearboxResult {
    /// Checks of force equilibrium, and of the range of deflections and pressures in which linear elasticity is valid;
    /// checks of its motion and of its branch.
    pub fn checks(&self) -> Checks {
        let [left, body] = self.certificate;
        let mut all = vec![Check::new("residual", left, LEFT, STIFF), Check::new("body_balance", body, BALANCE, STIFF)];
        for (i, mesh) in self.meshes.iter().enumerate() {
            let [deflection, pressure] = mesh.over_limits;
            let name = |what: &str| format!("mesh_{}_{what}", i + 1);
            all.push(Check::new(name("deflection_over_module"), deflection, DEFLECTION, SMALL));
            all.push(Check::new(name("pressure_over_modulus"), pressure, PRESSURE, SMALL));
        }
        let of_motion = self.motion.as_ref().map(|own| own.checks.clone());
        let of_branch = self.branch.as_ref().map(|own| own.checks.clone());
        of_motion.into_iter().chain(of_branch).fold(Checks::new(all), Checks::and)
    }

    /// Whether all checks pass and the requested accuracy is met.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]; [`AnalysisError::Refused`] for a result that is less accurate than requested.
    pub fn verdict(&self, file: &Gearbox) -> Result<(), AnalysisError> {
        let judged = match self.checks().failed() {
            Some(failed) => Err(AnalysisError::Certificate(failed)),
            None => self.accuracy.as_ref().map_or(Ok(()), Accuracy::verdict).map_err(AnalysisError::from),
        };
        judged.map_err(|e| e.in_file(&file.file))
    }
}
