//! Cycles of a motion, with their rows and steps.

use std::borrow::Borrow;

use integrate::{CycleTimes, Mechanism, Method, RowPlace, Scheme, StepControl, Stop, Timetable};
use nalgebra::DVector;

use super::GearboxMechanism;

/// Most steps between two rows: more is a standstill, not a motion.
const MOST: f64 = 1e6;
/// Longest step between turns that are alike over the mean of its cycle: longer ones, as from standstill on, are divided.
const LONGEST: f64 = 1.1;
/// Least number of steps in a change of speed: longer ones would not see its acceleration.
const IN_CHANGE: f64 = 16.0;
/// Share of a step that is none of its own: where a change of speed ends with a cycle but for round-off.
const NOTHING: f64 = 1e-6;

/// Divides a motion into cycles of its fastest mesh, and these into steps.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionTimes {
    /// Integration method.
    pub scheme: Scheme,
    /// Steps of a cycle, and which of them are rows.
    pub steps: CycleSteps,
    /// Tolerance for the local error of a step, relative to the scales of the coordinates; `None`: steps at equal
    /// rotations of the input.
    pub tolerance: Option<f64>,
    /// Whether a step ends wherever contact is lost or gained.
    pub stop_at_events: bool,
    /// Magnitude of each coordinate, mm and rad, to which errors are relative.
    pub scale: DVector<f64>,
}

/// Steps of a cycle, and which of them are rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CycleSteps {
    /// The same number in every cycle.
    Counted {
        /// Steps per cycle, >= 1.
        per_cycle: u64,
        /// Steps per row, >= 1, counted from the start of the motion.
        per_row: u64,
        /// A further step with a row, counted in the same way: the last step of the motion.
        last: Option<u64>,
    },
    /// As many as fast vibrations need.
    Showing {
        /// Number of rows in a cycle, and least number of steps, >= 1.
        rows: u64,
        /// Least number of steps in a period of the mesh resonance. If a row is longer, steps are inserted. 0: rows are
        /// the steps.
        per_period: u64,
        /// Frequency of the mesh resonance, Hz.
        hz: f64,
    },
}

impl CycleSteps {
    /// Steps of a cycle that lasts `duration` (s), and steps a row.
    fn of(self, duration: f64) -> [u64; 2] {
        match self {
            Self::Counted { per_cycle, per_row, .. } => [per_cycle.max(1), per_row.max(1)],
            Self::Showing { rows, per_period, hz } => {
                let rows = rows.max(1);
                let per_row = (per_period as f64 * hz * duration / rows as f64).ceil();
                let per_row = if per_row.is_finite() { per_row.clamp(1.0, MOST) as u64 } else { 1 };
                [rows * per_row, per_row]
            }
        }
    }
}

impl MotionTimes {
    /// Length of the steps in a cycle of `duration` (s), s; with an error tolerance it is the longest step.
    pub fn step(&self, duration: f64) -> f64 {
        duration / self.steps.of(duration)[0] as f64
    }
}

impl<M: Mechanism + Borrow<GearboxMechanism>> Timetable<M> for MotionTimes {
    fn method(&self, _: &M) -> Method {
        let Self { scheme, ref scale, stop_at_events, .. } = *self;
        Method { scheme, scale: scale.clone(), stop_at_events, keep_stable: true }
    }

    /// A cycle of the nominal motion.
    fn cycle(&self, system: &M, cycle: u64, begin: f64) -> Option<CycleTimes> {
        let system: &GearboxMechanism = system.borrow();
        // Counted from the start: sums of steps would drift.
        let time = |step: u64, of: u64| system.time_of_cycles(cycle as f64 + step as f64 / of as f64);
        let end = time(1, 1)?;
        let [per_cycle, per_row] = self.steps.of(end - begin);
        let is_even = system.drive.nominal().is_constant();
        let is_alike = is_even && self.tolerance.is_none() && !self.stop_at_events;
        if is_alike && per_cycle.is_multiple_of(per_row) {
            let control = StepControl::new(None, (end - begin) / per_cycle as f64);
            return Some(CycleTimes { stops: vec![Stop::row(end)], rows: RowPlace::Steps(per_row), control });
        }
        let before = cycle.saturating_mul(per_cycle);
        let further = match self.steps {
            CycleSteps::Counted { last, .. } => last,
            CycleSteps::Showing { .. } => None,
        };
        let is_row = |step: u64| step.is_multiple_of(per_row) || Some(step) == further;
        // Each step of its own where their times are not evenly spaced and their error does not choose them.
        let each = !is_even && self.tolerance.is_none();
        let ends = (1..=per_cycle).filter(|&k| each || is_row(before + k) || k == per_cycle);
        let mean = (end - begin) / per_cycle as f64;
        let change = system.drive.nominal().change();
        let (mut stops, mut start, mut longest): (Vec<Stop>, _, f64) = (Vec::new(), begin, 0.0);
        for k in ends {
            let end = time(k, per_cycle)?;
            for [from, to, most] in pieces([start, end], change) {
                let most = if each && to - from > LONGEST * mean { most.min(mean) } else { most };
                let parts = ((to - from) / most).ceil().max(1.0);
                let part = (to - from) / parts;
                stops.extend((1..parts as u64).map(|i| Stop { time: from + i as f64 * part, is_row: false }));
                stops.push(Stop { time: to, is_row: false });
                longest = longest.max(part);
            }
            if let Some(last) = stops.last_mut() {
                *last = Stop { time: end, is_row: is_row(before + k) };
            }
            start = end;
        }
        let longest = if each { longest } else { mean };
        Some(CycleTimes { stops, rows: RowPlace::Ends, control: StepControl::new(self.tolerance, longest) })
    }
}

/// Parts of a step (s) before, in and after a change of speed, each with the longest step in it.
fn pieces([start, end]: [f64; 2], change: Option<[f64; 2]>) -> impl Iterator<Item = [f64; 3]> {
    let [begins, ends] = change.unwrap_or([f64::INFINITY; 2]);
    let within = |t: &f64| t - start > NOTHING * (end - start) && end - t > NOTHING * (end - start);
    let [first, second] = [begins, ends].map(|t| Some(t).filter(within));
    let places = [Some(start), first, second, Some(end)];
    let mut known = places.into_iter().flatten();
    let mut from = known.next().unwrap_or(start);
    known.map(move |to| {
        let middle = 0.5 * (from + to);
        let most = if (begins..=ends).contains(&middle) { (ends - begins) / IN_CHANGE } else { f64::INFINITY };
        [std::mem::replace(&mut from, to), to, most]
    })
}
