//! Largest stable step of explicit methods. Theory (48a).

use integrate::{Forces, Mechanism, Resumable, Scheme, StepLimit, Stiffest};
use nalgebra::DVector;

use super::GearboxMechanism;
use crate::GearboxError;

/// Phases of the cycle of the fastest mesh that are looked at.
const PHASES: u32 = 16;

impl GearboxMechanism {
    /// Longest step with which `scheme` is stable through the first cycle of the fastest mesh. It is the smallest limit
    /// over the phases of that cycle, each in quasi-static equilibrium, with the tangents of teeth, bearings, dampers
    /// and modes there.
    ///
    /// `None` for implicit methods, which are stable with any step. The modal damping is that set by [`Self::start`],
    /// which must be called before. The memory of the meshes does not change.
    ///
    /// # Errors
    /// The errors of [`Self::start`].
    pub fn stable_step(&mut self, scheme: Scheme) -> Result<Option<StepLimit>, GearboxError> {
        let Some(mut stiffest) = Stiffest::new(scheme, self.mass()) else { return Ok(None) };
        let before = self.memory();
        let still = DVector::zeros(self.count());
        let mut forces = Forces::zeros(self.count());
        let mut from: Option<DVector<f64>> = None;
        for phase in 0..PHASES {
            // A train that stands still has one phase only.
            let Some(time) = self.time_of_cycles(f64::from(phase) / f64::from(PHASES)) else { break };
            let fail = GearboxError::at(time);
            let z = match self.standing_in_motion(time, from.as_ref()) {
                // The motion begins at the first phase. A later one where the search is lost tells nothing of the limit,
                // which each step is held against as well.
                Err(GearboxError::NoEquilibrium { .. } | GearboxError::LostLoad { .. }) if phase > 0 => continue,
                found => found.map_err(fail)?,
            };
            self.accepted(time, &z, &still).map_err(fail)?;
            forces.clear();
            self.forces(time, &z, &still, &mut forces).map_err(fail)?;
            stiffest.include(&forces);
            from = Some(z);
        }
        self.restore(&before)?;
        self.forget();
        Ok(stiffest.limit())
    }
}
