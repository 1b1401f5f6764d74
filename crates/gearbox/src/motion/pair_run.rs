//! The course of a pair in motion, and what is read off it.

use integrate::{Compared, Course, Goal, Ledger, OnlyRows, Periodicity, Row, Settle};

use super::{GearboxMechanism, MotionTimes, PairInstant};
use crate::GearboxError;

/// A pair's motion under way.
pub type PairMotion = Course<GearboxMechanism, MotionTimes>;

/// Reads the instant of every row of a motion; `seen` gets it with the energy so far and the mechanism as it stands there.
pub fn instants(
    mut seen: impl FnMut(&PairInstant, &Ledger, &GearboxMechanism),
) -> impl FnMut(Row<'_, GearboxMechanism>) -> Result<(), GearboxError> {
    move |Row { system, state, ledger }| {
        let instant = system.pair_instant(state).map_err(GearboxError::at(state.time))?;
        seen(&instant, ledger, system);
        Ok(())
    }
}

/// What tells whether a pair's motion repeats itself: all coordinates, after as many mesh cycles as it takes until the same
/// teeth meet where these differ, but the modes', whose amplitudes are in the gears' own frames and come back after whole
/// turns only. `None` of a motion that need not settle and whose teeth do not come back in time.
///
/// # Errors
/// [`GearboxError::NoCommonPeriod`] where the motion is to settle and its teeth do not
/// come back before.
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

/// Runs mesh cycles until the motion repeats itself within `tolerance`, until `most` are done at the most.
///
/// # Errors
/// [`GearboxError`]. A motion that does not become periodic is none: its residual says so.
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
