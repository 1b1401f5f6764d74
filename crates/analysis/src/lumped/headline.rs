//! The few numbers that a run of a cheaper model is made for.

use std::f64::consts::TAU;

use scene::{MotionScene, Run, Scene};
use serde::Serialize;
use study::{Lyapunov, StudyError, cycle_statistics, extent, mean, mesh_harmonics, root_mean_square};

use super::{LumpedRow, run_loop::LumpedRun};
use crate::{motion::PassageHeadline, with_keys::with_keys};

/// Mesh harmonics that are listed.
const ORDERS: usize = 8;

with_keys! {
/// The few numbers that a run is made for; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub struct LumpedHeadline {
    pub run: Run,
    pub coordinates: usize,
    pub speed_rpm: f64,
    pub mesh_frequency_hz: f64,
    pub mesh_resonance_hz: Option<f64>,
    pub rows_per_cycle: u32,
    pub steps_per_row: u32,
    pub cycles: u64,
    pub judged_cycles: u64,
    pub mean_dte_um: f64,
    pub rms_dte_um: f64,
    pub peak_to_peak_dte_um: f64,
    pub min_dte_um: f64,
    pub max_dte_um: f64,
    pub dte_harmonics_um: Vec<f64>,
    pub mean_ste_um: Option<f64>,
    pub peak_to_peak_ste_um: Option<f64>,
    pub mean_mesh_stiffness_n_per_um: Option<f64>,
    pub mean_contact_line_length_mm: Option<f64>,
    pub static_normal_force_n: f64,
    pub mean_normal_force_n: f64,
    pub min_normal_force_n: f64,
    pub max_normal_force_n: f64,
    pub dynamic_factor: Option<f64>,
    pub mean_wheel_force_n: [f64; 3],
    pub mean_pinion_tilting_moment_nmm: f64,
    pub mean_wheel_tilting_moment_nmm: f64,
    pub max_coast_normal_force_n: Option<f64>,
    pub least_slice_force_n: Option<f64>,
    pub mean_wheel_speed_rpm: Option<f64>,
    pub mean_pinion_speed_rpm: Option<f64>,
    /// The largest of a ramp, and where.
    pub ramp: Option<PassageHeadline>,
    pub certificate: LumpedCertificate,
}
}

/// How far a run can be trusted.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // as above
pub struct LumpedCertificate {
    pub ledger_residual_mj: f64,
    pub ledger_residual_over_turnover: f64,
    pub energy_open_over_vibration: f64,
    pub period_cycles: Option<usize>,
    pub periodicity: Option<f64>,
    /// Largest exponent of a motion that does not repeat itself, 1/s.
    pub lyapunov: Option<Lyapunov>,
    pub warm_up_cycles: u64,
    pub rows_without_contact: usize,
    pub steps: u64,
    pub refused_steps: u64,
}

/// What the headline takes beside the run.
pub(super) struct HeadlineInputs<'a> {
    pub coordinates: usize,
    pub mesh_frequency_hz: f64,
    pub resonance_hz: Option<f64>,
    /// T / (r_b cos b_b) of the mean load, N.
    pub static_normal_force: f64,
    pub static_errors: Option<&'a [f64]>,
    pub lyapunov: Option<Lyapunov>,
}

