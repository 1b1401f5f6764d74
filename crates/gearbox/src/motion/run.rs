//! Run of a gearbox motion, and its result.

use dynamics::{Extremes, ToothChanges};
use integrate::{Checkpoint, Compared, Counts, Course, Goal, Ledger, Mechanism, Periodicity, Row, Settle, State};
use nalgebra::DVector;

use super::{
    GearboxEnergy, GearboxInstant, GearboxMechanism, GearboxMemory, MotionPlan, MotionTimes, live_mesh::LiveMesh,
    periodic_state::Settling,
};
use crate::GearboxError;

/// A state of a gearbox motion from which it can be continued.
pub type GearboxCheckpoint = Checkpoint<GearboxMemory>;

/// Motion of a gearbox in progress.
pub type GearboxCourse<'a> = Course<&'a mut GearboxMechanism, MotionTimes>;

/// Events and extremes of a mesh's flanks in a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankCourse {
    /// Number of times the driving flanks separated.
    pub contact_losses: u64,
    /// Number of times the coast flanks came into contact.
    pub coast_contacts: u64,
    /// Extremes at the ends of steps.
    pub extremes: Extremes,
    /// Tooth changes of the driving flanks.
    pub changes: ToothChanges,
    /// Largest share of the mesh's valid range used by the motion ([`super::MovingMesh::reach`]).
    pub reach: f64,
}

/// Result of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxRun {
    /// State at the start and at the end.
    pub states: [State; 2],
    /// Energy of the deviations in the integrator's ledger.
    pub ledger: Ledger,
    /// Energy in common axes.
    pub energy: GearboxEnergy,
    /// Number of steps taken.
    pub steps: u64,
    /// Average number of steps per cycle of the fastest mesh, over the cycles with rows.
    pub steps_per_cycle: Option<f64>,
    /// Number of steps that were divided or repeated because they had no solution or too large an error.
    pub divided: u64,
    /// Events and extremes of the flanks of each mesh.
    pub flanks: Vec<FlankCourse>,
    /// Work of the output torques in the nominal motion, over all cycles, N mm.
    pub throughput: f64,
    /// Cycles of the fastest mesh before the rows.
    pub warm_up: u64,
    /// Final periodicity of the motion, its period in cycles of the fastest mesh; `None` if no two common periods of
    /// all meshes were compared.
    pub periodicity: Option<Periodicity>,
    /// Number of cycles of the fastest mesh after which all meshes are in their initial positions
    /// ([`GearboxMechanism::common_period`]).
    pub common_period: Option<u64>,
}

