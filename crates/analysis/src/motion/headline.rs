//! Headline values of a motion.

use dynamics::Drive;
use scene::{MotionScene, Run, Scene};
use serde::Serialize;
use study::{cycle_statistics, extent, mean, mesh_harmonics, peak_to_peak, root_mean_square};

use super::{
    MotionRow, MotionSeries,
    course::FinishedMotion,
    orders::{CriticalSpeed, RunUp, RunUpHeadline},
    setup::{ElasticHeadline, InertiaHeadline, PreparedMotion, Vibration, mesh_range_hz},
};
use crate::{
    AnalysisError,
    in_motion::{BothFlanks, FlankCertificate},
    results::PressurePlace,
    running::Running,
};

/// Mesh harmonics that are listed.
const ORDERS: usize = 8;

described::described! {
    /// The few numbers that a motion is run for; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct MotionHeadline {
        /// kind of motion: `steady`, `span` or `ramp`
        pub run: Run,
        /// speed of the driver: the given one, else the mean of the rows
        pub speed_rpm: f64,
        /// mesh frequency at `speed_rpm`
        pub mesh_frequency_hz: f64,
        /// sqrt(k_m / m_e) / (2 pi): k_m mean tangent stiffness of the quasi-static cycle, m_e `equivalent_mass_kg`
        pub mesh_resonance_hz: f64,
        /// inertia of the gears, and the mesh resonance with either choice of it
        pub inertia: InertiaHeadline,
        /// elastic frequencies of the gears beside the mesh harmonics
        pub elasticity: ElasticHeadline,
        /// rows per mesh cycle
        pub rows_per_cycle: u32,
        /// mesh cycles that are written
        pub cycles: u64,
        /// coordinates of the axes that are free
        pub free_coordinates: Vec<String>,
        /// mean dynamic transmission error (DTE) of the rows
        pub mean_dte_um: f64,
        /// root mean square of the DTE about its mean
        pub rms_dte_um: f64,
        /// largest minus smallest DTE of a mesh cycle, averaged over the cycles; of a ramp the largest of a cycle
        pub peak_to_peak_dte_um: f64,
        /// smallest DTE of the rows
        pub min_dte_um: f64,
        /// largest DTE of the rows
        pub max_dte_um: f64,
        /// single-sided amplitudes of the mesh harmonics 1 .. 8 of the DTE; of a ramp the largest over speed
        pub dte_harmonics_um: Vec<f64>,
        /// mean static transmission error under the same load
        pub mean_ste_um: f64,
        /// peak to peak of the static transmission error under the same load
        pub peak_to_peak_ste_um: f64,
        /// mean tangent mesh stiffness of the quasi-static cycle
        pub mean_mesh_stiffness_n_per_um: f64,
        /// mean total contact-line length of the driving flanks
        pub mean_contact_line_length_mm: f64,
        /// mean sum of the normal forces on the driving flanks
        pub mean_normal_force_n: f64,
        /// smallest sum of the normal forces on the driving flanks
        pub min_normal_force_n: f64,
        /// largest sum of the normal forces on the driving flanks
        pub max_normal_force_n: f64,
        /// mean sum of the normal forces of the quasi-static cycle
        pub mean_static_normal_force_n: f64,
        /// largest sum of normal forces on driving or coast flanks over the mean quasi-static one, of this motion. It is not K_v of ISO 6336-1, which is estimated from speed, resonance and tooth deviations
        pub dynamic_factor: f64,
        /// largest sum of the normal forces on the coast flanks
        pub max_coast_normal_force_n: f64,
        /// mean mesh force on the wheel: x, y, z in fixed axes
        pub mean_wheel_force_n: [f64; 3],
        /// peak to peak of the axial mesh force on the wheel
        pub peak_to_peak_wheel_axial_force_n: f64,
        /// mean mesh moment on the pinion about y through its centre
        pub mean_pinion_tilting_moment_nmm: f64,
        /// peak to peak of the mesh moment on the pinion about y
        pub peak_to_peak_pinion_tilting_moment_nmm: f64,
        /// mean mesh moment on the wheel about y through its centre
        pub mean_wheel_tilting_moment_nmm: f64,
        /// largest force of a bearing; 0 where no axis is free
        pub max_bearing_force_n: f64,
        /// largest contact pressure of the rows
        pub max_pressure_mpa: f64,
        /// place of the largest pressure; `null` without slices
        pub max_pressure_at: Option<PressurePlace>,
        /// largest root tension of pinion and wheel; `null` where it is not asked for
        pub max_root_tension_mpa: Option<[f64; 2]>,
        /// estimated error of the largest root tension of pinion and wheel
        pub max_root_tension_estimated_error_percent: Option<[f64; 2]>,
        /// tooth changes of the window since the quasi-static start
        pub tooth_changes: u64,
        /// largest values of a ramp and where they are; `null` without a ramp
        pub ramp: Option<RunUpHeadline>,
        /// speeds, up to the highest of the run, at which a mesh order meets a natural frequency
        pub critical_speeds: Vec<CriticalSpeed>,
        /// measures of how exact the motion is
        pub certificate: MotionCertificate,
    }
}

