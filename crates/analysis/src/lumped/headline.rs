//! Headline values of a run of a cheaper model.

use scene::{MotionScene, Run, Scene};
use serde::Serialize;
use study::{Lyapunov, cycle_statistics, extent, mean, mesh_harmonics, root_mean_square};

use super::{run_loop::LumpedRun, survey::RowSurvey};
use crate::{AnalysisError, motion::RunUpHeadline, running::Running};

/// Mesh harmonics that are listed.
const ORDERS: usize = 8;

described::described! {
    /// The few numbers that a run is made for; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct LumpedHeadline {
        /// kind of motion: `steady`, `span` or `ramp`
        pub run: Run,
        /// coordinates of the model
        pub coordinates: usize,
        /// speed of the driver; of a ramp the last one
        pub speed_rpm: f64,
        /// mesh frequency at `speed_rpm`
        pub mesh_frequency_hz: f64,
        /// natural frequency of the mesh; `null` where the model has none
        pub mesh_resonance_hz: Option<f64>,
        /// rows per mesh cycle
        pub rows_per_cycle: u32,
        /// steps from row to row
        pub steps_per_row: u32,
        /// mesh cycles that are written
        pub cycles: u64,
        /// mesh cycles at the end that the headline is made of; after a ramp those at the last speed
        pub judged_cycles: u64,
        /// mean dynamic transmission error (DTE)
        pub mean_dte_um: f64,
        /// root mean square of the DTE about its mean
        pub rms_dte_um: f64,
        /// largest minus smallest DTE of a mesh cycle, averaged over the cycles
        pub peak_to_peak_dte_um: f64,
        /// smallest DTE
        pub min_dte_um: f64,
        /// largest DTE
        pub max_dte_um: f64,
        /// single-sided amplitudes of the mesh harmonics 1 .. 8 of the DTE
        pub dte_harmonics_um: Vec<f64>,
        /// mean transmission error of the model at rest under its mean load; of `impact` without damping and friction
        pub mean_ste_um: Option<f64>,
        /// peak to peak of the transmission error of the model at rest
        pub peak_to_peak_ste_um: Option<f64>,
        /// mean mesh stiffness; `null` where the model has none
        pub mean_mesh_stiffness_n_per_um: Option<f64>,
        /// mean contact-line length; `null` where the model has none
        pub mean_contact_line_length_mm: Option<f64>,
        /// T / (r_b cos b_b) of the mean load
        pub static_normal_force_n: f64,
        /// mean normal force
        pub mean_normal_force_n: f64,
        /// smallest normal force
        pub min_normal_force_n: f64,
        /// largest normal force
        pub max_normal_force_n: f64,
        /// largest normal force over the static one; `null` without load
        pub dynamic_factor: Option<f64>,
        /// mean mesh force on the wheel: x, y, z in fixed axes
        pub mean_wheel_force_n: [f64; 3],
        /// mean mesh moment on the pinion about y through its centre
        pub mean_pinion_tilting_moment_nmm: f64,
        /// mean mesh moment on the wheel about y through its centre
        pub mean_wheel_tilting_moment_nmm: f64,
        /// largest sum of the normal forces on the coast flanks; `impact` and `mapped`
        pub max_coast_normal_force_n: Option<f64>,
        /// smallest force of a slice in contact; `impact`
        pub least_slice_force_n: Option<f64>,
        /// mean speed of the wheel about +z; `impact` and `mapped`
        pub mean_wheel_speed_rpm: Option<f64>,
        /// mean speed of the pinion about +z; `impact` and `mapped`
        pub mean_pinion_speed_rpm: Option<f64>,
        /// largest values of a ramp of `impact` and where they are; else `null`
        pub ramp: Option<RunUpHeadline>,
        /// measures of how exact the motion is
        pub certificate: LumpedCertificate,
    }
}

