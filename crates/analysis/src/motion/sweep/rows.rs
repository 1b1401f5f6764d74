//! One row per speed and direction of a sweep.

use gearbox::motion::{SweepMiss, SweepOutcome, SweepPoint};
use geometry::GearPair;
use integrate::SweepDirection;
use scene::{MotionScene, Scene, SweepWay};
use serde::Serialize;
use study::{StudyError, cycle_statistics, mesh_harmonics};

use crate::{
    AnalysisError,
    error::in_scene,
    in_motion::StepKeys,
    motion::{
        certificate::checks_of_speed,
        setup::{QuasiStatic, RPM},
    },
    refused::Refusal,
};

/// Number of mesh harmonics listed per speed.
pub const SWEEP_ORDERS: usize = 4;

/// Outcome of a value of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepStatus {
    /// The motion is periodic.
    Solved,
    /// The motion is not periodic within the permitted cycles.
    NotPeriodic,
    /// There is no motion.
    Failed,
}

impl SweepStatus {
    /// Of a motion that repeats itself up to `periodicity`, wanted up to `tolerance`; `None` where that is unknown.
    pub(crate) fn of(periodicity: Option<f64>, tolerance: f64) -> Self {
        if periodicity.is_some_and(|residual| residual > tolerance) { Self::NotPeriodic } else { Self::Solved }
    }

    /// Word for the column `status`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::NotPeriodic => "not-periodic",
            Self::Failed => "failed",
        }
    }
}

described::described! {
    /// One speed of a sweep; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct SweepRow {
        /// `up`, `down` (from the motion of the speed before) or `apart` (from rest under the load)
        pub way: SweepWay,
        /// speed of the driver
        pub speed_rpm: f64,
        /// mesh frequency
        pub mesh_frequency_hz: f64,
        /// mean dynamic transmission error
        pub mean_dte_um: f64,
        /// peak to peak of the dynamic transmission error
        pub peak_to_peak_dte_um: f64,
        /// amplitudes of the mesh harmonics of the dynamic transmission error
        pub dte_harmonics_um: Vec<f64>,
        /// smallest sum of the normal forces on the driving flanks
        pub min_normal_force_n: f64,
        /// largest sum of the normal forces on the driving flanks
        pub max_normal_force_n: f64,
        /// largest sum of normal forces on driving or coast flanks over the mean quasi-static one
        pub dynamic_factor: f64,
        /// largest sum of the normal forces on the coast flanks
        pub max_coast_normal_force_n: f64,
        /// largest force of a bearing
        pub max_bearing_force_n: f64,
        /// mesh cycles after which the motion repeats itself best
        pub period_cycles: usize,
        /// largest difference of a coordinate or velocity after that period, over its peak to peak
        pub periodicity: f64,
        /// mesh cycles before the first row
        pub warm_up_cycles: u64,
        /// whether the motion began in its own quasi-static equilibrium
        pub own_start: bool,
        /// `solved`, `not-periodic` or `failed`
        pub status: SweepStatus,
        /// reason why there is no motion; empty where there is one
        pub reason: String,
    }
}

fn way_of(way: SweepDirection) -> SweepWay {
    match way {
        SweepDirection::Independent => SweepWay::Apart,
        SweepDirection::Up => SweepWay::Up,
        SweepDirection::Down => SweepWay::Down,
    }
}

/// A row a way and speed: a speed without a motion has its reason.
pub(super) fn rows(
    (scene, pair): (&Scene, &GearPair),
    motion: &MotionScene,
    quasi_static: &QuasiStatic,
    outcomes: &[SweepOutcome],
) -> Vec<SweepRow> {
    let tolerance = motion.periodic_tolerance.unwrap_or(1e-6);
    let teeth = f64::from(scene.driver_teeth());
    let cycles = scene.analysis.cycles as usize;
    let one = |outcome: &SweepOutcome| match outcome {
        Ok(point) => match checks_of_speed((scene, pair), point).missed().next() {
            Some(check) => {
                let reason = format!("check failed: {}", check.words());
                missing((point.way, point.speed), teeth, reason)
            }
            None => solved(point, cycles, (teeth, tolerance), quasi_static)
                .unwrap_or_else(|e| missing((point.way, point.speed), teeth, e.to_string())),
        },
        Err(SweepMiss { speed, way, error }) => missing((*way, *speed), teeth, error.to_string()),
    };
    outcomes.iter().map(one).collect()
}

