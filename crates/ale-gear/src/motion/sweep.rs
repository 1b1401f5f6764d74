//! Sweeps: `resonance.csv` and what is said of it.

use std::ops::ControlFlow;

use dynamics::{self, PairMotionError, SteadyOptions, SweepDirection, SweepMiss, SweepOutcome, SweepPlan, SweepPoint};
use ltca::StaticError;
use serde::Serialize;
use study::{StudyError, cycle_statistics, mesh_harmonics};

use analysis::motion::CriticalSpeed;

use super::{
    MOTION_WAY_OUT, RPM,
    certificate::checks_of_speed,
    course::failure,
    elasticity::{ElasticHeadline, Vibration},
    inertia::InertiaHeadline,
    prepare::{Prepared, QuasiStatic},
    steady_by,
};
use crate::{
    error::CommandError,
    output::{push_row, quoted},
    phases::Phases,
    run::Failure,
    scene::{MotionScene, Scene, SweepScene, SweepWay},
};

/// Mesh harmonics of a speed that are listed.
const ORDERS: usize = 4;

/// How a speed of a sweep came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SweepStatus {
    /// The motion repeats itself.
    Periodic,
    /// It does not, in the cycles that it was given.
    NotPeriodic,
    /// There is no motion at all.
    Failed,
}

impl SweepStatus {
    /// As it stands in the file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Periodic => "periodic",
            Self::NotPeriodic => "not-periodic",
            Self::Failed => "failed",
        }
    }
}

/// One speed of a sweep; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub(crate) struct SweepRow {
    pub way: SweepWay,
    pub speed_rpm: f64,
    pub mesh_frequency_hz: f64,
    pub mean_dte_um: f64,
    pub peak_to_peak_dte_um: f64,
    pub dte_harmonics_um: Vec<f64>,
    pub min_normal_force_n: f64,
    pub max_normal_force_n: f64,
    pub dynamic_factor: f64,
    pub max_coast_normal_force_n: f64,
    pub max_bearing_force_n: f64,
    pub period_cycles: usize,
    pub periodicity: f64,
    pub warm_up_cycles: u64,
    /// Whether it began in its own quasi-static equilibrium.
    pub own_start: bool,
    pub status: SweepStatus,
    /// Why there is no motion; empty where there is one.
    pub reason: String,
}

/// A speed without a motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // as above
pub(crate) struct FailedSpeed {
    pub way: SweepWay,
    pub speed_rpm: f64,
    pub reason: String,
}

/// The few numbers that a sweep is made for.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // as above
pub(crate) struct SweepHeadline {
    pub run: crate::scene::Run,
    pub mesh_resonance_hz: f64,
    pub mesh_resonance_rpm: f64,
    pub inertia: InertiaHeadline,
    pub elasticity: ElasticHeadline,
    pub mean_ste_um: f64,
    pub peak_to_peak_ste_um: f64,
    pub mean_mesh_stiffness_n_per_um: f64,
    pub mean_static_normal_force_n: f64,
    pub largest: Vec<SweepRow>,
    pub not_periodic_rpm: Vec<f64>,
    pub failed: Vec<FailedSpeed>,
    pub critical_speeds: Vec<CriticalSpeed>,
}

/// The error of teeth missing beside the window, which a wider one may cure.
fn starved(error: &PairMotionError) -> Option<&StaticError> {
    error.contact_error().filter(|source| source.is_starved())
}