described::described! {
    /// How far a run can be trusted.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct LumpedCertificate {
        /// energy that does not close since the start
        pub ledger_residual_mj: f64,
        /// `ledger_residual_mj` over all work done
        pub ledger_residual_over_turnover: f64,
        /// energy that the steps add or take by themselves, over the changes of kinetic and elastic energy, each step by its amount
        pub energy_open_over_vibration: f64,
        /// mesh cycles after which the same teeth meet, where these differ; else 1. `null` where that takes more than 100000
        pub common_period_cycles: Option<u64>,
        /// mesh cycles after which the motion repeats itself best: a multiple of `common_period_cycles`
        pub period_cycles: Option<usize>,
        /// largest difference of a coordinate or velocity after that period, over its peak to peak
        pub periodicity: Option<f64>,
        /// largest Lyapunov exponent of a motion that does not repeat itself; not of `impact`
        pub lyapunov: Option<Lyapunov>,
        /// mesh cycles before the first row
        pub warm_up_cycles: u64,
        /// rows in which the flanks are apart
        pub rows_without_contact: usize,
        /// about how much of itself steps change the peak to peak of the DTE by: an estimate from its harmonics beside the mesh resonance, where steps follow an error for their mean length ([theory](theory.md), equation 66a); `null` of a ramp, where an explicit method follows an error, and of `impact`, whose mesh has no one stiffness
        pub step_error_percent: Option<f64>,
        /// steps that were taken
        pub steps: u64,
        /// steps that were taken back and divided
        pub refused_steps: u64,
    }
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

/// Headline numbers of the mesh cycles that are judged, with what was read off the rows.
///
/// # Errors
/// [`AnalysisError::Statistics`] when the rows hold a transmission error that is no number.
pub(super) fn headline(
    scene: &Scene,
    motion: &MotionScene,
    run: &LumpedRun,
    known: &HeadlineInputs<'_>,
) -> Result<LumpedHeadline, AnalysisError> {
    let RowSurvey { judged, series, .. } = &run.survey;
    let mean_of = |of: Running| of.known().map(|of| of.mean());
    let cycles = run.judged as usize;
    let (dte, force) = (&series.dte_um, &series.normal_force_n);
    let of_dte = cycle_statistics(dte, cycles)?;
    let ste: Option<Vec<f64>> = known.static_errors.map(|all| all.iter().map(|e| 1e3 * e).collect());
    let of_ste = ste.map(|all| cycle_statistics(&all, 1)).transpose()?;
    let [min_force, max_force] = extent(force);
    let [wheel_x, wheel_y] = judged.wheel_force.map(|of| of.mean());
    let [pinion_speed, wheel_speed] = judged.speeds_rpm.map(mean_of);
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
        rms_dte_um: root_mean_square(dte),
        peak_to_peak_dte_um: of_dte.peak_to_peak,
        min_dte_um: of_dte.min,
        max_dte_um: of_dte.max,
        dte_harmonics_um: mesh_harmonics(dte, cycles, ORDERS)?.iter().map(|h| h.amplitude).collect(),
        mean_ste_um: of_ste.as_ref().map(|s| s.mean),
        peak_to_peak_ste_um: of_ste.as_ref().map(|s| s.peak_to_peak),
        mean_mesh_stiffness_n_per_um: mean_of(judged.stiffness),
        mean_contact_line_length_mm: mean_of(judged.contact_line_length),
        static_normal_force_n: known.static_normal_force,
        mean_normal_force_n: mean(force),
        min_normal_force_n: min_force,
        max_normal_force_n: max_force,
        dynamic_factor: loaded.then(|| max_force / known.static_normal_force),
        mean_wheel_force_n: [wheel_x, wheel_y, mean(&series.wheel_force_z_n)],
        mean_pinion_tilting_moment_nmm: mean(&series.moment_y_nmm[0]),
        mean_wheel_tilting_moment_nmm: mean(&series.moment_y_nmm[1]),
        max_coast_normal_force_n: judged.coast_normal_force.known().map(|of| of.ends[1]),
        least_slice_force_n: judged.least_slice_force.known().map(|of| of.ends[0]),
        mean_wheel_speed_rpm: wheel_speed,
        mean_pinion_speed_rpm: pinion_speed,
        ramp: None,
        certificate: certificate(run, judged.without_contact, known.lyapunov),
    })
}

fn certificate(run: &LumpedRun, rows_without_contact: usize, lyapunov: Option<Lyapunov>) -> LumpedCertificate {
    LumpedCertificate {
        ledger_residual_mj: run.ledger.residual(),
        ledger_residual_over_turnover: run.ledger.relative_residual(),
        energy_open_over_vibration: run.ledger.open_over_vibration(),
        common_period_cycles: run.common_period,
        period_cycles: run.periodicity.map(|p| p.period),
        periodicity: run.periodicity.map(|p| p.residual),
        lyapunov,
        warm_up_cycles: run.warm_up,
        rows_without_contact,
        step_error_percent: None,
        steps: run.steps[0],
        refused_steps: run.steps[1],
    }
}
