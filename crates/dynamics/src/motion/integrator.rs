//! Steps one after the other: their length, their events, their energy.

use nalgebra::{Cholesky, DVector, Dyn};

use super::{
    Crossing, Direction, Forces, Ledger, Mechanism, MotionError, State, energy,
    events::{between, root},
    generalised_alpha::Coefficients,
    runge_kutta::{CLASSICAL, DORMAND_PRINCE},
};

/// How often a step of given length may be halved that has no solution.
const HALVINGS: u32 = 6;

/// Method of integration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// Generalised-alpha with this spectral radius at infinite frequency, 0 .. 1.
    GeneralisedAlpha {
        /// rho at infinity: 1 keeps all high frequencies, 0 takes them away in one step.
        rho: f64,
    },
    /// Newmark's constant average acceleration.
    Newmark,
    /// Implicit midpoint with a discrete gradient: keeps energy to round-off.
    Energy,
    /// Dormand-Prince 5(4), explicit.
    DormandPrince,
    /// Runge-Kutta's classical method of fourth order, explicit.
    RungeKutta4,
}

/// How long steps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepControl {
    /// Always this long.
    Fixed(f64),
    /// Such that the local error of a step stays below `tolerance` times the coordinates' scale.
    Adaptive {
        /// Local error over scale.
        tolerance: f64,
        /// First step.
        first: f64,
        /// A shorter step is an error.
        least: f64,
        /// Longest step.
        largest: f64,
    },
}

/// What a caller sees of a motion after every step.
#[derive(Debug)]
pub struct Progress<'a> {
    /// State at the end of the step.
    pub state: &'a State,
    /// Forces of the step's last evaluation: at its end, in its middle with [`Scheme::Energy`].
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
    forces: Forces,
    ledger: Option<Ledger>,
    steps: u64,
    refused: u64,
}

impl Integrator {
    /// `scale`: what counts as a large motion of each coordinate, > 0; tolerances are relative to it.
    pub fn new(scheme: Scheme, control: StepControl, scale: DVector<f64>) -> Self {
        let forces = Forces::zeros(scale.len());
        Self { scheme, control, scale, stop_at_events: false, forces, ledger: None, steps: 0, refused: 0 }
    }

    /// Ends a step at every event, so that no step runs over a kink of the forces.
    #[must_use]
    pub fn stopping_at_events(self, stop_at_events: bool) -> Self {
        Self { stop_at_events, ..self }
    }

    /// Energy so far; `None` before the first step.
    pub fn ledger(&self) -> Option<&Ledger> {
        self.ledger.as_ref()
    }

    /// Goes on with a ledger of before (restart).
    #[must_use]
    pub fn resumed(self, ledger: Ledger) -> Self {
        Self { ledger: Some(ledger), ..self }
    }

    /// Steps taken, and steps taken back because their error was too large.
    pub fn steps(&self) -> [u64; 2] {
        [self.steps, self.refused]
    }

    /// From `state` to the time `until`, calling `seen` after every step. A start finds its accelerations itself.
    ///
    /// # Errors
    /// [`MotionError`].
    pub fn advance<M: Mechanism>(
        &mut self,
        system: &mut M,
        state: &mut State,
        until: f64,
        mut seen: impl FnMut(&mut M, Progress<'_>),
    ) -> Result<(), MotionError<M::Error>> {
        let mass = self.check(system, state)?;
        if self.ledger.is_none() {
            self.open(system, &mass, state)?;
        }
        let mut values = self.event_values(system, state.time, &state.q, &state.v)?;
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
            let before = state.clone();
            let h = wanted.min(until - state.time);
            let shortened = h < wanted;
            // A sliver at the end would be a step of its own.
            let h = if until - state.time - h < 1e-9 * h { until - state.time } else { h };
            let (mut to, mut book, next) = self.accepted_step(system, &mass, &before, h)?;
            let mut now = self.event_values(system, to.time, &to.q, &to.v)?;
            let mut crossings = self.crossings(system, &before, &to, &values, &now)?;
            let first = crossings.iter().map(|c| c.time).fold(f64::INFINITY, f64::min);
            if self.stop_at_events && first < to.time - 1e-9 * h && first > before.time + 1e-9 * h {
                (to, book) = self.one_step(system, &mass, &before, first - before.time).map(|(s, _, b)| (s, b))?;
                now = self.event_values(system, to.time, &to.q, &to.v)?;
                crossings.retain(|c| c.time <= first);
            }
            // A step that was short because the time was up says nothing against the length wanted.
            to.next_step = if shortened && next >= h { next.max(wanted) } else { next };
            self.ledger = Some(book);
            self.steps += 1;
            *state = to;
            values = now;
            let time = state.time;
            system.accepted(time, &state.q, &state.v).map_err(|source| MotionError::Mechanism { time, source })?;
            seen(system, Progress { state, forces: &self.forces, ledger: &book, crossings: &crossings });
        }
        Ok(())
    }

