//! One step: by the scheme, repeated with shorter length if its error is too large, in halves if it has no solution.

use nalgebra::{Cholesky, Dyn};

use super::Integrator;
use crate::{Ledger, Mechanism, MotionError, State, StepControl, stepper::Step};

/// How often a step of given length may be halved that has no solution.
const HALVINGS: u32 = 6;
/// Into how many parts a step of given length may be taken that is too long for an explicit method.
const PARTS: f64 = 1000.0;
/// Share of the stability limit that parts make use of.
const WITHIN: f64 = 0.98;

impl Integrator {
    /// A step to `to` whose error is small enough: the energy with it, and the length of the next one.
    pub(super) fn accepted_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        mut h: f64,
        to: &mut State,
    ) -> Result<(Ledger, f64), MotionError<M::Error>> {
        let StepControl::Adaptive { tolerance, least, largest, .. } = self.control else {
            return Ok((self.fixed_step(system, mass, from, h, to)?, h));
        };
        let order = self.scheme.error_order();
        loop {
            let tried = self.one_step(system, mass, from, h, to);
            let factor = match &tried {
                Ok(_) => {
                    let size =
                        self.work.error.iter().zip(self.scale.iter()).map(|(e, s)| (e / s).abs()).fold(0.0, f64::max);
                    let factor = (0.9 * (tolerance / size.max(1e-30)).powf(1.0 / order)).clamp(0.2, 2.0);
                    if size <= tolerance { Ok(factor) } else { Err(factor) }
                }
                Err(MotionError::NotConverged { .. }) => Err(0.25),
                Err(_) => Ok(1.0),
            };
            match factor {
                Ok(factor) => {
                    return Ok((tried?, (factor * h).min(largest)));
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

    /// A step of given length to `to`, in parts where an explicit method is not stable with the whole.
    pub(super) fn fixed_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        h: f64,
        to: &mut State,
    ) -> Result<Ledger, MotionError<M::Error>> {
        let longest = self.longest_stable(system, mass, from, h)?;
        if h <= longest {
            return self.whole_step(system, mass, from, h, (to, HALVINGS));
        }
        let parts = (h / (WITHIN * longest)).ceil();
        if parts.is_nan() || parts > PARTS {
            return Err(MotionError::Unstable { time: from.time, step: h, longest });
        }
        self.refused += 1;
        let opened = self.ledger;
        let (mut here, mut book) = (from.clone(), opened.unwrap_or_default());
        for i in 1..=parts as usize {
            let until = from.time + h * (i as f64 / parts);
            book = self.one_step(system, mass, &here, until - here.time, to)?;
            here.copy_from(to);
            self.ledger = Some(book);
        }
        self.ledger = opened;
        Ok(book)
    }

    /// Longest step with which an explicit method is stable at a state, as far as it matters for a step of length `h`;
    /// infinite where nobody asked.
    fn longest_stable<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        h: f64,
    ) -> Result<f64, MotionError<M::Error>> {
        let Some(guard) = &mut self.guard else { return Ok(f64::INFINITY) };
        if self.tangents_at != Some(from.time) {
            let time = from.time;
            self.forces.clear();
            (self.forces.tangents, self.forces.rates) = (true, false);
            let found = system.forces(time, &from.q, &from.v, &mut self.forces);
            found.map_err(|source| MotionError::Mechanism { time, source })?;
            self.tangents_at = Some(time);
        }
        Ok(guard.longest(mass, &self.forces, h))
    }

    /// A step of given length. One without a solution, where contact opens and closes within it, is taken as its two
    /// halves, so often as `halvings` says; to the caller it stays one step.
    fn whole_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        h: f64,
        (to, halvings): (&mut State, u32),
    ) -> Result<Ledger, MotionError<M::Error>> {
        match self.one_step(system, mass, from, h, to) {
            Err(MotionError::NotConverged { .. }) if halvings > 0 => {
                self.refused += 1;
                let book = self.whole_step(system, mass, from, 0.5 * h, (to, halvings - 1))?;
                let (middle, opened) = (to.clone(), self.ledger.replace(book));
                let rest = from.time + h - middle.time;
                let second = self.whole_step(system, mass, &middle, rest, (to, halvings - 1));
                self.ledger = opened;
                second
            }
            other => other,
        }
    }

    /// One step by the scheme to `to`, and the ledger closed behind it.
    pub(super) fn one_step<M: Mechanism>(
        &mut self,
        system: &mut M,
        mass: &Cholesky<f64, Dyn>,
        from: &State,
        h: f64,
        to: &mut State,
    ) -> Result<Ledger, MotionError<M::Error>> {
        let before = self.ledger.unwrap_or_default();
        let mut ledger = before;
        let tangents = self.guard.is_some();
        self.tangents_at = tangents.then_some(from.time + h);
        let Self { scheme, scale, forces, work, .. } = self;
        let (system, book) = (&mut *system, &mut ledger);
        scheme.step(Step { system, mass, from, h, scale, forces, to, ledger: book, work, tangents })?;
        ledger.close_step(&before, system.mass(), &to.v);
        Ok(ledger)
    }
}
