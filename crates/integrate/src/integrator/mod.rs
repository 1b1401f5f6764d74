//! The sequence of steps: their length, their events, their energy.

mod step;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::{
    Crossing, Forces, Ledger, Mechanism, MotionError, Scheme, State, StepControl,
    events::{crossings, event_values},
    stability::StabilityGuard,
    stepper::StepWork,
};

/// Steps in one go from which on it matters how short they are.
const MANY_STEPS: u64 = 30_000;
/// Mean step over the largest allowed below which a motion does not get on.
const CRAWLING: f64 = 1e-3;

/// State of a motion that a caller receives after every step.
#[derive(Debug)]
pub struct Progress<'a> {
    /// State at the end of the step.
    pub state: &'a State,
    /// Forces of the step's last evaluation: at its end, or in its middle for [`Scheme::Energy`].
    pub forces: &'a Forces,
    /// Energy so far.
    pub ledger: &'a Ledger,
    /// Events within the step.
    pub crossings: &'a [Crossing],
}

/// Integrates a mechanism.
#[derive(Debug, Clone)]
pub struct Integrator {
    scheme: Scheme,
    control: StepControl,
    scale: DVector<f64>,
    stop_at_events: bool,
    /// Guard that keeps an explicit method within its stability limit.
    guard: Option<StabilityGuard>,
    /// Time (s) of the tangents in `forces`; none where they are of another place.
    tangents_at: Option<f64>,
    forces: Forces,
    work: StepWork,
    kept: Option<Kept>,
    ledger: Option<Ledger>,
    steps: u64,
    refused: u64,
}

/// What goes on from one call to the next: callers advance by a step as well as by thousands.
#[derive(Debug, Clone)]
struct Kept {
    /// Mass matrix and its factor.
    mass: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    /// State before a step.
    before: State,
    /// Values of the events before and behind it.
    values: [Vec<f64>; 2],
}

impl Integrator {
    /// `scale` is the magnitude of each coordinate that counts as large, > 0; tolerances are relative to it.
    pub fn new(scheme: Scheme, control: StepControl, scale: DVector<f64>) -> Self {
        let (forces, work) = (Forces::zeros(scale.len()), StepWork::new(scale.len()));
        let (guard, tangents_at) = (None, None);
        Self {
            scheme,
            control,
            scale,
            stop_at_events: false,
            guard,
            tangents_at,
            forces,
            work,
            kept: None,
            ledger: None,
            steps: 0,
            refused: 0,
        }
    }

    /// Divides a step of given length if an explicit method would be unstable with the whole step; the tangents at its
    /// beginning decide. Theory (48a).
    ///
    /// Steps chosen by an error tolerance do not need this: instability appears as an error that shortens them.
    #[must_use]
    pub fn keeping_stable(self) -> Self {
        let guard = matches!(self.control, StepControl::Fixed(_)).then(|| StabilityGuard::new(self.scheme)).flatten();
        Self { guard, ..self }
    }

    /// Ends a step at every event, so that no step passes over a kink of the forces.
    #[must_use]
    pub fn stopping_at_events(self, stop_at_events: bool) -> Self {
        Self { stop_at_events, ..self }
    }

    /// Integrator with steps of other lengths from now on.
    pub(crate) fn with_control(self, control: StepControl) -> Self {
        Self { control, ..self }
    }

    /// Finds accelerations and energy of a start; nothing to do where they are known.
    ///
    /// # Errors
    /// [`MotionError`].
    pub(crate) fn begin<M: Mechanism>(
        &mut self,
        system: &mut M,
        state: &mut State,
    ) -> Result<(), MotionError<M::Error>> {
        if self.ledger.is_some() {
            return Ok(());
        }
        self.check(system, state)?;
        let singular = MotionError::Singular { time: state.time, which: "mass" };
        let mass = Cholesky::new(system.mass().clone()).ok_or(singular)?;
        self.open(system, &mass, state)
    }

    /// Energy so far; `None` before the first step.
    pub fn ledger(&self) -> Option<&Ledger> {
        self.ledger.as_ref()
    }

    /// Integrator that continues with the ledger of an earlier one (restart).
    #[must_use]
    pub fn resumed(self, ledger: Ledger) -> Self {
        Self { ledger: Some(ledger), ..self }
    }

    /// Number of steps taken, and number of steps that were rejected because their error was too large, or that were
    /// divided.
    pub fn steps(&self) -> [u64; 2] {
        [self.steps, self.refused]
    }

