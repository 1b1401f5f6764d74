//! One cycle of a motion: the only place that advances it in time.

use super::{Counts, Course, CycleTimes, RowPlace, Timetable};
use crate::{Direction, Envelope, Integrator, Ledger, Mechanism, MotionError, Progress, State};

/// A state of a motion at which a row is written.
#[derive(Debug)]
pub struct Row<'a, M> {
    /// The mechanism in this state.
    pub system: &'a mut M,
    /// State of the motion.
    pub state: &'a State,
    /// Energy so far.
    pub ledger: &'a Ledger,
}

/// Receiver of the rows of a cycle.
pub type RowReader<'a, M, E> = &'a mut dyn FnMut(Row<'_, M>) -> Result<(), E>;

impl<M: Mechanism, T: Timetable<M>> Course<M, T> {
    /// Runs one cycle. `seen` receives every row; an error from it ends the motion. Returns the extent of coordinates
    /// and velocities in the cycle.
    ///
    /// # Errors
    /// [`MotionError`], including [`MotionError::StandsStill`] if there is no further cycle; the errors of `seen`.
    pub fn run_cycle<E: From<MotionError<M::Error>>>(
        &mut self,
        mut seen: Option<RowReader<'_, M, E>>,
    ) -> Result<Envelope, E> {
        let begin = self.state.time;
        let Some(CycleTimes { stops, rows, control }) = self.timetable.cycle(&self.system, self.cycle, begin) else {
            return Err(MotionError::StandsStill { cycle: self.cycle }.into());
        };
        if self.timetable.restarts() {
            self.forget();
        }
        let mut integrator = self.take_integrator(control);
        let steps_before = integrator.steps();
        let mut envelope = Envelope::new(&self.state);
        let mut steps = 0;
        if rows == RowPlace::Beginnings {
            integrator.begin(&mut self.system, &mut self.state)?;
        }
        let Self { system, state, counts, .. } = self;
        counts.crossings.resize(system.events(), [0; 2]);
        let mut failed = None;
        for stop in &stops {
            if let (RowPlace::Beginnings, Some(seen), Some(ledger)) = (rows, seen.as_mut(), integrator.ledger())
                && stop.is_row
            {
                seen(Row { system, state, ledger })?;
            }
            integrator.advance(system, state, stop.time, |system, progress| {
                let Progress { state, ledger, .. } = progress;
                steps += 1;
                envelope.widen(state);
                count(counts, &progress);
                if let (RowPlace::Steps(n), Some(seen), None) = (rows, seen.as_mut(), &failed)
                    && u64::is_multiple_of(steps, n.max(1))
                {
                    failed = seen(Row { system, state, ledger }).err();
                }
            })?;
            if let Some(error) = failed {
                return Err(error);
            }
            if let (RowPlace::Ends, Some(seen), Some(ledger)) = (rows, seen.as_mut(), integrator.ledger())
                && stop.is_row
            {
                seen(Row { system, state, ledger })?;
            }
        }
        let [taken, refused] = integrator.steps();
        counts.steps += taken - steps_before[0];
        counts.refused += refused - steps_before[1];
        if let Some(end) = stops.last() {
            system.end_cycle(begin, end.time);
        }
        self.ledger = integrator.ledger().copied();
        self.integrator = Some(integrator);
        self.cycle += 1;
        Ok(envelope)
    }

    /// Computes accelerations and energy at the start, if nothing has been advanced yet. A row at the start needs them.
    ///
    /// # Errors
    /// [`MotionError`] if the forces cannot be computed.
    pub fn begin(&mut self) -> Result<&Ledger, MotionError<M::Error>> {
        if self.ledger.is_none()
            && let Some(times) = self.timetable.cycle(&self.system, self.cycle, self.state.time)
        {
            let mut integrator = self.take_integrator(times.control);
            integrator.begin(&mut self.system, &mut self.state)?;
            self.ledger = integrator.ledger().copied();
            self.integrator = Some(integrator);
        }
        self.ledger.as_ref().ok_or(MotionError::StandsStill { cycle: self.cycle })
    }

    /// Forgets all that mechanism and integrator remember: what follows depends on the state alone, to the last bit.
    pub(super) fn forget(&mut self) {
        self.system.forget();
        self.integrator = None;
    }

    fn take_integrator(&mut self, control: crate::StepControl) -> Integrator {
        if let Some(known) = self.integrator.take() {
            return known.with_control(control);
        }
        let new = self.timetable.method(&self.system).integrator(control);
        match self.ledger {
            Some(ledger) => new.resumed(ledger),
            None => new,
        }
    }
}

fn count(counts: &mut Counts, progress: &Progress<'_>) {
    for crossing in progress.crossings {
        if let Some(both) = counts.crossings.get_mut(crossing.event) {
            both[usize::from(crossing.direction == Direction::Down)] += 1;
        }
    }
}