impl MotionHeadline {
    /// Largest root tension (MPa) of pinion and wheel and its estimated error (%), if requested.
    pub fn root_tensions(&self) -> Option<[(f64, f64); 2]> {
        let (stress, error) = (self.max_root_tension_mpa?, self.max_root_tension_estimated_error_percent?);
        Some([(stress[0], error[0]), (stress[1], error[1])])
    }
}

described::described! {
    /// How far a motion can be trusted.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct MotionCertificate {
        /// energy that does not close since the start
        pub ledger_residual_mj: f64,
        /// load torque times nominal rotation
        pub work_through_pair_mj: f64,
        /// `ledger_residual_mj` over `work_through_pair_mj`
        pub ledger_residual_over_work: f64,
        /// `ledger_residual_mj` over all work that changed the deviations from the nominal motion
        pub ledger_residual_over_turnover: f64,
        /// energy that the steps add or take by themselves, over the changes of kinetic and elastic energy, each step by its amount; the check `energy_residual` judges it
        pub energy_open_over_vibration: f64,
        /// mesh cycles after which the same teeth meet, where these differ; else 1. `null` where that takes more than 100000
        pub common_period_cycles: Option<u64>,
        /// mesh cycles after which the motion repeats itself best: a multiple of `common_period_cycles`
        pub period_cycles: Option<usize>,
        /// largest difference of a coordinate or velocity after that period, over its peak to peak
        pub periodicity: Option<f64>,
        /// share of a disturbance that is left after a period (below 1: stable); `null` without shooting
        pub shooting_multiplier: Option<f64>,
        /// periods that shooting integrated
        pub shooting_periods: Option<usize>,
        /// mesh cycles before the first row
        pub warm_up_cycles: u64,
        /// what its flanks do
        #[serde(flatten)]
        pub flanks: FlankCertificate,
        /// about how much of itself steps change the peak to peak of the DTE by: an estimate from its harmonics beside the mesh resonance, where steps follow an error for their mean length ([theory](theory.md), equation 66a); `null` of a ramp, and where an explicit method follows an error
        pub step_error_percent: Option<f64>,
        /// steps that were taken
        pub steps: u64,
        /// steps that were taken back and divided: too large an error, no solution, or beyond the stability limit of an explicit method
        pub refused_steps: u64,
    }
}

/// Numbers of the rows, beside their series.
#[derive(Default)]
struct Survey {
    coast_force: Running,
    contact_line_length: Running,
    wheel_force: [Running; 2],
    pressure: Running,
    bearing_force: f64,
    /// Row of the largest pressure.
    hardest: Option<MotionRow>,
    /// Largest root tension of pinion and wheel (MPa) and its estimated error (%), where they were asked for.
    tension: Option<[(f64, f64); 2]>,
    /// Rows in which driving and coast flanks press at once.
    both: BothFlanks,
}