    fn first_step(&self) -> f64 {
        match self.control {
            StepControl::Fixed(h) => h,
            StepControl::Adaptive { first, .. } => first,
        }
    }

    fn check<M: Mechanism>(&self, system: &M, state: &State) -> Result<Cholesky<f64, Dyn>, MotionError<M::Error>> {
        let n = system.mass().nrows();
        if self.scale.len() != n || state.q.len() != n || state.v.len() != n {
            return Err(MotionError::Options("mass, scale and state are of different lengths"));
        }
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let steps = match self.control {
            StepControl::Fixed(h) => positive(h),
            StepControl::Adaptive { tolerance, first, least, largest } => {
                [tolerance, first, least, largest].into_iter().all(positive)
            }
        };
        if !steps || !self.scale.iter().all(|&s| positive(s)) {
            return Err(MotionError::Options("steps, tolerance and scales must be positive"));
        }
        if let Scheme::GeneralisedAlpha { rho } = self.scheme
            && !(0.0..=1.0).contains(&rho)
        {
            return Err(MotionError::Options("the spectral radius of generalised-alpha lies between 0 and 1"));
        }
        Cholesky::new(system.mass().clone()).ok_or(MotionError::Singular { time: state.time, which: "mass" })
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
        state.a = mass.solve(&(&self.forces.conservative + &self.forces.other));
        state.averaged.copy_from(&state.a);
        state.powers = self.forces.powers();
        let potential = system.potential(time, &state.q).map_err(fail)?;
        self.ledger = Some(Ledger::open(system.mass(), &state.v, potential));
        Ok(())
    }

