//! A motion from its start, row by row.

use dynamics::Speed;
use integrate::{Integrator, Ledger, Scheme, State, StepControl};

use super::{Drive, GearboxCheckpoint, GearboxEnergy, GearboxInstant, GearboxMechanism};
use crate::GearboxError;

/// How a motion is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPlan {
    /// Method.
    pub scheme: Scheme,
    /// Length of a step, s, the longest where a given speed changes: steps are then turns of the input that are alike.
    pub step: f64,
    /// Steps in all.
    pub steps: u64,
    /// Steps a row.
    pub steps_per_row: u64,
    /// Steps a cycle of the fastest mesh.
    pub steps_per_cycle: u64,
}

/// How a motion ended.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxRun {
    /// State at the start and at the end.
    pub states: [State; 2],
    /// Energy of the deviations as the integrator has it.
    pub ledger: Ledger,
    /// Energy in common axes.
    pub energy: GearboxEnergy,
    /// Steps taken.
    pub steps: u64,
    /// Steps that were taken in parts, where one had no solution.
    pub divided: u64,
    /// How often flanks of each mesh came apart: on the side that drives, and on the other one.
    pub separations: Vec<[u64; 2]>,
    /// How much of what each mesh holds the motion has used at most ([`super::MovingMesh::reach`]).
    pub reach: Vec<f64>,
}

/// A row of a motion as it comes.
#[derive(Debug)]
pub struct GearboxRow<'a> {
    /// What is read off.
    pub instant: &'a GearboxInstant,
    /// A state to go on from: of the first row at or behind the end of each cycle of the fastest mesh, but for the last
    /// row.
    pub checkpoint: Option<GearboxCheckpoint>,
}

impl GearboxMechanism {
    /// Runs from `start`; `seen` is told of rows, the start among them, and stops the motion by `false`.
    ///
    /// # Errors
    /// [`GearboxError::Motion`] of the integrator, those of the meshes.
    pub fn run(
        &mut self,
        start: &State,
        plan: &MotionPlan,
        mut seen: impl FnMut(&GearboxInstant) -> bool,
    ) -> Result<GearboxRun, GearboxError> {
        self.run_from(start, None, plan, |row| seen(row.instant))
    }

    /// The same, going on from a state on the way of an earlier run from the same start: rows before it do not come
    /// again.
    ///
    /// What meshes remember is forgotten at every state that could be gone on from, so that a motion that is taken up
    /// again goes the same way to the last bit.
    ///
    /// # Errors
    /// [`GearboxError::OtherCoordinates`] for a state of another gearbox; as of [`GearboxMechanism::run`].
    pub fn run_from(
        &mut self,
        start: &State,
        from: Option<&GearboxCheckpoint>,
        plan: &MotionPlan,
        mut seen: impl FnMut(GearboxRow<'_>) -> bool,
    ) -> Result<GearboxRun, GearboxError> {
        let scale = self.scale(start);
        let mut integrator = Integrator::new(plan.scheme, StepControl::Fixed(plan.step), scale);
        let (mut state, mut separations, mut before) = (start.clone(), vec![[0; 2]; self.live.len()], [0; 2]);
        let mut first_row = 0;
        if let Some(from) = from {
            self.restore(from)?;
            integrator = integrator.resumed(from.ledger);
            (state, separations, before) = (from.state.clone(), from.separations.clone(), from.steps);
            first_row = from.rows;
        }
        let per_row = plan.steps_per_row.max(1);
        let rows = plan.steps.div_ceil(per_row);
        let cycles = |row: u64| (row * per_row).min(plan.steps) / plan.steps_per_cycle.max(1);
        for row in first_row..=rows {
            let last = (row * per_row).min(plan.steps);
            // A step of its own for each time where these are not evenly spaced.
            let first = if self.is_ramp() { (last + 1).saturating_sub(per_row).min(last) } else { last };
            for step in first..=last {
                let until = self.time_of(start.time, plan, step)?;
                integrator.advance(self, &mut state, until, |_, progress| {
                    for crossing in progress.crossings.iter().filter(|c| c.direction == integrate::Direction::Down) {
                        separations[crossing.event / 2][crossing.event % 2] += 1;
                    }
                })?;
            }
            let instant = self.instant(&state)?;
            let is_due = row > 0 && row < rows && cycles(row) > cycles(row - 1);
            let checkpoint = integrator.ledger().filter(|_| is_due).map(|ledger| GearboxCheckpoint {
                rows: row + 1,
                cycles: cycles(row),
                state: state.clone(),
                ledger: *ledger,
                steps: sum(before, integrator.steps()),
                separations: separations.clone(),
                reach: self.reach.clone(),
            });
            if !seen(GearboxRow { instant: &instant, checkpoint }) {
                break;
            }
            if is_due {
                self.forget();
            }
        }
        let ledger = integrator.ledger().copied().unwrap_or_default();
        let energy = self.energy(start, &state, &ledger)?;
        let [steps, divided] = sum(before, integrator.steps());
        let (states, reach) = ([start.clone(), state], self.reach.clone());
        Ok(GearboxRun { states, ledger, energy, steps, divided, separations, reach })
    }

    fn is_ramp(&self) -> bool {
        matches!(self.drive, Drive::Speed(Speed::Ramp { .. }))
    }

    /// Time at which a step ends: evenly spaced, or where the input has turned by its share of the whole ramp.
    fn time_of(&self, start: f64, plan: &MotionPlan, step: u64) -> Result<f64, GearboxError> {
        // Times are counted from the start: sums of steps would drift.
        let Drive::Speed(ramp @ Speed::Ramp { start: begin, duration, .. }) = self.drive else {
            return Ok(start + plan.step * step as f64);
        };
        let angle = ramp.angle(begin + duration) * (step as f64 / plan.steps.max(1) as f64);
        let never = || GearboxError::OutOfRange { part: "the ramp".into(), quantity: "angle, rad", value: angle };
        ramp.time_at(angle).ok_or_else(never)
    }
}

fn sum(before: [u64; 2], now: [u64; 2]) -> [u64; 2] {
    [before[0] + now[0], before[1] + now[1]]
}