/// # Errors
/// [`StudyError`] when a transmission error is no number.
fn solved(
    point: &SweepPoint,
    cycles: usize,
    (teeth, tolerance): (f64, f64),
    quasi_static: &QuasiStatic,
) -> Result<SweepRow, StudyError> {
    let dte: Vec<f64> = point.transmission_error.iter().map(|e| 1e3 * e).collect();
    let of_dte = cycle_statistics(&dte, cycles)?;
    let extreme = |f: fn(f64, f64) -> f64, start| point.normal_force.iter().copied().fold(start, f);
    let speed_rpm = point.speed / RPM;
    Ok(SweepRow {
        way: way_of(point.way),
        speed_rpm,
        mesh_frequency_hz: speed_rpm * teeth / 60.0,
        mean_dte_um: of_dte.mean,
        peak_to_peak_dte_um: of_dte.peak_to_peak,
        dte_harmonics_um: mesh_harmonics(&dte, cycles, SWEEP_ORDERS)?.iter().map(|h| h.amplitude).collect(),
        min_normal_force_n: extreme(f64::min, f64::INFINITY),
        max_normal_force_n: extreme(f64::max, 0.0),
        dynamic_factor: extreme(f64::max, point.coast_force) / quasi_static.normal_force,
        max_coast_normal_force_n: point.coast_force,
        max_bearing_force_n: point.bearing_force,
        period_cycles: point.periodicity.period,
        periodicity: point.periodicity.residual,
        warm_up_cycles: point.waited,
        own_start: point.own_start,
        status: SweepStatus::of(Some(point.periodicity.residual), tolerance),
        reason: String::new(),
    })
}

/// Whether there is a speed with a motion that holds.
///
/// # Errors
/// [`AnalysisError::Refused`] with the reason of the first.
pub(super) fn verdict(scene: &Scene, rows: &[SweepRow]) -> Result<(), AnalysisError> {
    let failed = |row: &SweepRow| row.status == SweepStatus::Failed;
    match rows.first() {
        Some(first) if rows.iter().all(failed) => {
            let what = format!("no speed has a result, at {:.0} rpm: {}", first.speed_rpm, first.reason);
            Err(in_scene(scene)(Refusal::no_result(what, Some(StepKeys::of_pair(scene).energy().to_owned()))))
        }
        _ => Ok(()),
    }
}

/// A speed without a motion.
fn missing((way, speed): (SweepDirection, f64), teeth: f64, reason: String) -> SweepRow {
    let (speed_rpm, none) = (speed / RPM, f64::NAN);
    SweepRow {
        way: way_of(way),
        speed_rpm,
        mesh_frequency_hz: speed_rpm * teeth / 60.0,
        mean_dte_um: none,
        peak_to_peak_dte_um: none,
        dte_harmonics_um: vec![none; SWEEP_ORDERS],
        min_normal_force_n: none,
        max_normal_force_n: none,
        dynamic_factor: none,
        max_coast_normal_force_n: none,
        max_bearing_force_n: none,
        period_cycles: 0,
        periodicity: none,
        warm_up_cycles: 0,
        own_start: true,
        status: SweepStatus::Failed,
        reason,
    }
}

/// The largest peak to peak of all speeds, um.
pub(super) fn largest(rows: &[SweepRow]) -> f64 {
    rows.iter().map(|r| r.peak_to_peak_dte_um).filter(|x| x.is_finite()).fold(0.0, f64::max)
}
