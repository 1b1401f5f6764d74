//! Settling, then rows, with checkpoints in between.

use super::{Ahead, Checkpoint, Compared, Course, Resumable, Row, Settle, Stage, Timetable};
use crate::{Mechanism, MotionError, Periodicity, Recurrence, SignalRecurrence, State};

/// Cycles before a nearer state is sought; the next tries come after half as many again.
const FIRST_SHOT: u64 = 8;

/// Goal of a motion.
#[derive(Debug)]
pub struct Goal<M: Mechanism> {
    /// Comparison that decides whether the motion repeats; `None`: no comparison.
    pub compared: Option<Compared<M>>,
    /// Settling before the rows.
    pub settle: Option<Settle>,
    /// Difference over a period that counts as periodic in cycles with rows.
    pub tolerance: f64,
    /// Number of cycles with rows.
    pub cycles: u64,
    /// Whether the state at which rows begin is a row itself.
    pub starts_with_row: bool,
    /// Number of cycles between checkpoints; 0: no checkpoints.
    pub checkpoint_every: u64,
    /// Stops with a checkpoint after this number of cycles, settling included.
    pub stop_after: Option<u64>,
}

/// Observer of a motion; it can end the motion by an error.
pub trait Follower<M: Resumable> {
    /// Error with which the observer ends a motion, including the errors of the motion.
    type Error: From<MotionError<M::Error>>;

