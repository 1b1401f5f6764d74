//! How long the steps of an explicit method may be with a pair. Theory (48a).

use nalgebra::DVector;

use crate::{
    PairMechanism, PairMotionError,
    start::{balance, guessed},
};
use integrate::{Forces, Mechanism, Scheme, StepLimit, Stiffest};

/// Phases of the mesh cycle that are looked at.
const PHASES: u32 = 16;

/// Longest step with which `scheme` is stable through the first mesh cycle: the smallest limit of its phases, each in
/// quasi-static balance, with the tangents of teeth, bearings, dampers and modes there. `guess` and `scale` as of
/// [`crate::quasi_static_start`].
///
/// `None` for implicit methods, which are stable with any step.
///
/// # Errors
/// As of [`crate::quasi_static_start`].
pub fn stable_step(
    system: &PairMechanism,
    scheme: Scheme,
    guess: f64,
    scale: &DVector<f64>,
) -> Result<Option<StepLimit>, PairMotionError> {
    let Some(mut stiffest) = Stiffest::new(scheme, system.mass()) else { return Ok(None) };
    let fail = |time: f64| move |source| PairMotionError::contact(time, source);
    let mut own = system.with_drive(system.options().drive.clone()).map_err(fail(0.0))?;
    let still = DVector::zeros(own.count());
    let mut forces = Forces::zeros(own.count());
    let mut q = guessed(&own, 0.0, guess);
    for phase in 0..PHASES {
        let cycles = f64::from(phase) / f64::from(PHASES);
        // A pair that stands still has one phase only.
        let Some(time) = own.nominal().time_at(own.pair(), &own.options().statics, cycles) else { break };
        q = match balance(&mut own, time, q.clone(), scale) {
            // The motion begins at the first phase. A later one where the search is lost tells nothing of the limit, which
            // each step is held against as well.
            Err(PairMotionError::NoStart { .. } | PairMotionError::LostLoad { .. }) if phase > 0 => continue,
            found => found?,
        };
        own.accepted(time, &q, &still).map_err(fail(time))?;
        forces.clear();
        own.forces(time, &q, &still, &mut forces).map_err(fail(time))?;
        stiffest.include(&forces);
    }
    Ok(stiffest.limit())
}