    /// A step whose error is small enough, the energy with it, and the length of the next one.
    fn accepted_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        mut h: f64,
    ) -> Result<(State, Ledger, f64), MotionError<M::Error>> {
        let StepControl::Adaptive { tolerance, least, largest, .. } = self.control else {
            let (to, book) = self.whole_step(system, mass, from, h, HALVINGS)?;
            return Ok((to, book, h));
        };
        let order = match self.scheme {
            Scheme::DormandPrince => 5.0,
            Scheme::RungeKutta4 => 4.0,
            Scheme::Energy | Scheme::GeneralisedAlpha { .. } | Scheme::Newmark => 3.0,
        };
        loop {
            let tried = self.one_step(system, mass, from, h);
            let factor = match &tried {
                Ok((_, error, _)) => {
                    let size = error.iter().zip(self.scale.iter()).map(|(e, s)| (e / s).abs()).fold(0.0, f64::max);
                    let factor = (0.9 * (tolerance / size.max(1e-30)).powf(1.0 / order)).clamp(0.2, 2.0);
                    if size <= tolerance { Ok(factor) } else { Err(factor) }
                }
                Err(MotionError::NotConverged { .. }) => Err(0.25),
                Err(_) => Ok(1.0),
            };
            match factor {
                Ok(factor) => {
                    let (to, _, book) = tried?;
                    return Ok((to, book, (factor * h).min(largest)));
                }
                Err(factor) => {
                    self.refused += 1;
                    h *= factor.min(0.9);
                    if h < least {
                        return Err(MotionError::StepTooSmall { time: from.time, step: h, least });
                    }
                }
            }
        }
    }

    /// A step of given length. One without a solution, where contact opens and closes within it, is taken as its two halves, so often as
    /// `halvings` says; to the caller it stays one step.
    fn whole_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        h: f64,
        halvings: u32,
    ) -> Result<(State, Ledger), MotionError<M::Error>> {
        match self.one_step(system, mass, from, h) {
            Err(MotionError::NotConverged { .. }) if halvings > 0 => {
                self.refused += 1;
                let (middle, book) = self.whole_step(system, mass, from, 0.5 * h, halvings - 1)?;
                let opened = self.ledger.replace(book);
                let rest = from.time + h - middle.time;
                let second = self.whole_step(system, mass, &middle, rest, halvings - 1);
                self.ledger = opened;
                second
            }
            other => other.map(|(to, _, book)| (to, book)),
        }
    }

    /// One step by the scheme: where it ends, its local error, and the books closed behind it.
    fn one_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        h: f64,
    ) -> Result<(State, DVector<f64>, Ledger), MotionError<M::Error>> {
        let before = self.ledger.unwrap_or_default();
        let (to, error, mut book) = self.open_step(system, mass, from, h, before)?;
        book.close_step(&before, system.mass(), &to.v);
        Ok((to, error, book))
    }

    fn open_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        h: f64,
        mut book: Ledger,
    ) -> Result<(State, DVector<f64>, Ledger), MotionError<M::Error>> {
        let forces = &mut self.forces;
        let (to, error) = match self.scheme {
            Scheme::Energy => energy::step(system, from, h, &self.scale, forces, &mut book)?,
            Scheme::DormandPrince => DORMAND_PRINCE.step(system, mass, from, h, forces, &mut book)?,
            Scheme::RungeKutta4 => CLASSICAL.step(system, mass, from, h, forces, &mut book)?,
            Scheme::GeneralisedAlpha { .. } | Scheme::Newmark => {
                let coefficients = match self.scheme {
                    Scheme::GeneralisedAlpha { rho } => Coefficients::generalised_alpha(rho),
                    _ => Coefficients::newmark(0.25, 0.5),
                };
                return self.booked_by_trapezoid(system, coefficients, from, h, book);
            }
        };
        Ok((to, error, book))
    }

    /// A step of the generalised-alpha family; work is integrated by the trapezoidal rule.
    fn booked_by_trapezoid<M: Mechanism>(
        &mut self,
        system: &mut M,
        coefficients: Coefficients,
        from: &State,
        h: f64,
        mut book: Ledger,
    ) -> Result<(State, DVector<f64>, Ledger), MotionError<M::Error>> {
        let (mut to, error) = coefficients.step(system, from, h, &self.scale, &mut self.forces)?;
        to.powers = self.forces.powers();
        let work = [0, 1].map(|i| 0.5 * h * (from.powers[i] + to.powers[i]));
        book.supplied += work[0];
        book.dissipated += work[1];
        let fail = |time: f64| move |source| MotionError::Mechanism { time, source };
        let mut aside = |time: f64, q| system.potential_aside(time, q).map_err(fail(time));
        let known = book.potential;
        // What V changes by with the coordinates held, at either end of the step. Where the step ends comes last: a system may keep it.
        let [moved, still] = [aside(from.time, &to.q)?, aside(to.time, &from.q)?];
        book.potential = system.potential(to.time, &to.q).map_err(fail(to.time))?;
        let held = [still - known, book.potential - moved];
        book.parametric += 0.5 * (held[0] + held[1]);
        Ok((to, error, book))
    }

    fn event_values<M: Mechanism>(
        &self,
        system: &mut M,
        time: f64,
        q: &DVector<f64>,
        v: &DVector<f64>,
    ) -> Result<Vec<f64>, MotionError<M::Error>> {
        let mut values = vec![0.0; system.events()];
        if !values.is_empty() {
            let fail = |source| MotionError::Mechanism { time, source };
            system.event_values(time, q, v, &mut values).map_err(fail)?;
        }
        Ok(values)
    }

    fn crossings<M: Mechanism>(
        &self,
        system: &mut M,
        from: &State,
        to: &State,
        before: &[f64],
        after: &[f64],
    ) -> Result<Vec<Crossing>, MotionError<M::Error>> {
        let mut found = Vec::new();
        for event in (0..before.len()).filter(|&i| (before[i] >= 0.0) != (after[i] >= 0.0)) {
            let h = to.time - from.time;
            let share = root([before[event], after[event]], |share| {
                let (q, v) = between(from, to, share);
                self.event_values(system, from.time + share * h, &q, &v).map(|values| values[event])
            })?;
            let direction = if before[event] < 0.0 { Direction::Up } else { Direction::Down };
            found.push(Crossing { event, time: from.time + share * h, direction });
        }
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        Ok(found)
    }
}