/// Headline numbers of the mesh cycles that are judged.
///
/// # Errors
/// [`StudyError`] when the rows hold a transmission error that is no number.
pub(super) fn headline(
    scene: &Scene,
    motion: &MotionScene,
    run: &LumpedRun,
    known: &HeadlineInputs<'_>,
) -> Result<LumpedHeadline, StudyError> {
    let rows = run.judged_rows();
    let of = |value: fn(&LumpedRow) -> f64| -> Vec<f64> { rows.iter().map(value).collect() };
    // What a model does not tell of one row it tells of none.
    let known_of = |value: fn(&LumpedRow) -> Option<f64>| -> Option<Vec<f64>> {
        rows.iter().map(value).collect::<Option<Vec<f64>>>().filter(|all| !all.is_empty())
    };
    let mean_of = |value: fn(&LumpedRow) -> Option<f64>| known_of(value).map(|all| mean(&all));
    let cycles = run.judged as usize;
    let dte = of(|r| r.transmission_error_um);
    let of_dte = cycle_statistics(&dte, cycles)?;
    let ste: Option<Vec<f64>> = known.static_errors.map(|all| all.iter().map(|e| 1e3 * e).collect());
    let of_ste = ste.map(|all| cycle_statistics(&all, 1)).transpose()?;
    let force = of(|r| r.normal_force);
    let [min_force, max_force] = extent(&force);
    let loaded = known.static_normal_force > 0.0;
    Ok(LumpedHeadline {
        run: motion.run,
        coordinates: known.coordinates,
        speed_rpm: motion.ramp.map_or(scene.operation.speed_rpm, |r| r.to_rpm),
        mesh_frequency_hz: known.mesh_frequency_hz,
        mesh_resonance_hz: known.resonance_hz,
        rows_per_cycle: motion.steps_per_mesh_cycle,
        steps_per_row: run.steps_per_row,
        cycles: run.cycles,
        judged_cycles: run.judged,
        mean_dte_um: of_dte.mean,
        rms_dte_um: root_mean_square(&dte),
        peak_to_peak_dte_um: of_dte.peak_to_peak,
        min_dte_um: of_dte.min,
        max_dte_um: of_dte.max,
        dte_harmonics_um: mesh_harmonics(&dte, cycles, ORDERS)?.iter().map(|h| h.amplitude).collect(),
        mean_ste_um: of_ste.as_ref().map(|s| s.mean),
        peak_to_peak_ste_um: of_ste.as_ref().map(|s| s.peak_to_peak),
        mean_mesh_stiffness_n_per_um: mean_of(|r| Some(1e-3 * r.mesh_stiffness?)),
        mean_contact_line_length_mm: mean_of(|r| r.contact_line_length),
        static_normal_force_n: known.static_normal_force,
        mean_normal_force_n: mean(&force),
        min_normal_force_n: min_force,
        max_normal_force_n: max_force,
        dynamic_factor: loaded.then(|| max_force / known.static_normal_force),
        mean_wheel_force_n: [of(|r| r.wrench[1][0]), of(|r| r.wrench[1][1]), of(|r| r.wrench[1][2])].map(|f| mean(&f)),
        mean_pinion_tilting_moment_nmm: mean(&of(|r| r.wrench[0][4])),
        mean_wheel_tilting_moment_nmm: mean(&of(|r| r.wrench[1][4])),
        max_coast_normal_force_n: known_of(|r| r.coast_normal_force).map(|all| extent(&all)[1]),
        least_slice_force_n: known_of(|r| r.least_slice_force).map(|all| extent(&all)[0]),
        mean_wheel_speed_rpm: mean_of(|r| Some(r.speeds?[1] * 60.0 / TAU)),
        mean_pinion_speed_rpm: mean_of(|r| Some(r.speeds?[0] * 60.0 / TAU)),
        ramp: None,
        certificate: certificate(run, known.lyapunov),
    })
}

fn certificate(run: &LumpedRun, lyapunov: Option<Lyapunov>) -> LumpedCertificate {
    LumpedCertificate {
        ledger_residual_mj: run.ledger.residual(),
        ledger_residual_over_turnover: run.ledger.relative_residual(),
        energy_open_over_vibration: run.ledger.open_over_vibration(),
        period_cycles: run.periodicity.map(|p| p.period),
        periodicity: run.periodicity.map(|p| p.residual),
        lyapunov,
        warm_up_cycles: run.warm_up,
        rows_without_contact: run.judged_rows().iter().filter(|r| r.contact_line_length == Some(0.0)).count(),
        steps: run.steps[0],
        refused_steps: run.steps[1],
    }
}
