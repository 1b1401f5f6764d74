//! The course of a pair in motion, and what is read off it.

use integrate::{Course, Goal, Ledger, OnlyRows, Periodicity, Row, Settle};

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

/// Runs mesh cycles until the motion repeats itself within `tolerance`, until `most` are done at the most.
///
/// # Errors
/// [`GearboxError`]. A motion that does not become periodic is none: its residual says so.
pub fn run_to_steady(motion: &mut PairMotion, tolerance: f64, most: u64) -> Result<Periodicity, GearboxError> {
    let goal = steady_goal(motion, (tolerance, most), 0);
    motion.settle(&goal, &mut OnlyRows(|_: Row<'_, GearboxMechanism>| Ok::<_, GearboxError>(())))?;
    Ok(motion.stage().periodicity.unwrap_or(Periodicity { period: 1, residual: f64::INFINITY }))
}

/// A motion that settles first and is looked at for so many mesh cycles then. Compared are all coordinates that come back
/// with every mesh cycle, but the modes', whose amplitudes are in the gears' own frames and come back after whole turns only.
pub fn steady_goal(motion: &PairMotion, (tolerance, most): (f64, u64), cycles: u64) -> Goal<GearboxMechanism> {
    Goal {
        compared: Some(motion.system().compared(motion.timetable().scale.clone(), 1)),
        settle: Some(Settle { tolerance, most }),
        tolerance,
        cycles,
        starts_with_row: false,
        checkpoint_every: 0,
        stop_after: None,
    }
}