    /// Integrates from `state` to the time `until` and calls `seen` after every step. The accelerations of an initial
    /// state are computed here.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot continue.
    pub fn advance<M: Mechanism>(
        &mut self,
        system: &mut M,
        state: &mut State,
        until: f64,
        seen: impl FnMut(&mut M, Progress<'_>),
    ) -> Result<(), MotionError<M::Error>> {
        self.check(system, state)?;
        let known = self.kept.take().filter(|kept| kept.mass == *system.mass());
        let mut kept = match known {
            Some(kept) => kept,
            None => Kept {
                mass: system.mass().clone(),
                factor: Cholesky::new(system.mass().clone())
                    .ok_or(MotionError::Singular { time: state.time, which: "mass" })?,
                before: state.clone(),
                values: Default::default(),
            },
        };
        let done = self.steps_until(system, state, until, &mut kept, seen);
        if done.is_err() {
            // What was found of a step that failed is no state.
            state.copy_from(&kept.before);
        }
        self.kept = Some(kept);
        done
    }

    fn steps_until<M: Mechanism>(
        &mut self,
        system: &mut M,
        state: &mut State,
        until: f64,
        Kept { factor: mass, before, values: [values, now], .. }: &mut Kept,
        mut seen: impl FnMut(&mut M, Progress<'_>),
    ) -> Result<(), MotionError<M::Error>> {
        before.copy_from(state);
        if self.ledger.is_none() {
            self.open(system, mass, state)?;
        }
        for all in [&mut *values, &mut *now] {
            all.resize(system.events(), 0.0);
        }
        event_values(system, (state.time, &state.q, &state.v), values)?;
        let (begun, before_it) = (state.time, self.steps);
        while until - state.time > 1e-12 * (until.abs() + self.first_step()) {
            let wanted = match self.control {
                StepControl::Fixed(h) => h,
                StepControl::Adaptive { first, .. } => {
                    if state.next_step > 0.0 {
                        state.next_step
                    } else {
                        first
                    }
                }
            };
            before.copy_from(state);
            let h = wanted.min(until - state.time);
            let shortened = h < wanted;
            // Avoids a last step of round-off length.
            let h = if until - state.time - h < 1e-9 * h { until - state.time } else { h };
            let (mut book, next) = self.accepted_step(system, mass, before, h, state)?;
            event_values(system, (state.time, &state.q, &state.v), now)?;
            let mut crossed = crossings(system, before, state, values, now)?;
            let first = crossed.iter().map(|c| c.time).fold(f64::INFINITY, f64::min);
            if self.stop_at_events && first < state.time - 1e-9 * h && first > before.time + 1e-9 * h {
                let shorter = first - before.time;
                book = match self.control {
                    StepControl::Fixed(_) => self.fixed_step(system, mass, before, shorter, state)?,
                    StepControl::Adaptive { .. } => self.one_step(system, mass, before, shorter, state)?,
                };
                event_values(system, (state.time, &state.q, &state.v), now)?;
                crossed.retain(|c| c.time <= first);
            }
            // A step that was shortened to meet the end says nothing against the length wanted.
            state.next_step = if shortened && next >= h { next.max(wanted) } else { next };
            self.ledger = Some(book);
            self.steps += 1;
            // The step stands, whatever comes of the rest.
            before.copy_from(state);
            self.crawls(state.time - begun, self.steps - before_it, state.time)?;
            std::mem::swap(values, now);
            let time = state.time;
            system.accepted(time, &state.q, &state.v).map_err(|source| MotionError::Mechanism { time, source })?;
            seen(system, Progress { state, forces: &self.forces, ledger: &book, crossings: &crossed });
        }
        Ok(())
    }

    /// Whether an error control takes steps that lead nowhere: hours for one row of a motion are no answer.
    fn crawls<E>(&self, way: f64, steps: u64, time: f64) -> Result<(), MotionError<E>> {
        let StepControl::Adaptive { largest, .. } = self.control else { return Ok(()) };
        let step = way / steps as f64;
        if steps < MANY_STEPS || step >= CRAWLING * largest {
            return Ok(());
        }
        Err(MotionError::Crawls { time, steps, step, largest })
    }

    fn first_step(&self) -> f64 {
        match self.control {
            StepControl::Fixed(h) => h,
            StepControl::Adaptive { first, .. } => first,
        }
    }

    fn check<M: Mechanism>(&self, system: &M, state: &State) -> Result<(), MotionError<M::Error>> {
        let n = system.mass().nrows();
        if self.scale.len() != n || state.q.len() != n || state.v.len() != n {
            let (scale, coordinates, velocities) = (self.scale.len(), state.q.len(), state.v.len());
            return Err(MotionError::Lengths { mass: n, scale, coordinates, velocities });
        }
        let controls = match self.control {
            StepControl::Fixed(h) => [("step", h); 4],
            StepControl::Adaptive { tolerance, first, least, largest } => {
                [("tolerance", tolerance), ("first step", first), ("least step", least), ("largest step", largest)]
            }
        };
        let scales = self.scale.iter().map(|&s| ("scale of a coordinate", s));
        if let Some((name, value)) = controls.into_iter().chain(scales).find(|(_, x)| !(*x > 0.0 && x.is_finite())) {
            return Err(MotionError::NotPositive { name, value });
        }
        if let Scheme::GeneralisedAlpha { rho } = self.scheme
            && !(0.0..=1.0).contains(&rho)
        {
            return Err(MotionError::SpectralRadius { rho });
        }
        Ok(())
    }

    /// Accelerations and energy at the start.
    fn open<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        state: &mut State,
    ) -> Result<(), MotionError<M::Error>> {
        let time = state.time;
        let fail = |source| MotionError::Mechanism { time, source };
        self.forces.clear();
        system.forces(time, &state.q, &state.v, &mut self.forces).map_err(fail)?;
        state.a.copy_from(&self.forces.conservative);
        state.a += &self.forces.other;
        mass.solve_mut(&mut state.a);
        state.averaged.copy_from(&state.a);
        state.powers = self.forces.powers();
        let potential = system.potential(time, &state.q).map_err(fail)?;
        self.ledger = Some(Ledger::open(system.mass(), &state.v, potential));
        Ok(())
    }
}
