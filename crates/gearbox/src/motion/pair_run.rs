//! Runs the motion of a pair and reads its results.

use integrate::{Compared, Course, Goal, Ledger, OnlyRows, Periodicity, Row, Settle};

use super::{GearboxMechanism, MotionTimes, PairInstant};
use crate::GearboxError;

/// Motion of a pair in progress.
pub type PairMotion = Course<GearboxMechanism, MotionTimes>;

/// Reads the instant of every row of a motion. `seen` receives it with the energy so far and the mechanism in that
/// state.
pub fn instants(
    mut seen: impl FnMut(&PairInstant, &Ledger, &GearboxMechanism),
) -> impl FnMut(Row<'_, GearboxMechanism>) -> Result<(), GearboxError> {
    move |Row { system, state, ledger }| {
        let instant = system.pair_instant(state).map_err(GearboxError::at(state.time))?;
        seen(&instant, ledger, system);
        Ok(())
    }
}

/// Selects what is compared to decide whether a pair's motion repeats: all coordinates, after as many mesh cycles as
/// the same teeth need to meet again if they differ. Amplitudes of modes are not compared, because they are in the
/// gears' own frames and repeat only after whole rotations. `None` for a motion that need not settle and whose teeth do
/// not meet again in time.
///
/// # Errors
/// [`GearboxError::NoCommonPeriod`] if the motion must settle and its teeth do not meet again before the limit.
pub fn compared(
    motion: &PairMotion,
    settle: Option<&Settle>,
) -> Result<Option<Compared<GearboxMechanism>>, GearboxError> {
    let system = motion.system();
    if let Some(settle) = settle {
        system.back_within(settle.most).map_err(GearboxError::at(motion.state().time))?;
    }
    Ok(system.common_period().map(|period| system.compared(motion.timetable().scale.clone(), period)))
}

/// Runs mesh cycles until the motion repeats within `tolerance`, at most `most` cycles.
///
/// # Errors
/// [`GearboxError`] of the motion. A motion that does not become periodic is not an error; its residual shows it.
pub fn run_to_steady(motion: &mut PairMotion, tolerance: f64, most: u64) -> Result<Periodicity, GearboxError> {
    let goal = steady_goal(motion, (tolerance, most), 0)?;
    motion.settle(&goal, &mut OnlyRows(|_: Row<'_, GearboxMechanism>| Ok::<_, GearboxError>(())))?;
    Ok(motion.stage().periodicity.unwrap_or(Periodicity { period: 1, residual: f64::INFINITY }))
}

/// A motion that settles first and is looked at for so many mesh cycles then.
pub(crate) fn steady_goal(
    motion: &PairMotion,
    (tolerance, most): (f64, u64),
    cycles: u64,
) -> Result<Goal<GearboxMechanism>, GearboxError> {
    let settle = Some(Settle { tolerance, most });
    Ok(Goal {
        compared: compared(motion, settle.as_ref())?,
        settle,
        tolerance,
        cycles,
        starts_with_row: false,
        checkpoint_every: 0,
        stop_after: None,
    })
}
