//! The same pair at many speeds.

use rayon::prelude::*;

use super::{
    Drive, Motion, MotionSettings, PairMechanism, PairMotionError, Periodicity, Speed, quasi_static_start,
    run_to_steady, shoot,
};
use crate::motion::{MotionError, State};

/// Which way a sweep goes through its speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Every speed begins by itself, in quasi-static equilibrium.
    Apart,
    /// From the lowest speed to the highest, each beginning where the one before ended.
    Up,
    /// From the highest to the lowest.
    Down,
}

/// How a steady state is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SteadyBy {
    /// By waiting.
    Running,
    /// Directly, then by waiting for what is left.
    Shooting,
}

/// What is asked of a steady state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyOptions {
    /// How it is found.
    pub by: SteadyBy,
    /// Difference over a period over the peak to peak that counts as none.
    pub tolerance: f64,
    /// Mesh cycles to wait at the most.
    pub most: u64,
    /// Mesh cycles that are looked at then.
    pub cycles: u64,
}

/// Speeds, ways, and what is asked of each.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPlan {
    /// Speeds of the driver, rad/s, ascending, > 0.
    pub speeds: Vec<f64>,
    /// Ways to go through them.
    pub ways: Vec<Way>,
    /// Method and rows.
    pub settings: MotionSettings,
    /// Steady state.
    pub steady: SteadyOptions,
    /// A near-by lag at the start, mm.
    pub guess: f64,
}

/// The answer at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPoint {
    /// Speed of the driver, rad/s.
    pub speed: f64,
    /// Which way it was come to.
    pub way: Way,
    /// How well it repeats itself.
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
}

/// Sweeps `system` through speeds: ways, and speeds that begin by themselves, side by side on all cores. The same numbers for any number of threads.
///
/// # Errors
/// [`MotionError::Options`] where a torque drives; [`PairMotionError`] of the first speed, in order of ways and speeds, that fails.
pub fn sweep(
    system: &PairMechanism,
    plan: &SweepPlan,
    seen: &(dyn Fn(&SweepPoint) + Sync),
) -> Result<Vec<SweepPoint>, PairMotionError> {
    if !matches!(system.options().drive, Drive::Speed(_)) {
        return Err(MotionError::Options("a sweep prescribes the speed: the driver must be driven by speed"));
    }
    let chain = |way: Way| {
        let mut state: Option<State> = None;
        let mut points = Vec::with_capacity(plan.speeds.len());
        let mut speeds = plan.speeds.clone();
        if way == Way::Down {
            speeds.reverse();
        }
        for speed in speeds {
            let (point, end) = one(system, plan, way, speed, state.take())?;
            seen(&point);
            points.push(point);
            state = Some(end);
        }
        Ok(points)
    };
    let apart = |&speed: &f64| {
        let (point, _) = one(system, plan, Way::Apart, speed, None)?;
        seen(&point);
        Ok(point)
    };
    let of_way = |&way: &Way| match way {
        Way::Apart => plan.speeds.par_iter().map(apart).collect::<Vec<Result<_, _>>>().into_iter().collect(),
        _ => chain(way),
    };
    let all: Vec<Result<Vec<SweepPoint>, PairMotionError>> = plan.ways.par_iter().map(of_way).collect();
    Ok(all.into_iter().collect::<Result<Vec<_>, _>>()?.concat())
}

fn one(
    system: &PairMechanism,
    plan: &SweepPlan,
    way: Way,
    speed: f64,
    state: Option<State>,
) -> Result<(SweepPoint, State), PairMotionError> {
    let time = 0.0;
    let mut own = system
        .with_drive(Drive::Speed(Speed::Constant(speed)))
        .map_err(|source| MotionError::Mechanism { time, source })?;
    let state = match state {
        Some(before) => State::new(time, before.q, before.v),
        None => quasi_static_start(&mut own, time, plan.guess, &plan.settings.scale)?,
    };
    let mut motion = Motion::new(own, plan.settings.clone(), state);
    let SteadyOptions { by, tolerance, most, cycles } = plan.steady;
    if by == SteadyBy::Shooting {
        shoot(&mut motion, 1, tolerance, SHOTS)?;
    }
    let periodicity = run_to_steady(&mut motion, tolerance, most, |_, _| ())?;
    let mut point = SweepPoint {
        speed,
        way,
        periodicity,
        waited: motion.cycle(),
        transmission_error: Vec::new(),
        normal_force: Vec::new(),
        coast_force: 0.0,
        bearing_force: 0.0,
    };
    let mut row = |now: &super::Instant, _: &crate::motion::Ledger| {
        point.transmission_error.push(now.transmission_error);
        point.normal_force.push(now.normal_forces[0]);
        point.coast_force = point.coast_force.max(now.normal_forces[1]);
        for at in [0, super::COORDINATES] {
            point.bearing_force = point.bearing_force.max(now.bearing.fixed_rows::<3>(at).norm());
        }
    };
    for _ in 0..cycles {
        motion.run_cycle(Some(&mut row))?;
    }
    let end = motion.state().clone();
    Ok((point, end))
}

/// Newton steps of shooting before waiting takes over.
pub const SHOTS: usize = 12;