/// Runs the sweep of a scene. `wider`: whether a wider window may cure an error.
///
/// # Errors
/// [`Failure::Static`] where another window may do; else that of the first speed where none has an answer.
pub(super) fn run(
    scene: &Scene,
    words: (&MotionScene, &SweepScene),
    prepared: &Prepared,
    wider: &(dyn Fn(&StaticError) -> bool + Sync),
    phases: &mut Phases,
) -> Result<Vec<SweepOutcome>, Failure> {
    let (motion, sweep) = words;
    let speeds: Vec<f64> = sweep.all_rpm().iter().map(|n| n * RPM).collect();
    let ways = sweep.ways.iter().map(|w| match w {
        SweepWay::Apart => SweepDirection::Independent,
        SweepWay::Up => SweepDirection::Up,
        SweepWay::Down => SweepDirection::Down,
    });
    let plan = SweepPlan {
        ways: ways.collect(),
        settings: prepared.settings.clone(),
        steady: SteadyOptions {
            by: steady_by(sweep.steady_by),
            tolerance: motion.periodic_tolerance.unwrap_or(1e-6),
            most: u64::from(motion.warm_up_cycles.unwrap_or(1000)),
            cycles: u64::from(scene.analysis.cycles),
        },
        guess: prepared.quasi_static.transmission_error.first().copied().unwrap_or(0.0),
        speeds,
    };
    let steps = (plan.speeds.len() * plan.ways.len()) as u64;
    let curable = |error: &PairMotionError| starved(error).is_some_and(wider);
    let outcomes = phases
        .run_steps("sweep", steps, |progress| {
            dynamics::sweep(&prepared.system, &plan, &|outcome: &SweepOutcome| {
                progress.tick();
                match outcome {
                    Ok(point) => progress.say(format!("{:.0}/min", point.speed / RPM)),
                    Err(miss) => progress.say(format!("{:.0}/min: {}", miss.speed / RPM, miss.error)),
                }
                match outcome {
                    Err(miss) if curable(&miss.error) => ControlFlow::Break(()),
                    _ => ControlFlow::Continue(()),
                }
            })
        })
        .map_err(|e| failure(scene, e))?;
    let mut misses = outcomes.iter().filter_map(|o| o.as_ref().err());
    if let Some(miss) = misses.clone().find(|m| curable(&m.error)) {
        return Err(failure(scene, miss.error.clone()));
    }
    match misses.next() {
        Some(first) if outcomes.iter().all(Result::is_err) => Err(failure(scene, first.error.clone())),
        _ => Ok(outcomes),
    }
}

fn way_of(way: SweepDirection) -> SweepWay {
    match way {
        SweepDirection::Independent => SweepWay::Apart,
        SweepDirection::Up => SweepWay::Up,
        SweepDirection::Down => SweepWay::Down,
    }
}

