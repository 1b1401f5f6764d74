//! Remarks about a motion for the user.

use answer::Remark;
use dynamics::Drive;
use gearbox::motion::PairModel;
use integrate::Periodicity;
use ltca::StaticError;
use scene::{Flanks, MotionScene, Run, Scene};

use super::{
    MotionHeadline, SweepHeadline,
    course::{failure, ramp_cycles},
    setup::{PreparedMotion, mesh_range_hz, refuse_unstable},
    step_estimate::{Pace, StepDemand, fastest_hz},
};
use crate::{
    AnalysisError,
    error::place_in,
    failure::Failure,
    in_motion::{Parting, Settled, StepKeys, coarse_steps, energy_remark, no_backlash, speed_changed, work_open},
    refused::Refusal,
    remark,
    unstable_steps::Steps,
};

/// More steps than this in a mesh cycle take half a minute or more.
const SLOW: f64 = 20_000.0;
/// More steps than this of a motion with modes take minutes: those who wait should know.
const LONG: f64 = 100_000.0;
/// More steps than this in one mesh cycle of a ramp take an hour, and say nothing on the way.
const ENDLESS: f64 = 5e6;

/// A window that was too narrow.
pub(super) fn widened(error: &StaticError, teeth: usize) -> Remark {
    remark::window_widened_in_motion(error.to_string(), teeth)
}

/// Steps that are too long for the mesh resonance, or for the highest mode that is kept.
pub(super) fn coarse(scene: &Scene, motion: &MotionScene, prepared: &PreparedMotion) -> Option<Remark> {
    let fastest = fastest_hz(&prepared.system);
    let mesh = scene.pinion_speed() / std::f64::consts::TAU * f64::from(scene.pinion.teeth);
    let steps = f64::from(motion.steps_per_resonance).max(f64::from(motion.steps_per_mesh_cycle) * mesh / fastest);
    let given = motion.error_tolerance.is_none() && motion.ramp.is_none() && motion.sweep.is_none();
    let (what, or) = match fastest > prepared.system.mesh_resonance_hz() {
        true => ("highest kept mode", ", or keep fewer modes"),
        false => ("mesh resonance", ""),
    };
    if given { coarse_steps(steps, (what, fastest), (StepKeys::PAIR, or)) } else { None }
}

/// Refuses a ramp so slow that one of its mesh cycles never ends.
///
/// # Errors
/// [`crate::AnalysisError::Refused`] with the number of steps.
pub(super) fn endless(scene: &Scene, prepared: &PreparedMotion) -> Result<(), Failure> {
    let longest = longest_cycle(scene, &prepared.system);
    let steps = longest / prepared.times.step(longest);
    if prepared.times.tolerance.is_some() || scene.motion.as_ref().is_none_or(|m| m.ramp.is_none()) || steps <= ENDLESS
    {
        return Ok(());
    }
    let what = format!("a mesh cycle of the ramp lasts {longest:.3e} s, which are {steps:.1e} steps");
    let hint = format!("{ENDLESS:.0e} are the most: let it begin and end faster, or take an `error_tolerance`");
    let refusal = Refusal::no_result(what, Some(hint));
    Err(AnalysisError::from(refusal).at(place_in(scene, &["motion.ramp"])).into())
}

/// Refuses steps of given length that are too long for an explicit method.
///
/// # Errors
/// [`crate::AnalysisError::Refused`] with the limit, the step, and the number of steps that would do.
pub(super) fn unstable(scene: &Scene, prepared: &PreparedMotion) -> Result<(), Failure> {
    let PreparedMotion { system, times, .. } = prepared;
    if times.tolerance.is_some() || !times.scheme.is_explicit() {
        return Ok(());
    }
    let limit = system.machine().and_then(|mut machine| machine.stable_step(times.scheme));
    let limit = limit.map_err(|e| failure(scene, e.into()))?;
    let Some(limit) = limit else { return Ok(()) };
    let longest = longest_cycle(scene, system);
    let step = times.step(longest);
    let steps = Steps::of_pair(step, 1.0 / longest, fastest_hz(system));
    Ok(refuse_unstable(scene, limit, steps)?)
}

/// Duration of the longest mesh cycle of a run, s: the slowest one.
fn longest_cycle(scene: &Scene, system: &PairModel) -> f64 {
    let motion = scene.motion.as_ref();
    let slowest = motion.and_then(|m| m.sweep.as_ref()).map(|s| s.from_rpm.min(s.to_rpm));
    let speed_rpm = slowest.unwrap_or(scene.operation.speed_rpm);
    let teeth = [scene.pinion.teeth, scene.wheel.teeth][1 - system.options().statics.driven()];
    let steady = 60.0 / (speed_rpm * f64::from(teeth));
    let Some(ramp) = motion.and_then(|m| m.ramp) else { return steady };
    // The first cycle of a run-up, the last one of a run-down.
    let last = ramp_cycles(ramp, system) as f64;
    let times = [0.0, 1.0, last - 1.0, last].map(|c| system.time_of_cycles(c).unwrap_or(f64::NAN));
    (times[1] - times[0]).max(times[3] - times[2])
}

