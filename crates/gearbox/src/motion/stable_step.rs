//! How long the steps of an explicit method may be with a pair. Theory (48a).

use integrate::{Forces, Mechanism, Scheme, StepLimit, Stiffest};
use nalgebra::DVector;

use super::PairModel;
use crate::GearboxError;

/// Phases of the mesh cycle that are looked at.
const PHASES: u32 = 16;

/// Longest step with which `scheme` is stable through the first mesh cycle: the smallest limit of its phases, each in
/// quasi-static balance, with the tangents of teeth, bearings, dampers and modes there.
///
/// `None` for implicit methods, which are stable with any step.
///
/// # Errors
/// As of [`super::GearboxMechanism::start`].
pub fn stable_step(pair: &PairModel, scheme: Scheme) -> Result<Option<StepLimit>, GearboxError> {
    let mut machine = pair.machine()?;
    let Some(mut stiffest) = Stiffest::new(scheme, machine.mass()) else { return Ok(None) };
    let still = DVector::zeros(machine.count());
    let mut forces = Forces::zeros(machine.count());
    let mut from: Option<DVector<f64>> = None;
    for phase in 0..PHASES {
        let cycles = f64::from(phase) / f64::from(PHASES);
        // A pair that stands still has one phase only.
        let Some(time) = machine.time_of_cycles(cycles) else { break };
        let fail = GearboxError::at(time);
        let z = match machine.standing_at(0, (cycles, time), from.as_ref()) {
            // The motion begins at the first phase. A later one where the search is lost tells nothing of the limit, which
            // each step is held against as well.
            Err(GearboxError::NoEquilibrium { .. } | GearboxError::LostLoad { .. }) if phase > 0 => continue,
            found => found.map_err(fail)?,
        };
        machine.accepted(time, &z, &still).map_err(fail)?;
        forces.clear();
        machine.forces(time, &z, &still, &mut forces).map_err(fail)?;
        stiffest.include(&forces);
        from = Some(z);
    }
    Ok(stiffest.limit())
}
