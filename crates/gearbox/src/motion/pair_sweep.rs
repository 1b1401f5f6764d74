//! Steady motions of a pair at many speeds.

use std::ops::ControlFlow;

use dynamics::{Drive, Extremes, ToothChanges};
use integrate::{Ledger, OnlyRows, Periodicity, State, SweepDirection};
use ltca::StaticError;

use super::{
    GearboxMechanism, MotionTimes, PairInstant, PairModel, PairMotion, instants, pair_run::steady_goal, shoot,
};
use crate::GearboxError;

/// Method for the steady state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SteadyBy {
    /// Integrates until the motion repeats.
    Running,
    /// Shoots first, then integrates the motions that did not converge.
    Shooting,
}

/// Options of the search for a steady state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyOptions {
    /// Method of the search.
    pub by: SteadyBy,
    /// Difference over a period, relative to the peak to peak, that counts as periodic.
    pub tolerance: f64,
    /// Largest number of mesh cycles to wait.
    pub most: u64,
    /// Number of mesh cycles with rows after that.
    pub cycles: u64,
}

/// Speeds, directions, and options of each point of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPlan {
    /// Speeds of the driver, rad/s, ascending, > 0.
    pub speeds: Vec<f64>,
    /// Directions of the sweep through the speeds.
    pub ways: Vec<SweepDirection>,
    /// Method, rows and steps.
    pub times: MotionTimes,
    /// Options of the search for a steady state.
    pub steady: SteadyOptions,
}

/// Result of a sweep at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPoint {
    /// Speed of the driver, rad/s.
    pub speed: f64,
    /// Direction of the sweep.
    pub way: SweepDirection,
    /// Whether the run started in its own quasi-static equilibrium instead of the final state at a neighbouring speed.
    pub own_start: bool,
    /// Periodicity of the motion: how accurately it repeats.
    pub periodicity: Periodicity,
    /// Number of mesh cycles waited.
    pub waited: u64,
    /// Dynamic transmission error of each row, mm.
    pub transmission_error: Vec<f64>,
    /// Sum of the normal forces on the driving flanks of each row, N.
    pub normal_force: Vec<f64>,
    /// Largest sum of the normal forces on the coast flanks, N.
    pub coast_force: f64,
    /// Largest force of a bearing, N; 0 without bearings.
    pub bearing_force: f64,
    /// Energy balance from the start of this speed on, including the settling.
    pub ledger: Ledger,
    /// Extremes over the same time.
    pub extremes: Extremes,
    /// Tooth changes in the same time.
    pub changes: ToothChanges,
}

/// A speed of a sweep without a result.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepMiss {
    /// Speed of the driver, rad/s.
    pub speed: f64,
    /// Direction of the sweep.
    pub way: SweepDirection,
    /// Error of the run. If the run was repeated from its own quasi-static start, it is the error of that run.
    pub error: GearboxError,
}

/// Outcome of a sweep at one speed.
pub type SweepOutcome = Result<SweepPoint, SweepMiss>;

/// Sweeps `system` through speeds. Directions, and independent speeds, run in parallel. The results are the same for
/// any number of threads.
///
/// If a speed cannot continue from its neighbour, it is started again in its own quasi-static equilibrium. After a
/// speed without a result the sweep continues from the last speed with a result. `seen` receives each outcome and may
/// end its direction there. Outcomes are in the order of directions, and of speeds in each direction.
///
/// # Errors
/// [`GearboxError::SweepByTorque`] if the input is driven by a given torque, because the sweep prescribes the speed.
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