/// Rows of `resonance.csv`: a speed without a motion has its reason.
pub(super) fn rows(
    scene: &Scene,
    motion: &MotionScene,
    quasi_static: &QuasiStatic,
    outcomes: &[SweepOutcome],
) -> Vec<SweepRow> {
    let tolerance = motion.periodic_tolerance.unwrap_or(1e-6);
    let teeth = f64::from(scene.driver_teeth());
    let cycles = scene.analysis.cycles as usize;
    let one = |outcome: &SweepOutcome| match outcome {
        Ok(point) => match checks_of_speed(point).missed().next() {
            Some(check) => {
                let reason = format!("the result does not hold: {}", check.words());
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
        dte_harmonics_um: mesh_harmonics(&dte, cycles, ORDERS)?.iter().map(|h| h.amplitude).collect(),
        min_normal_force_n: extreme(f64::min, f64::INFINITY),
        max_normal_force_n: extreme(f64::max, 0.0),
        dynamic_factor: extreme(f64::max, point.coast_force) / quasi_static.normal_force,
        max_coast_normal_force_n: point.coast_force,
        max_bearing_force_n: point.bearing_force,
        period_cycles: point.periodicity.period,
        periodicity: point.periodicity.residual,
        warm_up_cycles: point.waited,
        own_start: point.own_start,
        status: if point.periodicity.residual > tolerance { SweepStatus::NotPeriodic } else { SweepStatus::Periodic },
        reason: String::new(),
    })
}

/// Status 1 where not one speed has a motion that holds.
///
/// # Errors
/// Exit status 1 with the reason of the first.
pub(super) fn verdict(scene: &Scene, rows: &[SweepRow]) -> Result<(), CommandError> {
    let failed = |row: &SweepRow| row.status == SweepStatus::Failed;
    match rows.first() {
        Some(first) if rows.iter().all(failed) => {
            let place = scene.file.display();
            let message = format!("{place}: no speed has a result, at {:.0}/min: {}", first.speed_rpm, first.reason);
            Err(CommandError::failed(message, Some(MOTION_WAY_OUT.into())))
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
        dte_harmonics_um: vec![none; ORDERS],
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

/// `resonance.csv`.
pub(super) fn write(rows: &[SweepRow]) -> String {
    let harmonics: Vec<String> = (1..=ORDERS).map(|h| format!("dte_harmonic_{h}_um")).collect();
    let mut csv = format!(
        "way,speed_rpm,mesh_frequency_hz,mean_dte_um,peak_to_peak_dte_um,{},min_normal_force_n,max_normal_force_n,\
         dynamic_factor,max_coast_normal_force_n,max_bearing_force_n,period_cycles,periodicity,warm_up_cycles,start,status,reason\n",
        harmonics.join(",")
    );
    for row in rows {
        csv.push_str(match row.way {
            SweepWay::Apart => "apart,",
            SweepWay::Up => "up,",
            SweepWay::Down => "down,",
        });
        let lines = (0..ORDERS).map(|h| row.dte_harmonics_um.get(h).copied().unwrap_or(f64::NAN));
        let first = [row.speed_rpm, row.mesh_frequency_hz, row.mean_dte_um, row.peak_to_peak_dte_um];
        let last = [
            row.min_normal_force_n,
            row.max_normal_force_n,
            row.dynamic_factor,
            row.max_coast_normal_force_n,
            row.max_bearing_force_n,
            row.period_cycles as f64,
            row.periodicity,
            row.warm_up_cycles as f64,
        ];
        push_row(&mut csv, first.into_iter().chain(lines).chain(last));
        csv.pop();
        let start = if row.own_start { "quasi-static" } else { "neighbour" };
        csv.push_str(&format!(",{start},{},{}\n", row.status.word(), quoted(&row.reason)));
    }
    csv
}

/// What a sweep is made for: the largest answer of each way, and where no periodic state was found.
pub(super) fn headline(
    words: (&MotionScene, &SweepScene),
    prepared: &Prepared,
    (rows, vibration): (&[SweepRow], &Vibration),
    critical_speeds: Vec<CriticalSpeed>,
    teeth: u32,
) -> SweepHeadline {
    let (motion, sweep) = words;
    let has_motion = |r: &&SweepRow| r.status != SweepStatus::Failed;
    let largest = sweep.ways.iter().filter_map(|way| {
        let of_way = rows.iter().filter(|r| r.way == *way).filter(has_motion);
        of_way.max_by(|a, b| a.peak_to_peak_dte_um.total_cmp(&b.peak_to_peak_dte_um)).cloned()
    });
    let ste = prepared.quasi_static.transmission_error.iter().map(|e| 1e3 * e);
    let [low, high] = ste.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], e| [l.min(e), h.max(e)]);
    let resonance = prepared.system.mesh_resonance_hz();
    let of_status = |status: SweepStatus| rows.iter().filter(move |r| r.status == status);
    SweepHeadline {
        run: motion.run,
        mesh_resonance_hz: resonance,
        mesh_resonance_rpm: 60.0 * resonance / f64::from(teeth),
        inertia: InertiaHeadline::of(&prepared.system),
        elasticity: prepared.elasticity.headline(vibration),
        mean_ste_um: 1e3 * prepared.quasi_static.mean_error(),
        peak_to_peak_ste_um: high - low,
        mean_mesh_stiffness_n_per_um: 1e-3 * prepared.quasi_static.stiffness,
        mean_static_normal_force_n: prepared.quasi_static.normal_force,
        largest: largest.collect(),
        not_periodic_rpm: of_status(SweepStatus::NotPeriodic).map(|r| r.speed_rpm).collect(),
        failed: of_status(SweepStatus::Failed)
            .map(|r| FailedSpeed { way: r.way, speed_rpm: r.speed_rpm, reason: r.reason.clone() })
            .collect(),
        critical_speeds,
    }
}

/// The largest peak to peak of all speeds, um.
pub(super) fn largest(rows: &[SweepRow]) -> f64 {
    rows.iter().map(|r| r.peak_to_peak_dte_um).filter(|x| x.is_finite()).fold(0.0, f64::max)
}
