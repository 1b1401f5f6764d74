//! A pair in motion, mesh cycle by mesh cycle.

use std::f64::consts::TAU;

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::{Instant, MechanismState, PairMechanism, PairMotionError};
use integrate::{Envelope, Forces, Integrator, Ledger, Mechanism, MotionError, Scheme, State, StepControl};

/// Who gets the rows of a motion, with the energy so far and the mechanism as it stands there.
pub type RowObserver<'a> = &'a mut dyn FnMut(&Instant, &Ledger, &PairMechanism);

/// How a pair's motion is integrated.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionSettings {
    /// Method.
    pub scheme: Scheme,
    /// Rows of the results in a mesh cycle, evenly spaced in time, and least number of steps, >= 1.
    pub rows: usize,
    /// Least number of steps in a period of the mesh resonance: where a row is longer, steps are taken in between. 0:
    /// rows are the steps.
    pub steps_per_resonance: usize,
    /// Local error of a step over the coordinates' scales; `None`: steps of equal length.
    pub tolerance: Option<f64>,
    /// Ends a step wherever contact is lost or gained.
    pub stop_at_events: bool,
    /// Size of each coordinate, mm and rad: what errors are relative to.
    pub scale: DVector<f64>,
}

impl MotionSettings {
    /// Steps between two rows of a mesh cycle of `duration` (s), with the mesh resonance at `resonance_hz`.
    fn steps_per_row(&self, duration: f64, resonance_hz: f64) -> usize {
        let wanted = self.steps_per_resonance as f64 * resonance_hz * duration;
        let steps = (wanted / self.rows.max(1) as f64).ceil();
        // More than this is a standstill, not a motion.
        if steps.is_finite() { (steps as usize).clamp(1, 1_000_000) } else { 1 }
    }

    /// Length of the steps in a mesh cycle of `duration` (s), s; the longest one with an error tolerance.
    pub fn step(&self, duration: f64, resonance_hz: f64) -> f64 {
        duration / (self.rows.max(1) * self.steps_per_row(duration, resonance_hz)) as f64
    }
}

/// All that a motion is at the end of a mesh cycle: it goes on from here to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Mesh cycles done.
    pub cycle: u64,
    /// Coordinates and what integrator and step control carry along.
    pub state: State,
    /// Energy.
    pub ledger: Ledger,
    /// Windows and extremes.
    pub place: MechanismState,
    /// What else was counted.
    pub counts: Counts,
}

/// Counts of a motion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Steps taken.
    pub steps: u64,
    /// Steps taken back because their error was too large.
    pub refused: u64,
    /// How often contact of the driving flanks was lost as a whole.
    pub losses: u64,
    /// How often the coast flanks came into contact.
    pub coast_contacts: u64,
    /// Work that the load took from the driven gear in its nominal motion, N mm: what goes through the pair.
    pub throughput: f64,
}

/// A motion under way.
#[derive(Debug)]
pub struct Motion {
    system: PairMechanism,
    settings: MotionSettings,
    state: State,
    ledger: Option<Ledger>,
    cycle: u64,
    counts: Counts,
}

impl Motion {
    /// At the start of mesh cycle 0 in this state.
    pub fn new(mut system: PairMechanism, settings: MotionSettings, state: State) -> Self {
        system.forget();
        Self { system, settings, state, ledger: None, cycle: 0, counts: Counts::default() }
    }

    /// Goes on from a checkpoint.
    ///
    /// # Errors
    /// [`PairMotionError::OtherCoordinates`] for a checkpoint of another pair, [`PairMotionError::Integration`] when
    /// its windows cannot be entered.
    pub fn resume(
        mut system: PairMechanism,
        settings: MotionSettings,
        from: Checkpoint,
    ) -> Result<Self, PairMotionError> {
        if from.state.q.len() != system.count() {
            let (checkpoint, motion) = (from.state.q.len(), system.count());
            return Err(PairMotionError::OtherCoordinates { checkpoint, motion });
        }
        let Checkpoint { cycle, state, ledger, place, counts } = from;
        system.restore(&place).map_err(|source| PairMotionError::contact(state.time, source))?;
        Ok(Self { system, settings, state, ledger: Some(ledger), cycle, counts })
    }

    /// To go on from later; `None` before the first cycle.
    pub fn checkpoint(&self) -> Option<Checkpoint> {
        Some(Checkpoint {
            cycle: self.cycle,
            state: self.state.clone(),
            ledger: self.ledger?,
            place: self.system.mechanism_state(),
            counts: self.counts,
        })
    }

    /// The pair.
    pub fn system(&self) -> &PairMechanism {
        &self.system
    }

    /// Method, rows and scales.
    pub fn settings(&self) -> &MotionSettings {
        &self.settings
    }

    /// Sizes of the coordinates that come back with every period: all but the modes', whose amplitudes are in the
    /// gears' own frames and come back after whole turns only.
    pub fn returning(&self) -> DVector<f64> {
        self.settings.scale.rows(0, self.system.coordinates().count()).into_owned()
    }

    /// State at the end of the last cycle.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Energy so far; `None` before the first cycle.
    pub fn ledger(&self) -> Option<&Ledger> {
        self.ledger.as_ref()
    }

    /// Mesh cycles done.
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// What was counted.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Whether the integrator carries an acceleration of its own from step to step.
    pub(super) fn carries_acceleration(&self) -> bool {
        self.settings.scheme.carries_acceleration()
    }