impl GearboxMechanism {
    /// Runs from `start`. `seen` receives the rows, including the initial state, or the state to which the motion has
    /// settled. A plan that shoots brings the motion to its periodic state by Newton's method once it nearly repeats.
    ///
    /// # Errors
    /// [`GearboxError::Motion`] of the integrator, the errors of the meshes, and those of [`GearboxMechanism::goal`].
    pub fn run(
        &mut self,
        start: &State,
        plan: &MotionPlan,
        mut seen: impl FnMut(&GearboxInstant),
    ) -> Result<GearboxRun, GearboxError> {
        let goal = self.goal(start, plan)?;
        let mut course = self.course(start, plan, None)?;
        let rows = |row: Row<'_, &mut Self>| {
            seen(&row.system.instant(row.state)?);
            Ok::<_, GearboxError>(())
        };
        course.run(&goal, &mut Settling { rows, plan: *plan })?;
        GearboxRun::of(course, start)
    }

    /// The motion from `start`, or from an intermediate state of an earlier motion with the same start.
    ///
    /// # Errors
    /// [`GearboxError::Motion`] for a state of another gearbox.
    pub fn course(
        &mut self,
        start: &State,
        plan: &MotionPlan,
        from: Option<GearboxCheckpoint>,
    ) -> Result<GearboxCourse<'_>, GearboxError> {
        let times = plan.times(self.scale(start));
        Ok(match from {
            None => {
                let [angle, _] = self.nominal_turn(start.time);
                self.varying.begin(start.time, angle, &start.q);
                Course::new(self, times, start.clone())
            }
            Some(from) => Course::resume(self, times, from)?,
        })
    }

    /// Goal of a motion from `start` according to a plan, without checkpoints.
    ///
    /// # Errors
    /// [`GearboxError::NoCommonPeriod`] if the motion must settle and its meshes do not repeat together in time,
    /// [`GearboxError::ModesWithoutPeriod`] if it must shoot.
    pub fn goal<'a>(&self, start: &State, plan: &MotionPlan) -> Result<Goal<&'a mut Self>, GearboxError> {
        let compared = match plan.settle {
            Some(Settle { most, .. }) => {
                let period = self.back_within(most)?;
                // Amplitudes of modes are in the gears' own frames: as they stand they come back after whole turns.
                if plan.shoots {
                    self.back_over(period)?;
                }
                Some(self.compared(self.scale(start), period))
            }
            None => None,
        };
        Ok(Goal {
            compared,
            settle: plan.settle,
            tolerance: plan.periodic_tolerance(),
            cycles: plan.cycles,
            starts_with_row: true,
            checkpoint_every: 0,
            stop_after: None,
        })
    }

    /// The common period ([`Self::common_period`]), if the motion settles within `most` cycles.
    ///
    /// # Errors
    /// [`GearboxError::NoCommonPeriod`] if there is none, or if it is longer.
    pub fn back_within(&self, most: u64) -> Result<u64, GearboxError> {
        let period = self.common_period();
        period.filter(|p| *p <= most.max(1)).ok_or(GearboxError::NoCommonPeriod { period, most })
    }

    /// What tells whether a motion repeats itself: all coordinates, of the given sizes, but amplitudes of modes.
    pub(super) fn compared<M: Mechanism>(&self, mut scale: DVector<f64>, period: u64) -> Compared<M> {
        self.gears.sizes(1.0).for_each(|(i, _)| scale[i] = f64::INFINITY);
        Compared::States { scale, free: self.free.turn, period }
    }

    /// Events and extremes of a mesh's flanks in a motion with these counts.
    pub fn flank_course(&self, mesh: usize, counts: &Counts) -> FlankCourse {
        FlankCourse {
            contact_losses: counts.downs(2 * mesh),
            coast_contacts: counts.ups(2 * mesh + 1),
            extremes: self.extremes[mesh],
            changes: self.changes(mesh),
            reach: self.reach[mesh],
        }
    }

    /// Number of cycles of the fastest mesh after which every mesh has gone through whole cycles and, if teeth differ,
    /// the same teeth meet again ([`super::MovingMesh::period`]); `None` if that takes more than 100,000.
    pub fn common_period(&self) -> Option<u64> {
        let fastest = self.fastest();
        // Numbers of teeth are whole: what is no multiple is off by more than the inverse of the longest period.
        let is_whole = |x: f64| (x - x.round()).abs() < 1e-3 / LONGEST as f64;
        let comes_back = |n: u64, mesh: &LiveMesh| {
            let cycles = n as f64 * (mesh.cycles_per_turn / fastest).abs();
            is_whole(cycles) && (cycles.round() as u64).is_multiple_of(mesh.period())
        };
        (1..=LONGEST).find(|&n| self.live.iter().all(|mesh| comes_back(n, mesh)))
    }
}

/// Longest common period that is looked for, cycles of the fastest mesh.
const LONGEST: u64 = 100_000;

impl GearboxRun {
    /// Result of a motion that started at `start`.
    ///
    /// # Errors
    /// The errors of the meshes.
    pub fn of(course: GearboxCourse<'_>, start: &State) -> Result<Self, GearboxError> {
        let (state, ledger) = (course.state().clone(), course.ledger().copied().unwrap_or_default());
        let (counts, stage, steps_per_cycle) = (course.counts().clone(), course.stage(), course.steps_per_cycle());
        let (warm_up, found) = (course.cycle() - stage.recorded, stage.periodicity);
        let mechanism = course.into_system();
        let energy = mechanism.energy(start, &state, &ledger)?;
        let common_period = mechanism.common_period();
        Ok(Self {
            states: [start.clone(), state],
            ledger,
            energy,
            steps: counts.steps,
            steps_per_cycle,
            divided: counts.refused,
            flanks: (0..mechanism.live.len()).map(|mesh| mechanism.flank_course(mesh, &counts)).collect(),
            throughput: mechanism.throughput,
            warm_up,
            periodicity: found,
            common_period,
        })
    }
}
