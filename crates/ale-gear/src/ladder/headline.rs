//! The few numbers that a run of a model of the ladder is made for.

use analysis::motion::PassageHeadline;
use serde::Serialize;
use study::{StudyError, cycle_statistics, extent, mean, mesh_harmonics};

use report::columns::motion_history::{COAST_FORCE, DTE, LINE_LENGTH, NORMAL_FORCE, PINION_SPEED, WHEEL_SPEED};

use super::course::Course;
use crate::{
    motion::Columns,
    scene::{MotionScene, Run, Scene},
};

/// Mesh harmonics that are listed.
const ORDERS: usize = 8;

/// The few numbers that a run is made for; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub(crate) struct LadderHeadline {
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
    pub certificate: LadderCertificate,
}

/// How far a run can be trusted.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // as above
pub(crate) struct LadderCertificate {
    pub ledger_residual_mj: f64,
    pub ledger_residual_over_turnover: f64,
    pub period_cycles: Option<usize>,
    pub periodicity: Option<f64>,
    pub warm_up_cycles: u64,
    pub rows_without_contact: usize,
    pub steps: u64,
    pub refused_steps: u64,
}

/// What the headline takes beside rows and course.
pub(super) struct Known<'a> {
    pub coordinates: usize,
    pub mesh_frequency_hz: f64,
    pub resonance_hz: Option<f64>,
    /// T / (r_b cos b_b) of the mean load, N.
    pub static_normal_force: f64,
    pub static_errors: Option<&'a [f64]>,
}

/// Headline numbers of `rows`, those of the mesh cycles that are judged.
///
/// # Errors
/// [`StudyError`] when the rows hold a transmission error that is no number.
pub(super) fn headline(
    scene: &Scene,
    words: &MotionScene,
    course: &Course,
    rows: &Columns,
    known: &Known<'_>,
) -> Result<LadderHeadline, StudyError> {
    let dte = rows.series(DTE.name)?;
    let of_dte = cycle_statistics(dte, course.judged as usize)?;
    let ste: Option<Vec<f64>> = known.static_errors.map(|all| all.iter().map(|e| 1e3 * e).collect());
    let of_ste = ste.map(|all| cycle_statistics(&all, 1)).transpose()?;
    let there = |name: &str| rows.find(name).filter(|all| !all.is_empty());
    let [min_force, max_force] = rows.extent(NORMAL_FORCE.name)?;
    let loaded = known.static_normal_force > 0.0;
    Ok(LadderHeadline {
        run: words.run,
        coordinates: known.coordinates,
        speed_rpm: words.ramp.map_or(scene.operation.speed_rpm, |r| r.to_rpm),
        mesh_frequency_hz: known.mesh_frequency_hz,
        mesh_resonance_hz: known.resonance_hz,
        rows_per_cycle: words.steps_per_mesh_cycle,
        steps_per_row: course.steps_per_row,
        cycles: course.cycles,
        judged_cycles: course.judged,
        mean_dte_um: of_dte.mean,
        peak_to_peak_dte_um: of_dte.peak_to_peak,
        min_dte_um: of_dte.min,
        max_dte_um: of_dte.max,
        dte_harmonics_um: mesh_harmonics(dte, course.judged as usize, ORDERS)?.iter().map(|h| h.amplitude).collect(),
        mean_ste_um: of_ste.as_ref().map(|s| s.mean),
        peak_to_peak_ste_um: of_ste.as_ref().map(|s| s.peak_to_peak),
        mean_mesh_stiffness_n_per_um: there("mesh_stiffness_n_per_um").map(mean),
        mean_contact_line_length_mm: there(LINE_LENGTH.name).map(mean),
        static_normal_force_n: known.static_normal_force,
        mean_normal_force_n: rows.mean(NORMAL_FORCE.name)?,
        min_normal_force_n: min_force,
        max_normal_force_n: max_force,
        dynamic_factor: loaded.then(|| max_force / known.static_normal_force),
        mean_wheel_force_n: [
            rows.mean("wheel_force_x_n")?,
            rows.mean("wheel_force_y_n")?,
            rows.mean("wheel_force_z_n")?,
        ],
        mean_pinion_tilting_moment_nmm: rows.mean("pinion_moment_y_nmm")?,
        mean_wheel_tilting_moment_nmm: rows.mean("wheel_moment_y_nmm")?,
        max_coast_normal_force_n: there(COAST_FORCE.name).map(|all| extent(all)[1]),
        least_slice_force_n: there("least_slice_force_n").map(|all| extent(all)[0]),
        mean_wheel_speed_rpm: there(WHEEL_SPEED.name).map(mean),
        mean_pinion_speed_rpm: there(PINION_SPEED.name).map(mean),
        ramp: None,
        certificate: LadderCertificate {
            ledger_residual_mj: course.ledger.residual(),
            ledger_residual_over_turnover: course.ledger.relative_residual(),
            period_cycles: course.periodicity.map(|p| p.period),
            periodicity: course.periodicity.map(|p| p.residual),
            warm_up_cycles: course.warm_up,
            rows_without_contact: rows.find(LINE_LENGTH.name).unwrap_or_default().iter().filter(|l| **l == 0.0).count(),
            steps: course.steps[0],
            refused_steps: course.steps[1],
        },
    })
}
