//! Steady motions of a pair at many speeds.

use std::ops::ControlFlow;

use dynamics::{Drive, Extremes, ToothChanges};
use integrate::{Ledger, OnlyRows, Periodicity, State, SweepDirection};
use ltca::StaticError;

use super::{
    GearboxMechanism, MotionTimes, PairInstant, PairModel, PairMotion, instants, pair_run::steady_goal, shoot,
};
use crate::GearboxError;

/// Method that finds a steady state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SteadyBy {
    /// Integrates until the motion repeats itself.
    Running,
    /// Shoots first, then integrates the motions that are left.
    Shooting,
}

/// Options of the search for a steady state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyOptions {
    /// Method that finds it.
    pub by: SteadyBy,
    /// Difference over a period over the peak to peak that counts as none.
    pub tolerance: f64,
    /// Mesh cycles to wait at the most.
    pub most: u64,
    /// Mesh cycles with rows after that.
    pub cycles: u64,
}

/// Speeds, directions, and options of each point.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPlan {
    /// Speeds of the driver, rad/s, ascending, > 0.
    pub speeds: Vec<f64>,
    /// Directions in which to go through them.
    pub ways: Vec<SweepDirection>,
    /// Method, rows and steps.
    pub times: MotionTimes,
    /// Steady state.
    pub steady: SteadyOptions,
}

/// Result at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPoint {
    /// Speed of the driver, rad/s.
    pub speed: f64,
    /// Direction of the sweep.
    pub way: SweepDirection,
    /// Whether it began in its own quasi-static equilibrium, not where a speed beside it ended.
    pub own_start: bool,
    /// Periodicity of the motion: how well it repeats itself.
    pub periodicity: Periodicity,
    /// Mesh cycles waited.
    pub waited: u64,
    /// Dynamic transmission error row by row, mm.
    pub transmission_error: Vec<f64>,
    /// Sum of the normal forces on the driving flanks row by row, N.
    pub normal_force: Vec<f64>,
    /// Sum of the normal forces on the coast flanks, largest, N.
    pub coast_force: f64,
    /// Largest force of a bearing, N; 0 without bearings.
    pub bearing_force: f64,
    /// Energy from the start of this speed on, its settling included.
    pub ledger: Ledger,
    /// Extremes over the same time.
    pub extremes: Extremes,
    /// Tooth changes in the same time.
    pub changes: ToothChanges,
}

/// A speed without a result.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepMiss {
    /// Speed of the driver, rad/s.
    pub speed: f64,
    /// Direction of the sweep.
    pub way: SweepDirection,
    /// Why: of its own quasi-static start, where it was tried from there as well.
    pub error: GearboxError,
}

/// Outcome of a sweep at one speed.
pub type SweepOutcome = Result<SweepPoint, SweepMiss>;

/// Sweeps `system` through speeds. Directions, and independent speeds, run in parallel; results are the same for any
/// number of threads.
///
/// A speed that cannot go on from its neighbour starts again in its own quasi-static equilibrium. After a speed without
/// a result the sweep goes on from the last one that has a result. `seen` gets each outcome and may end its direction
/// there. Outcomes are in the order of directions, and of speeds within each.
///
/// # Errors
/// [`GearboxError::SweepByTorque`] where a torque of its own drives: the sweep says the speed.
pub fn sweep(
    system: &PairModel,
    plan: &SweepPlan,
    seen: &(dyn Fn(&SweepOutcome) -> ControlFlow<()> + Sync),
) -> Result<Vec<SweepOutcome>, GearboxError> {
    if matches!(system.options().drive, Drive::Torque { .. }) {
        return Err(GearboxError::SweepByTorque);
    }
    let at = |way: SweepDirection, &speed: &f64, from: Option<&State>| {
        steady_state_at(system, plan, way, speed, from).map_err(|error| SweepMiss { speed, way, error })
    };
    // A starved window does not depend on the start.
    let starved = |miss: &SweepMiss| miss.error.contact_error().is_some_and(StaticError::is_starved);
    let all = integrate::sweep(&plan.speeds, &plan.ways, at, starved, |_, outcome| seen(outcome));
    Ok(all.into_iter().flatten().map(|(_, outcome)| outcome).collect())
}

fn steady_state_at(
    system: &PairModel,
    plan: &SweepPlan,
    way: SweepDirection,
    speed: f64,
    state: Option<&State>,
) -> Result<(SweepPoint, State), GearboxError> {
    let own = system.at_speed(speed);
    let mut machine = own.machine()?;
    let own_start = state.is_none();
    let state = match state {
        Some(before) => State::new(0.0, before.q.clone(), before.v.clone()),
        None => machine.start(0.0).map_err(GearboxError::at(0.0))?,
    };
    let mut motion = PairMotion::new(machine, plan.times.clone(), state);
    let SteadyOptions { by, tolerance, most, cycles } = plan.steady;
    let goal = steady_goal(&motion, (tolerance, most), cycles)?;
    if by == SteadyBy::Shooting {
        let period = motion.system().back_within(most).map_err(GearboxError::at(0.0))?;
        shoot(&mut motion, period, tolerance)?;
    }
    motion.settle(&goal, &mut OnlyRows(instants(|_, _, _| ())))?;
    let periodicity = motion.stage().periodicity.unwrap_or(Periodicity { period: 1, residual: f64::INFINITY });
    let mut point = SweepPoint {
        speed,
        way,
        own_start,
        periodicity,
        waited: motion.cycle(),
        transmission_error: Vec::new(),
        normal_force: Vec::new(),
        coast_force: 0.0,
        bearing_force: 0.0,
        ledger: Ledger::default(),
        extremes: Extremes::default(),
        changes: ToothChanges::default(),
    };
    let row = |now: &PairInstant, _: &Ledger, _: &GearboxMechanism| {
        let [driving, coast] = now.normal_forces();
        point.transmission_error.push(now.mesh.transmission_error);
        point.normal_force.push(driving);
        point.coast_force = point.coast_force.max(coast);
        for bearing in &now.bearings {
            point.bearing_force = point.bearing_force.max(bearing.force.iter().map(|f| f * f).sum::<f64>().sqrt());
        }
    };
    motion.record(&goal, &mut OnlyRows(instants(row)))?;
    point.ledger = motion.ledger().copied().unwrap_or_default();
    (point.extremes, point.changes) = (*motion.system().extremes(0), motion.system().changes(0));
    let end = motion.state().clone();
    Ok((point, end))
}