    /// Called for each row.
    ///
    /// # Errors
    /// Any error ends the motion.
    fn row(&mut self, row: Row<'_, M>) -> Result<(), Self::Error>;

    /// Called at the end of each cycle.
    ///
    /// # Errors
    /// Any error ends the motion.
    fn cycle(&mut self, _stage: &Stage) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called with a state from which the motion can be continued, after all rows so far.
    ///
    /// # Errors
    /// Any error ends the motion.
    fn checkpoint(&mut self, _state: Checkpoint<M::Memory>) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Whether a motion with this periodicity is to be brought to its periodic state immediately.
    fn seeks(&self, _system: &M, _found: Periodicity) -> bool {
        false
    }

    /// A state at the same time that is nearer to the periodic one than the state reached by waiting, given the cycles
    /// of the next period; `None` if there is none. It is requested occasionally for a motion that [`Follower::seeks`]
    /// it.
    ///
    /// # Errors
    /// Any error ends the motion.
    fn nearer(&mut self, _system: &mut M, _period: &Ahead) -> Result<Option<State>, Self::Error> {
        Ok(None)
    }
}

/// Observer that only receives rows.
#[derive(Debug)]
pub struct OnlyRows<F>(pub F);

impl<M, E, F> Follower<M> for OnlyRows<F>
where
    M: Resumable,
    E: From<MotionError<M::Error>>,
    F: FnMut(Row<'_, M>) -> Result<(), E>,
{
    type Error = E;

    fn row(&mut self, row: Row<'_, M>) -> Result<(), E> {
        self.0(row)
    }
}

impl<M: Resumable, T: Timetable<M>> Course<M, T> {
    /// Settles if requested, then runs the cycles with rows. Returns whether it stopped early.
    ///
    /// # Errors
    /// The errors of the motion and of the observer.
    pub fn run<F: Follower<M>>(&mut self, goal: &Goal<M>, follower: &mut F) -> Result<bool, F::Error> {
        Ok(self.settle(goal, follower)? || self.record(goal, follower)?)
    }

    /// Runs cycles without rows until the motion repeats, at most the permitted number. Returns whether it stopped
    /// early. Does nothing for a motion that already writes rows.
    ///
    /// # Errors
    /// The errors of the motion and of the observer.
    pub fn settle<F: Follower<M>>(&mut self, goal: &Goal<M>, follower: &mut F) -> Result<bool, F::Error> {
        self.begin_comparing(goal);
        let Some(Settle { tolerance, most }) = goal.settle.as_ref().filter(|_| !self.stage.recording) else {
            self.stage.recording = true;
            return Ok(false);
        };
        while self.cycle < *most {
            let found = self.settling_cycle(goal, *tolerance)?;
            self.stage.recording = found.is_some_and(|p| p.residual <= *tolerance);
            follower.cycle(&self.stage)?;
            // States are compared at the ends of periods, from the beginning of the last one on.
            let is_period = goal.compared.as_ref().is_none_or(|own| self.cycle.is_multiple_of(own.period()));
            if let (false, true, Some(found)) = (self.stage.recording, is_period, found) {
                self.shoot((found, goal), follower)?;
            }
            if self.after_cycle(goal, follower)? {
                return Ok(true);
            }
            if self.stage.recording {
                break;
            }
        }
        self.stage.recording = true;
        Ok(false)
    }

    /// Runs the cycles with rows. Returns whether it stopped early.
    ///
    /// # Errors
    /// The errors of the motion and of the observer.
    pub fn record<F: Follower<M>>(&mut self, goal: &Goal<M>, follower: &mut F) -> Result<bool, F::Error> {
        self.begin_comparing(goal);
        self.stage.recording = true;
        if self.stage.recorded == 0 {
            self.stage.steps_before = self.counts.steps;
        }
        if goal.starts_with_row && self.stage.rows == 0 {
            let ledger = *self.begin()?;
            follower.row(Row { system: &mut self.system, state: &self.state, ledger: &ledger })?;
            self.stage.rows = 1;
        }
        while self.stage.recorded < goal.cycles && self.goes_on() {
            let mut rows = 0;
            let envelope = self.run_cycle(Some(&mut |row: Row<'_, M>| {
                rows += 1;
                follower.row(row)
            }))?;
            self.stage.recorded += 1;
            self.stage.rows += rows;
            if let Some(own @ Compared::States { scale, free, .. }) = &goal.compared {
                let (period, is_period) = (own.period(), self.cycle.is_multiple_of(own.period()));
                let Self { stage, state, .. } = self;
                stage.judge_states((state, envelope), (scale, *free), (period, is_period, goal.tolerance));
            }
            follower.cycle(&self.stage)?;
            if self.stage.recorded < goal.cycles && self.after_cycle(goal, follower)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn begin_comparing(&mut self, goal: &Goal<M>) {
        if let (None, Some(Compared::States { .. })) = (&self.stage.states, &goal.compared) {
            self.stage.states = Some(Recurrence::from(&self.state));
        }
    }

    /// One cycle on the way to the periodic state, and how nearly the last period repeats an earlier one.
    fn settling_cycle<E: From<MotionError<M::Error>>>(
        &mut self,
        goal: &Goal<M>,
        tolerance: f64,
    ) -> Result<Option<Periodicity>, E> {
        match &goal.compared {
            None => {
                self.run_cycle::<E>(None)?;
            }
            Some(own @ Compared::States { scale, free, .. }) => {
                let envelope = self.run_cycle::<E>(None)?;
                let is_period = self.cycle.is_multiple_of(own.period());
                let Self { stage, state, .. } = self;
                stage.judge_states((state, envelope), (scale, *free), (own.period(), is_period, tolerance));
            }
            Some(own @ Compared::Signal { of: signal, .. }) => {
                let mut rows = Vec::new();
                self.run_cycle::<E>(Some(&mut |Row { system, state, .. }: Row<'_, M>| {
                    let time = state.time;
                    rows.push(signal(system, state).map_err(|source| MotionError::Mechanism { time, source })?);
                    Ok(())
                }))?;
                let is_period = self.cycle.is_multiple_of(own.period());
                self.stage.judge_signal(rows, (own.period(), is_period, tolerance));
            }
        }
        Ok(self.stage.periodicity)
    }

    /// Goes on from a nearer state, where one is found.
    fn shoot<F: Follower<M>>(
        &mut self,
        (found, goal): (Periodicity, &Goal<M>),
        follower: &mut F,
    ) -> Result<(), F::Error> {
        if self.cycle < self.stage.next_shot.max(FIRST_SHOT) || !follower.seeks(&self.system, found) {
            return Ok(());
        }
        self.stage.next_shot = self.cycle + self.cycle / 2;
        let period = match &goal.compared {
            Some(Compared::States { period, .. }) => *period,
            _ => found.period as u64,
        };
        let Some(ahead) = self.ahead(period) else { return Ok(()) };
        let Some(there) = follower.nearer(&mut self.system, &ahead)? else { return Ok(()) };
        self.replace(there)?;
        (self.stage.signal, self.stage.envelope) = (SignalRecurrence::default(), None);
        self.stage.rows_of_period.clear();
        self.stage.states = self.stage.states.is_some().then(|| Recurrence::from(&self.state));
        Ok(())
    }

    /// Hands out a checkpoint where one is due; whether the motion is to stop here.
    fn after_cycle<F: Follower<M>>(&mut self, goal: &Goal<M>, follower: &mut F) -> Result<bool, F::Error> {
        let stop = goal.stop_after.is_some_and(|cycles| self.cycle >= cycles);
        let is_due = goal.checkpoint_every > 0 && self.cycle.is_multiple_of(goal.checkpoint_every);
        if !(stop || is_due) {
            return Ok(false);
        }
        // Who goes on and who takes it up again go the same way.
        self.forget();
        if let Some(state) = self.checkpoint() {
            follower.checkpoint(state)?;
        }
        Ok(stop)
    }
}
