//! Sweeps: `resonance.csv` and what is said of it.

use dynamics::pair_motion::{self, SteadyOptions, SweepPlan, SweepPoint, Way};
use serde::Serialize;
use study::{StudyError, cycle_statistics, mesh_harmonics};

use super::{
    course::failure,
    elasticity::{ElasticHeadline, highest_mesh_hz},
    options::steady_by,
    prepare::{Prepared, QuasiStatic},
};
use crate::{
    output::push_row,
    phases::Phases,
    run::Failure,
    scene::{MotionScene, Scene, SweepScene, SweepWay},
};

/// Mesh harmonics of a speed that are listed.
const ORDERS: usize = 4;
const RPM: f64 = std::f64::consts::PI / 30.0;

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
}

/// The few numbers that a sweep is made for.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // as above
pub(crate) struct SweepHeadline {
    pub run: crate::scene::Run,
    pub mesh_resonance_hz: f64,
    pub mesh_resonance_rpm: f64,
    pub elasticity: ElasticHeadline,
    pub mean_ste_um: f64,
    pub peak_to_peak_ste_um: f64,
    pub mean_mesh_stiffness_n_per_um: f64,
    pub mean_static_normal_force_n: f64,
    pub largest: Vec<SweepRow>,
    pub not_periodic_rpm: Vec<f64>,
}

/// Runs the sweep of a scene.
///
/// # Errors
/// [`Failure::Static`] where another window may do.
pub(super) fn run(
    scene: &Scene,
    words: (&MotionScene, &SweepScene),
    prepared: &Prepared,
    phases: &mut Phases,
) -> Result<Vec<SweepPoint>, Failure> {
    let (motion, sweep) = words;
    let speeds: Vec<f64> = sweep.all_rpm().iter().map(|n| n * RPM).collect();
    let ways = sweep.ways.iter().map(|w| match w {
        SweepWay::Apart => Way::Apart,
        SweepWay::Up => Way::Up,
        SweepWay::Down => Way::Down,
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
    phases
        .run_steps("sweep", steps, |progress| {
            pair_motion::sweep(&prepared.system, &plan, &|point: &SweepPoint| {
                progress.tick();
                progress.say(format!("{:.0}/min", point.speed / RPM));
            })
        })
        .map_err(|e| failure(scene, e))
}

/// Rows of `resonance.csv`.
///
/// # Errors
/// [`StudyError`] when a transmission error is no number.
pub(super) fn rows(
    scene: &Scene,
    quasi_static: &QuasiStatic,
    points: &[SweepPoint],
) -> Result<Vec<SweepRow>, StudyError> {
    let cycles = scene.analysis.cycles as usize;
    let driver_teeth = scene.driver_teeth();
    let one = |point: &SweepPoint| {
        let dte: Vec<f64> = point.transmission_error.iter().map(|e| 1e3 * e).collect();
        let of_dte = cycle_statistics(&dte, cycles)?;
        let extreme = |f: fn(f64, f64) -> f64, start| point.normal_force.iter().copied().fold(start, f);
        let speed_rpm = point.speed / RPM;
        Ok(SweepRow {
            way: match point.way {
                Way::Apart => SweepWay::Apart,
                Way::Up => SweepWay::Up,
                Way::Down => SweepWay::Down,
            },
            speed_rpm,
            mesh_frequency_hz: speed_rpm * f64::from(driver_teeth) / 60.0,
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
        })
    };
    points.iter().map(one).collect()
}

/// `resonance.csv`.
pub(super) fn write(rows: &[SweepRow]) -> String {
    let harmonics: Vec<String> = (1..=ORDERS).map(|h| format!("dte_harmonic_{h}_um")).collect();
    let mut csv = format!(
        "way,speed_rpm,mesh_frequency_hz,mean_dte_um,peak_to_peak_dte_um,{},min_normal_force_n,max_normal_force_n,\
         dynamic_factor,max_coast_normal_force_n,max_bearing_force_n,period_cycles,periodicity,warm_up_cycles\n",
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
    }
    csv
}

/// What a sweep is made for: the largest answer of each way, and where no periodic state was found.
pub(super) fn headline(
    scene: &Scene,
    words: (&MotionScene, &SweepScene),
    prepared: &Prepared,
    rows: &[SweepRow],
    teeth: u32,
) -> SweepHeadline {
    let (motion, sweep) = words;
    let largest = sweep.ways.iter().filter_map(|way| {
        let of_way = rows.iter().filter(|r| r.way == *way);
        of_way.max_by(|a, b| a.peak_to_peak_dte_um.total_cmp(&b.peak_to_peak_dte_um)).cloned()
    });
    let tolerance = motion.periodic_tolerance.unwrap_or(1e-6);
    let ste = prepared.quasi_static.transmission_error.iter().map(|e| 1e3 * e);
    let [low, high] = ste.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], e| [l.min(e), h.max(e)]);
    let resonance = prepared.system.mesh_resonance_hz();
    SweepHeadline {
        run: motion.run,
        mesh_resonance_hz: resonance,
        mesh_resonance_rpm: 60.0 * resonance / f64::from(teeth),
        elasticity: prepared.elasticity.headline(highest_mesh_hz(scene, motion, None)),
        mean_ste_um: 1e3 * prepared.quasi_static.mean_error(),
        peak_to_peak_ste_um: high - low,
        mean_mesh_stiffness_n_per_um: 1e-3 * prepared.quasi_static.stiffness,
        mean_static_normal_force_n: prepared.quasi_static.normal_force,
        largest: largest.collect(),
        not_periodic_rpm: rows.iter().filter(|r| r.periodicity > tolerance).map(|r| r.speed_rpm).collect(),
    }
}
