//! What a user should hear of a motion.

use answer::Remark;
use dynamics::Drive;
use gearbox::motion::{PairModel, stable_step};
use geometry::GearPair;
use ltca::StaticError;
use scene::{Flanks, MotionScene, Run, Scene};

use super::{
    MotionHeadline, SweepHeadline,
    course::failure,
    setup::{PreparedMotion, mesh_range_hz, refuse_unstable},
    step_estimate::{Pace, StepDemand, fastest_hz},
};
use crate::{failure::Failure, remark, unstable_steps::Steps};

/// More steps than this in a mesh cycle take half a minute or more.
const SLOW: f64 = 20_000.0;
/// More steps than this of a motion with modes take minutes: those who wait should know.
const LONG: f64 = 100_000.0;
/// Backlash below which there is none, um.
pub const NO_BACKLASH_UM: f64 = 1e-3;
/// Fewer steps than this in a period of the mesh resonance show it wrongly: peak to peak off by 10 to 60 % near it (map (c)
/// of `docs/envelope.md`).
const COARSE: f64 = 12.0;

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
    if given { coarse_steps(steps, (what, fastest), or) } else { None }
}

/// Steps that are too long for a motion of this name and frequency, Hz; `steps`: in a period of it.
pub(crate) fn coarse_steps(steps: f64, (what, hz): (&str, f64), or: &str) -> Option<Remark> {
    (steps < COARSE).then(|| remark::coarse_steps(steps, what, hz, or))
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
    let limit = stable_step(system, times.scheme).map_err(|e| failure(scene, e.into()))?;
    let Some(limit) = limit else { return Ok(()) };
    let longest = longest_cycle(scene, system);
    let step = times.step(longest);
    let steps = Steps { step, mesh_hz: 1.0 / longest, resonance_hz: fastest_hz(system) };
    Ok(refuse_unstable(scene, &limit, &steps)?)
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
    let last = system.cycles_until(ramp.before_s + ramp.duration_s + ramp.after_s).floor().max(1.0);
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

/// A pair without backlash in a motion in which flanks may part.
pub(crate) fn no_backlash(scene: &Scene, pair: &GearPair) -> Option<Remark> {
    let backlash_um = 1e3 * pair.backlash();
    (backlash_um.abs() < NO_BACKLASH_UM).then(|| {
        let what = match scene.contact.flanks {
            Flanks::Both => "where the driving flanks lose contact the coast flanks press at once, and there is no loss of contact as with a clearance",
            Flanks::Driving => "with `flanks = \"driving\"` teeth that part fly as if there were room behind them",
        };
        remark::no_backlash(what)
    })
}

/// What the certificate says that a user should hear.
pub(super) fn of_motion(motion: &MotionScene, prepared: &PreparedMotion, headline: &MotionHeadline) -> Vec<Remark> {
    let mut said = Vec::new();
    let c = &headline.certificate;
    let settles = matches!(motion.run, Run::Steady | Run::Shooting);
    if let (true, Some(found), Some(asked)) = (settles, c.periodicity, motion.periodic_tolerance)
        && found > asked
    {
        let early = c.warm_up_cycles < u64::from(motion.warm_up_cycles.unwrap_or(1000)) && motion.run == Run::Steady;
        let after = c.warm_up_cycles;
        said.push(if early {
            remark::repeats_and_drifts(asked, after, found)
        } else {
            remark::not_periodic(after, found, asked, "it may be chaotic, or need more `warm_up_cycles`")
        });
    } else if let (true, Some(period)) = (settles, c.period_cycles.filter(|p| *p > 1)) {
        said.push(remark::subharmonic(period));
    }
    if c.ledger_residual_over_work.abs() > 1e-6 {
        said.push(remark::work_open(c.ledger_residual_over_work.abs()));
    }
    // Without coast flanks nothing stops teeth that have parted.
    let pair = prepared.system.pair();
    let backlash = 1e3 * pair.backlash() * pair.base_helix_angle().cos();
    if !prepared.system.has_coast_flanks() && c.largest_gap_um > backlash {
        said.push(remark::gap_beyond_backlash(c.largest_gap_um, backlash));
    }
    if c.flank_coupling_bound_um > COUPLED * headline.peak_to_peak_dte_um {
        said.push(remark::both_flanks_press(c.rows_on_both_flanks, c.flank_coupling_bound_um));
    }
    if let Drive::Torque { start, .. } = &prepared.system.options().drive {
        let asked = start * 30.0 / std::f64::consts::PI;
        if (headline.speed_rpm / asked - 1.0).abs() > 0.01 {
            said.push(remark::speed_has_changed(headline.speed_rpm, asked));
        }
    }
    said
}

/// Error of the coupling of both flanks over the peak to peak that a user should hear of.
const COUPLED: f64 = 0.01;

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
    format!("1/min: {}", first.join(", "))
}