/// Steps of a mesh cycle so many that a user should know why nothing seems to go on.
pub(super) fn slow(scene: &Scene, motion: &MotionScene, prepared: &PreparedMotion) -> Option<Remark> {
    let mesh = scene.pinion_speed() / std::f64::consts::TAU * f64::from(scene.pinion.teeth);
    let fastest = fastest_hz(&prepared.system);
    let steps = f64::from(motion.steps_per_resonance) * fastest / mesh;
    let given = motion.ramp.is_none() && motion.sweep.is_none();
    (given && steps > SLOW).then(|| remark::slow_pair(fastest / mesh, fastest, steps))
}

/// How many steps a motion with normal modes is going to take, if they are many: the highest mode says how long they
/// are, the lowest how long it takes to settle.
pub(super) fn long(scene: &Scene, motion: &MotionScene, prepared: &PreparedMotion) -> Option<Remark> {
    scene.modes?;
    let mesh_hz = mesh_range_hz(scene, motion, None);
    let cycles = match motion.ramp {
        Some(ramp) => (ramp.before_s + ramp.duration_s + ramp.after_s) * 0.5 * (mesh_hz[0] + mesh_hz[1]),
        None => motion.duration_s.map_or(f64::from(scene.analysis.cycles), |t| t * mesh_hz[1]),
    };
    let estimate = StepDemand::new(scene, motion, cycles, mesh_hz).as_it_is(&prepared.system);
    (estimate.steps() > LONG)
        .then(|| remark::many_steps(estimate.describe(Pace { step_s: None }), fastest_hz(&prepared.system)))
}

/// What stops driving flanks of a pair that part.
pub(crate) fn parting(scene: &Scene) -> Parting {
    match scene.contact.flanks {
        Flanks::Both => Parting::CoastFlanks,
        Flanks::Driving => Parting::Nothing,
    }
}

/// A pair without backlash.
pub(super) fn without_backlash(scene: &Scene, prepared: &PreparedMotion) -> Option<Remark> {
    no_backlash(prepared.system.pair(), parting(scene))
}

/// What the certificate says that a user should hear.
pub(super) fn of_motion(
    (scene, motion): (&Scene, &MotionScene),
    prepared: &PreparedMotion,
    headline: &MotionHeadline,
) -> Vec<Remark> {
    let c = &headline.certificate;
    let found = c.period_cycles.zip(c.periodicity).map(|(period, residual)| Periodicity { period, residual });
    let settled = found.filter(|_| matches!(motion.run, Run::Steady | Run::Shooting)).map(|found| Settled {
        tolerance: motion.periodic_tolerance.unwrap_or(f64::INFINITY),
        found,
        waited: c.warm_up_cycles,
        most: if motion.run == Run::Steady { u64::from(motion.warm_up_cycles.unwrap_or(1000)) } else { 0 },
        common: c.common_period_cycles.map_or(usize::MAX, |period| period as usize),
        why: "it may be chaotic, or need more `warm_up_cycles`",
    });
    let system = &prepared.system;
    let speed = match &system.options().drive {
        Drive::Torque { start, .. } => speed_changed(headline.speed_rpm, start * 30.0 / std::f64::consts::PI),
        Drive::Speed(_) | Drive::Balanced(_) => None,
    };
    let mesh = headline.mesh((scene, system.pair()), system.has_coast_flanks());
    let own = settled.and_then(Settled::remark).into_iter().chain(work_open(c.ledger_residual_over_work));
    let energy = energy_remark(c.energy_open_over_vibration, StepKeys::PAIR.by(motion.error_tolerance));
    own.chain(energy).chain(mesh.remarks()).chain(speed).collect()
}

/// Speeds that have no answer that repeats itself, or none at all; `speeds`: how many there are in all.
pub(super) fn of_sweep(headline: &SweepHeadline, speeds: usize) -> Vec<Remark> {
    let mut said = Vec::new();
    let (missed, failed) = (&headline.not_periodic_rpm, &headline.failed);
    if !missed.is_empty() {
        said.push(remark::speeds_not_periodic(missed.len(), speeds, listed(missed.iter().copied())));
    }
    if let Some(first) = failed.first() {
        said.push(remark::speeds_unsolved(
            failed.len(),
            speeds,
            listed(failed.iter().map(|f| f.speed_rpm)),
            &*first.reason,
        ));
    }
    said
}

/// A few speeds as text.
fn listed(speeds_rpm: impl Iterator<Item = f64>) -> String {
    let first: Vec<String> = speeds_rpm.take(8).map(|n| format!("{n:.0}")).collect();
    format!("rpm: {}", first.join(", "))
}