impl Survey {
    fn of(done: &FinishedMotion) -> Result<Self, AnalysisError> {
        let mut all = Self::default();
        done.rows.for_each(0..done.rows.len(), |row| all.take(row))?;
        Ok(all)
    }

    fn take(&mut self, row: &MotionRow) {
        self.coast_force.push(row.coast_normal_force_n);
        self.contact_line_length.push(row.contact_line_length_mm);
        [0, 1].into_iter().for_each(|k| self.wheel_force[k].push(row.force_n[1][k]));
        self.pressure.push(row.max_pressure_mpa);
        for bearing in row.bearing.iter().flatten() {
            self.bearing_force = self.bearing_force.max(bearing.force_n.map(|f| f * f).iter().sum::<f64>().sqrt());
        }
        if self.hardest.as_ref().is_none_or(|best| row.max_pressure_mpa > best.max_pressure_mpa) {
            self.hardest = Some(row.clone());
        }
        if let Some(both) = &row.root_stress {
            let largest = self.tension.get_or_insert([(f64::NAN, f64::NAN); 2]);
            for (best, now) in largest.iter_mut().zip(&**both) {
                // NaN where coast flanks press.
                let is_more = now.max_principal_mpa > best.0 || best.0.is_nan();
                if is_more && !now.max_principal_mpa.is_nan() {
                    *best = (now.max_principal_mpa, now.estimated_error_percent);
                }
            }
        }
        self.both.push([row.normal_force_n, row.coast_normal_force_n]);
    }

    /// Where the pressure is largest in any row.
    fn hardest(&self) -> Option<PressurePlace> {
        let row = self.hardest.as_ref()?;
        Some(PressurePlace::of_spot(row.max_pressure_at.as_ref()?, row.pinion_angle_deg, row.mesh_phase))
    }
}