    /// Back to the start of cycle 0 with another state. The integrator's own acceleration stays that of the state; the
    /// true one comes from the forces.
    pub(super) fn rewind(&mut self, start: &MechanismState, state: State) -> Result<(), PairMotionError> {
        let time = state.time;
        let fail = |source| PairMotionError::contact(time, source);
        self.system.restore(start).map_err(fail)?;
        (self.state, self.ledger, self.cycle, self.counts) = (state, None, 0, Counts::default());
        if self.carries_acceleration() {
            let State { q, v, .. } = &self.state;
            let mut forces = Forces::zeros(q.len());
            self.system.forces(time, q, v, &mut forces).map_err(fail)?;
            let potential = self.system.potential(time, q).map_err(fail)?;
            let mass = self.system.mass().clone();
            self.ledger = Some(Ledger::open(&mass, v, potential));
            let singular = MotionError::Singular { time, which: "mass" };
            self.state.a = mass.cholesky().ok_or(singular)?.solve(&(&forces.conservative + &forces.other));
            self.state.powers = [forces.supplied, forces.dissipated];
        }
        Ok(())
    }

    /// Whether there is a further mesh cycle: a run-down may end before it.
    pub fn goes_on(&self) -> bool {
        self.end_of_cycle().is_some()
    }

    fn end_of_cycle(&self) -> Option<f64> {
        let (pair, contact) = (self.system.pair(), &self.system.options().statics);
        self.system.nominal().time_at(pair, contact, (self.cycle + 1) as f64)
    }

    /// One mesh cycle of the nominal motion; `seen` gets every row.
    ///
    /// What contact remembers is forgotten first, so that a motion that is taken up again at this cycle goes the same
    /// way to the last bit.
    ///
    /// # Errors
    /// [`PairMotionError`]; [`PairMotionError::StandsStill`] when the gears stop before the cycle ends.
    pub fn run_cycle(&mut self, mut seen: Option<RowObserver<'_>>) -> Result<Envelope, PairMotionError> {
        let Some(end) = self.end_of_cycle() else {
            return Err(PairMotionError::StandsStill { cycle: self.cycle });
        };
        self.system.forget();
        let begin = self.state.time;
        let rows = self.settings.rows.max(1);
        let per_row = self.settings.steps_per_row(end - begin, self.system.mesh_resonance_hz());
        let row_time = |i: usize| if i == rows { end } else { begin + (end - begin) * i as f64 / rows as f64 };
        let mut envelope = Envelope::new(&self.state);
        let mut integrator = self.integrator((end - begin) / (rows * per_row) as f64);
        let equal = self.settings.tolerance.is_none() && !self.settings.stop_at_events;
        let mut failed = None;
        let mut steps = 0usize;
        // Steps of equal length meet the rows by themselves.
        let stops: Vec<f64> = if equal { vec![end] } else { (1..=rows).map(row_time).collect() };
        let Self { system, state, counts, .. } = self;
        for until in stops {
            integrator.advance(system, state, until, |system, progress| {
                steps += 1;
                counts.steps += 1;
                envelope.widen(progress.state);
                for crossing in progress.crossings {
                    match (crossing.event, crossing.direction) {
                        (0, integrate::Direction::Down) => counts.losses += 1,
                        (1, integrate::Direction::Up) => counts.coast_contacts += 1,
                        _ => {}
                    }
                }
                let is_row = if equal {
                    steps.is_multiple_of(per_row)
                } else {
                    (until - progress.state.time).abs() < 1e-9 * (end - begin)
                };
                if let Some(seen) = seen.as_mut().filter(|_| is_row && failed.is_none()) {
                    let State { time, q, v, .. } = progress.state;
                    match system.instant(*time, q, v) {
                        Ok(instant) => seen(&instant, progress.ledger, system),
                        Err(source) => failed = Some(PairMotionError::contact(*time, source)),
                    }
                }
            })?;
        }
        if let Some(error) = failed {
            return Err(error);
        }
        counts.refused += integrator.steps()[1];
        counts.throughput += throughput(system, begin, end);
        self.ledger = integrator.ledger().copied();
        self.cycle += 1;
        Ok(envelope)
    }

    fn integrator(&self, h: f64) -> Integrator {
        let MotionSettings { scheme, tolerance, ref scale, stop_at_events, .. } = self.settings;
        let control = match tolerance {
            None => StepControl::Fixed(h),
            Some(tolerance) => StepControl::Adaptive { tolerance, first: 0.1 * h, least: 1e-7 * h, largest: h },
        };
        let integrator =
            Integrator::new(scheme, control, scale.clone()).stopping_at_events(stop_at_events).keeping_stable();
        match self.ledger {
            Some(ledger) => integrator.resumed(ledger),
            None => integrator,
        }
    }
}

/// Load torque times the driven gear's nominal turn between two times, N mm (Simpson's rule).
fn throughput(system: &PairMechanism, begin: f64, end: f64) -> f64 {
    let options = system.options();
    let pair = system.pair();
    let driven = [&pair.pinion, &pair.wheel][options.statics.driven()];
    let rate = |t: f64| {
        let cycles = system.nominal().cycles_per_second(pair, &options.statics, t);
        (options.load.at(t) * cycles * TAU / f64::from(driven.teeth())).abs()
    };
    (end - begin) / 6.0 * (rate(begin) + 4.0 * rate(0.5 * (begin + end)) + rate(end))
}
