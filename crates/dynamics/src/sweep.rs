//! Steady motions of a pair at many speeds.

use std::{f64::consts::TAU, ops::ControlFlow};

use integrate::{Ledger, MotionError, OnlyRows, Periodicity, State, SweepDirection, Timetable};
use ltca::StaticError;
use periodic::{Shooting, Shot};

use crate::{
    Drive, Extremes, Motion, MotionSettings, PairMechanism, PairMotionError, Speed, ToothChanges, instants,
    quasi_static_start, run::steady_goal,
};

/// Method that finds a steady state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SteadyBy {
    /// By integration until the motion repeats.
    Running,
    /// By shooting, then by integration for what is left.
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
    /// Method and rows.
    pub settings: MotionSettings,
    /// Steady state.
    pub steady: SteadyOptions,
    /// A near-by lag at the start, mm.
    pub guess: f64,
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
    pub error: PairMotionError,
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
/// [`PairMotionError::SweepByTorque`] where a torque of its own drives: the sweep says the speed.
pub fn sweep(
    system: &PairMechanism,
    plan: &SweepPlan,
    seen: &(dyn Fn(&SweepOutcome) -> ControlFlow<()> + Sync),
) -> Result<Vec<SweepOutcome>, PairMotionError> {
    if matches!(system.options().drive, Drive::Torque { .. }) {
        return Err(PairMotionError::SweepByTorque);
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
    system: &PairMechanism,
    plan: &SweepPlan,
    way: SweepDirection,
    speed: f64,
    state: Option<&State>,
) -> Result<(SweepPoint, State), PairMotionError> {
    let time = 0.0;
    let drive = match system.options().drive {
        Drive::Balanced(_) => Drive::Balanced(Speed::Constant(speed)),
        _ => Drive::Speed(Speed::Constant(speed)),
    };
    let mut own = system.with_drive(drive).map_err(|source| PairMotionError::contact(time, source))?;
    let own_start = state.is_none();
    let state = match state {
        Some(before) => State::new(time, before.q.clone(), before.v.clone()),
        None => quasi_static_start(&mut own, time, plan.guess, &plan.settings.scale)?,
    };
    let mut motion = Motion::new(own, plan.settings.clone(), state);
    let SteadyOptions { by, tolerance, most, cycles } = plan.steady;
    if by == SteadyBy::Shooting {
        shoot(&mut motion, tolerance)?;
    }
    let goal = steady_goal(&motion, (tolerance, most), cycles);
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
    let row = |now: &crate::Instant, _: &Ledger, _: &PairMechanism| {
        point.transmission_error.push(now.transmission_error);
        point.normal_force.push(now.normal_forces[0]);
        point.coast_force = point.coast_force.max(now.normal_forces[1]);
        for at in [0, crate::COORDINATES] {
            point.bearing_force = point.bearing_force.max(now.bearing.fixed_rows::<3>(at).norm());
        }
    };
    motion.record(&goal, &mut OnlyRows(instants(row)))?;
    point.ledger = motion.ledger().copied().unwrap_or_default();
    (point.extremes, point.changes) = (*motion.system().extremes(), motion.system().changes());
    let end = motion.state().clone();
    Ok((point, end))
}

/// Brings a motion at its start onto its periodic solution of one mesh cycle, or as near to one as shooting comes: the
/// residual tells.
///
/// # Errors
/// [`PairMotionError::FreeDriver`] where a torque drives: speed and position of the driver are free then.
/// [`PairMotionError::ModesWithoutPeriod`] with modes of a gear that is not known by sectors.
/// [`PairMotionError::Integration`].
pub fn shoot(motion: &mut Motion, tolerance: f64) -> Result<Shot, PairMotionError> {
    let (system, times, state) = (motion.system(), motion.timetable(), motion.state().clone());
    if system.coordinates().driver_turn().is_some() {
        return Err(PairMotionError::FreeDriver);
    }
    let Some(cycles) = Shooting::cycles(times, system, state.time, 1) else {
        return Err(MotionError::StandsStill { cycle: 0 }.into());
    };
    let search = Shooting {
        method: times.method(system),
        cycles,
        tolerance,
        frequency: TAU * system.mesh_resonance_hz(),
        free: None,
        back: Some(system.back_over(1).ok_or(PairMotionError::ModesWithoutPeriod)?),
    };
    let shot = search.from(motion.system_mut(), &state)?;
    motion.replace(shot.state.clone())?;
    Ok(shot)
}