/// Headline numbers from the rows, with their series and the speed of the driver (1/min), and from what was counted; of a
/// ramp peak to peak and harmonics are the largest of its `run_up`.
///
/// # Errors
/// [`AnalysisError::Statistics`] when the rows are no whole cycles, or hold a transmission error that is no number.
pub(super) fn headline(
    (scene, motion): (&Scene, &MotionScene),
    prepared: &PreparedMotion,
    (done, series, driver_rpm): (&FinishedMotion, &MotionSeries, &[f64]),
    run_up: Option<&RunUp>,
) -> Result<MotionHeadline, AnalysisError> {
    let cycles = done.motion.stage().recorded;
    let survey = Survey::of(done)?;
    let MotionSeries { dte_um: dte, normal_force_n: normal_force, wheel_force_z_n: axial, .. } = series;
    let of_dte = cycle_statistics(dte, cycles as usize)?;
    let ste: Vec<f64> = prepared.quasi_static.transmission_error.iter().map(|e| 1e3 * e).collect();
    let of_ste = cycle_statistics(&ste, 1)?;
    let system = &prepared.system;
    let options = system.options();
    let driver = 1 - options.statics.driven();
    let teeth = f64::from([scene.pinion.teeth, scene.wheel.teeth][driver]);
    let speed_rpm = match &options.drive {
        Drive::Speed(_) | Drive::Balanced(_) if motion.ramp.is_none() => scene.operation.speed_rpm,
        _ => mean(driver_rpm).abs(),
    };
    let [min_force, max_force] = extent(normal_force);
    let [_, max_coast_force] = survey.coast_force.ends;
    let [wheel_x, wheel_y] = survey.wheel_force.map(|of| of.mean());
    let tilting = &series.moment_y_nmm;
    let static_force = prepared.quasi_static.normal_force;
    let tension = survey.tension;
    let ramp = run_up.and_then(RunUp::headline);
    let (peak, harmonics): (f64, Vec<f64>) = match &ramp {
        Some(ramp) => (ramp.peak_to_peak_dte_um.value, ramp.dte_harmonics_um.iter().map(|l| l.value).collect()),
        None => {
            let all = mesh_harmonics(dte, cycles as usize, ORDERS)?;
            (of_dte.peak_to_peak, all.iter().map(|h| h.amplitude).collect())
        }
    };
    let vibration = Vibration {
        mesh_hz: mesh_range_hz(scene, motion, Some(driver_rpm)),
        resonance: system.mesh_resonance(),
        peak_to_peak_um: peak,
    };
    Ok(MotionHeadline {
        run: motion.run,
        speed_rpm,
        mesh_frequency_hz: speed_rpm * teeth / 60.0,
        mesh_resonance_hz: system.mesh_resonance_hz(),
        inertia: InertiaHeadline::of(system),
        elasticity: prepared.elasticity.headline(&vibration),
        rows_per_cycle: motion.steps_per_mesh_cycle,
        cycles,
        free_coordinates: system.names().into_iter().map(str::to_owned).collect(),
        mean_dte_um: of_dte.mean,
        rms_dte_um: root_mean_square(dte),
        peak_to_peak_dte_um: peak,
        min_dte_um: of_dte.min,
        max_dte_um: of_dte.max,
        dte_harmonics_um: harmonics,
        mean_ste_um: of_ste.mean,
        peak_to_peak_ste_um: of_ste.peak_to_peak,
        mean_mesh_stiffness_n_per_um: 1e-3 * prepared.quasi_static.stiffness,
        mean_contact_line_length_mm: survey.contact_line_length.mean(),
        mean_normal_force_n: mean(normal_force),
        min_normal_force_n: min_force,
        max_normal_force_n: max_force,
        mean_static_normal_force_n: static_force,
        dynamic_factor: max_force.max(max_coast_force) / static_force,
        max_coast_normal_force_n: max_coast_force,
        mean_wheel_force_n: [wheel_x, wheel_y, mean(axial)],
        peak_to_peak_wheel_axial_force_n: peak_to_peak(axial),
        mean_pinion_tilting_moment_nmm: mean(&tilting[0]),
        peak_to_peak_pinion_tilting_moment_nmm: peak_to_peak(&tilting[0]),
        mean_wheel_tilting_moment_nmm: mean(&tilting[1]),
        max_bearing_force_n: survey.bearing_force,
        max_pressure_mpa: survey.pressure.ends[1],
        max_root_tension_mpa: tension.map(|of| of.map(|(stress, _)| stress)),
        max_root_tension_estimated_error_percent: tension.map(|of| of.map(|(_, error)| error)),
        max_pressure_at: survey.hardest(),
        tooth_changes: done.motion.system().changes(0).count,
        ramp,
        critical_speeds: Vec::new(),
        certificate: certificate((done, &survey), prepared),
    })
}

fn certificate((done, survey): (&FinishedMotion, &Survey), prepared: &PreparedMotion) -> MotionCertificate {
    let motion = &done.motion;
    let cos = prepared.system.pair().base_helix_angle().cos();
    let along_normal = prepared.quasi_static.stiffness / (cos * cos);
    let counts = motion.counts();
    let ledger = motion.ledger().copied().unwrap_or_default();
    let settled = done.motion.stage().periodicity;
    MotionCertificate {
        ledger_residual_mj: ledger.residual(),
        work_through_pair_mj: motion.system().throughput(),
        ledger_residual_over_work: ledger.residual() / motion.system().throughput().max(f64::MIN_POSITIVE),
        ledger_residual_over_turnover: ledger.relative_residual(),
        energy_open_over_vibration: ledger.open_over_vibration(),
        common_period_cycles: motion.system().common_period(),
        period_cycles: settled.map(|p| p.period),
        periodicity: settled.map(|p| p.residual),
        shooting_multiplier: done.shooting.as_ref().map(|s| s.multiplier),
        shooting_periods: done.shooting.as_ref().map(|s| s.periods),
        warm_up_cycles: motion.cycle() - done.motion.stage().recorded,
        flanks: FlankCertificate::new(&motion.system().flank_course(0, counts), survey.both, along_normal),
        step_error_percent: None,
        steps: counts.steps,
        refused_steps: counts.refused,
    }
}
