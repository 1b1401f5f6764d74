//! The mesh cycles of a pair in motion, with their rows and steps; and what is read off them.

use integrate::{
    Compared, Course, CycleTimes, Goal, Ledger, Method, OnlyRows, Periodicity, Row, RowPlace, Scheme, Settle,
    StepControl, Stop, Timetable,
};
use nalgebra::DVector;

use super::{GearboxMechanism, PairInstant, PairMotionError};

/// Settings of the integration of a pair's motion.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSettings {
    /// Method.
    pub scheme: Scheme,
    /// Rows of the results in a mesh cycle, evenly spaced in time, and least number of steps, >= 1.
    pub rows: usize,
    /// Least number of steps in a period of the mesh resonance: where a row is longer, steps are taken in between. 0:
    /// rows are the steps.
    pub steps_per_resonance: usize,
    /// The mesh resonance, Hz.
    pub resonance_hz: f64,
    /// Local error of a step over the coordinates' scales; `None`: steps of equal length.
    pub tolerance: Option<f64>,
    /// Ends a step wherever contact is lost or gained.
    pub stop_at_events: bool,
    /// Size of each coordinate, mm and rad: what errors are relative to.
    pub scale: DVector<f64>,
}

impl PairSettings {
    /// Steps between two rows of a mesh cycle of `duration` (s).
    fn steps_per_row(&self, duration: f64) -> usize {
        let wanted = self.steps_per_resonance as f64 * self.resonance_hz * duration;
        let steps = (wanted / self.rows.max(1) as f64).ceil();
        // More than this is a standstill, not a motion.
        if steps.is_finite() { (steps as usize).clamp(1, 1_000_000) } else { 1 }
    }

    /// Length of the steps in a mesh cycle of `duration` (s), s; the longest one with an error tolerance.
    pub fn step(&self, duration: f64) -> f64 {
        duration / (self.rows.max(1) * self.steps_per_row(duration)) as f64
    }
}

/// A pair's motion under way.
pub type PairMotion = Course<GearboxMechanism, PairSettings>;

impl Timetable<GearboxMechanism> for PairSettings {
    fn method(&self, _: &GearboxMechanism) -> Method {
        let Self { scheme, ref scale, stop_at_events, .. } = *self;
        Method { scheme, scale: scale.clone(), stop_at_events, keep_stable: true }
    }

    /// A mesh cycle of the nominal motion; steps of equal length meet its rows by themselves.
    fn cycle(&self, system: &GearboxMechanism, cycle: u64, begin: f64) -> Option<CycleTimes> {
        let end = system.time_of_cycles(0, (cycle + 1) as f64)?;
        let rows = self.rows.max(1);
        let per_row = self.steps_per_row(end - begin);
        let control = StepControl::new(self.tolerance, (end - begin) / (rows * per_row) as f64);
        if self.tolerance.is_none() && !self.stop_at_events {
            return Some(CycleTimes { stops: vec![Stop::row(end)], rows: RowPlace::Steps(per_row as u64), control });
        }
        let row_time = |i: usize| if i == rows { end } else { begin + (end - begin) * i as f64 / rows as f64 };
        let stops = (1..=rows).map(|i| Stop::row(row_time(i))).collect();
        Some(CycleTimes { stops, rows: RowPlace::Ends, control })
    }
}

/// Reads the instant of every row of a motion; `seen` gets it with the energy so far and the mechanism as it stands there.
pub fn instants(
    mut seen: impl FnMut(&PairInstant, &Ledger, &GearboxMechanism),
) -> impl FnMut(Row<'_, GearboxMechanism>) -> Result<(), PairMotionError> {
    move |Row { system, state, ledger }| {
        let instant = system.pair_instant(state).map_err(PairMotionError::at(state.time))?;
        seen(&instant, ledger, system);
        Ok(())
    }
}

/// What tells whether a pair's motion repeats itself: all coordinates, after as many mesh cycles as it takes until the same
/// teeth meet where these differ, but the modes', whose amplitudes are in the gears' own frames and come back after whole
/// turns only. `None` of a motion that need not settle and whose teeth do not come back in time.
///
/// # Errors
/// [`GearboxError::NoCommonPeriod`](crate::GearboxError::NoCommonPeriod) where the motion is to settle and its teeth do not
/// come back before.
pub fn compared(
    motion: &PairMotion,
    settle: Option<&Settle>,
) -> Result<Option<Compared<GearboxMechanism>>, PairMotionError> {
    let system = motion.system();
    if let Some(settle) = settle {
        system.back_within(settle.most).map_err(PairMotionError::at(motion.state().time))?;
    }
    Ok(system.common_period().map(|period| system.compared(motion.timetable().scale.clone(), period)))
}

/// Runs mesh cycles until the motion repeats itself within `tolerance`, until `most` are done at the most.
///
/// # Errors
/// [`PairMotionError`]. A motion that does not become periodic is none: its residual says so.
pub fn run_to_steady(motion: &mut PairMotion, tolerance: f64, most: u64) -> Result<Periodicity, PairMotionError> {
    let goal = steady_goal(motion, (tolerance, most), 0)?;
    motion.settle(&goal, &mut OnlyRows(|_: Row<'_, GearboxMechanism>| Ok::<_, PairMotionError>(())))?;
    Ok(motion.stage().periodicity.unwrap_or(Periodicity { period: 1, residual: f64::INFINITY }))
}

/// A motion that settles first and is looked at for so many mesh cycles then.
pub(crate) fn steady_goal(
    motion: &PairMotion,
    (tolerance, most): (f64, u64),
    cycles: u64,
) -> Result<Goal<GearboxMechanism>, PairMotionError> {
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
