//! A sweep over speed: steady states, each started separately or from the preceding one.

use std::ops::ControlFlow;

use gearbox::{
    GearboxError,
    motion::{SteadyOptions, SweepOutcome, SweepPlan, SweepPoint, sweep as swept},
};
use integrate::SweepDirection;
use ltca::StaticError;
use scene::{MotionScene, Scene, SweepScene, SweepWay};

use crate::{
    Observer, PhaseWork,
    failure::Failure,
    motion::{
        course::failure,
        dropped::dropped_by,
        setup::{PreparedMotion, RPM, steady_by},
    },
    run_phase, unless_cancelled,
};

/// Order in which a way of a scene goes through values.
pub(crate) fn direction(way: SweepWay) -> SweepDirection {
    match way {
        SweepWay::Apart => SweepDirection::Independent,
        SweepWay::Up => SweepDirection::Up,
        SweepWay::Down => SweepDirection::Down,
    }
}

/// The error of teeth missing beside the window, which a wider one may cure.
fn starved(error: &GearboxError) -> Option<&StaticError> {
    error.contact_error().filter(|source| source.is_starved())
}

/// Runs the sweep of a scene. `wider`: whether a wider window may cure an error.
///
/// # Errors
/// [`Failure::Static`] where another window may do; else that of the first speed where none has an answer.
pub(super) fn run(
    scene: &Scene,
    (motion, sweep): (&MotionScene, &SweepScene),
    prepared: &PreparedMotion,
    wider: &(dyn Fn(&StaticError) -> bool + Sync),
    observer: &mut dyn Observer,
) -> Result<Vec<SweepOutcome>, Failure> {
    let speeds: Vec<f64> = sweep.all_rpm().iter().map(|n| n * RPM).collect();
    let ways = sweep.ways.iter().map(|way| direction(*way));
    let plan = SweepPlan {
        ways: ways.collect(),
        times: prepared.times.clone(),
        steady: SteadyOptions {
            by: steady_by(sweep.steady_by),
            tolerance: motion.periodic_tolerance.unwrap_or(1e-6),
            most: u64::from(motion.warm_up_cycles.unwrap_or(1000)),
            cycles: u64::from(scene.analysis.cycles),
        },
        speeds,
    };
    let steps = (plan.speeds.len() * plan.ways.len()) as u64;
    let curable = |error: &GearboxError| starved(error).is_some_and(wider);
    let dropped = |point: &SweepPoint| {
        let force = point.extremes.largest_force.max(point.coast_force);
        dropped_by(&prepared.system, point.changes.jump, force).filter(wider)
    };
    let (outcomes, cancelled) = run_phase(observer, "sweep", PhaseWork::Steps(steps), |progress| {
        let outcomes = swept(&prepared.system, &plan, &|outcome: &SweepOutcome| {
            progress.tick();
            match outcome {
                Ok(point) => progress.say(format!("{:.0} rpm", point.speed / RPM)),
                Err(miss) => progress.say(format!("{:.0} rpm: {}", miss.speed / RPM, miss.error)),
            }
            match outcome {
                _ if progress.is_cancelled() => ControlFlow::Break(()),
                Err(miss) if curable(&miss.error) => ControlFlow::Break(()),
                Ok(point) if dropped(point).is_some() => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        });
        (outcomes, unless_cancelled(progress))
    });
    cancelled?;
    let outcomes = outcomes.map_err(|e| failure(scene, e.into()))?;
    if let Some(error) = outcomes.iter().filter_map(|o| o.as_ref().ok()).find_map(dropped) {
        return Err(Failure::Static(error));
    }
    let mut misses = outcomes.iter().filter_map(|o| o.as_ref().err());
    if let Some(miss) = misses.clone().find(|m| curable(&m.error)) {
        return Err(failure(scene, miss.error.clone().into()));
    }
    match misses.next() {
        Some(first) if outcomes.iter().all(Result::is_err) => Err(failure(scene, first.error.clone().into())),
        _ => Ok(outcomes),
    }
}
