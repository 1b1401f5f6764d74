//! The few numbers that a motion is run for.

use analysis::motion::{CriticalSpeed, Passage, PassageHeadline};
use dynamics::Drive;
use serde::Serialize;
use study::{Columns, StudyError, cycle_statistics, extent, mean, mesh_harmonics};

use report::columns::{At, Column, MotionRows};

use report::columns::motion_history::{
    BEARING_FORCE_X, BEARING_FORCE_Y, BEARING_FORCE_Z, COAST_FORCE, DTE, FORCE_X, FORCE_Y, FORCE_Z, LINE_LENGTH,
    MAX_PRESSURE, MESH_PHASE, MOMENT_Y, NORMAL_FORCE, PINION_ANGLE, PINION_SPEED, PRESSURE_DIAMETER, PRESSURE_PLACE,
    PRESSURE_Z, ROOT_ERROR, ROOT_TENSION, WHEEL_SPEED,
};

use super::{
    course::Finished,
    elasticity::{ElasticHeadline, Vibration, mesh_range_hz},
    inertia::InertiaHeadline,
    prepare::Prepared,
};
use crate::{
    output::PressurePlace,
    scene::{MotionScene, Run, Scene},
};

/// Mesh harmonics that are listed.
const ORDERS: usize = 8;

/// The few numbers that a motion is run for; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub(crate) struct MotionHeadline {
    pub run: Run,
    pub speed_rpm: f64,
    pub mesh_frequency_hz: f64,
    pub mesh_resonance_hz: f64,
    pub inertia: InertiaHeadline,
    pub elasticity: ElasticHeadline,
    pub rows_per_cycle: u32,
    pub cycles: u64,
    pub free_coordinates: Vec<String>,
    pub mean_dte_um: f64,
    pub peak_to_peak_dte_um: f64,
    pub min_dte_um: f64,
    pub max_dte_um: f64,
    pub dte_harmonics_um: Vec<f64>,
    pub mean_ste_um: f64,
    pub peak_to_peak_ste_um: f64,
    pub mean_mesh_stiffness_n_per_um: f64,
    pub mean_contact_line_length_mm: f64,
    pub mean_normal_force_n: f64,
    pub min_normal_force_n: f64,
    pub max_normal_force_n: f64,
    pub mean_static_normal_force_n: f64,
    pub dynamic_factor: f64,
    pub max_coast_normal_force_n: f64,
    pub mean_wheel_force_n: [f64; 3],
    pub peak_to_peak_wheel_axial_force_n: f64,
    pub mean_pinion_tilting_moment_nmm: f64,
    pub peak_to_peak_pinion_tilting_moment_nmm: f64,
    pub mean_wheel_tilting_moment_nmm: f64,
    pub max_bearing_force_n: f64,
    pub max_pressure_mpa: f64,
    pub max_pressure_at: Option<PressurePlace>,
    pub max_root_tension_mpa: Option<[f64; 2]>,
    pub max_root_tension_estimated_error_percent: Option<[f64; 2]>,
    pub tooth_changes: u64,
    pub ramp: Option<PassageHeadline>,
    pub critical_speeds: Vec<CriticalSpeed>,
    pub certificate: MotionCertificate,
}

impl MotionHeadline {
    /// Largest root tension (MPa) of pinion and wheel and its estimated error (%), when they were asked for.
    pub fn root_tensions(&self) -> Option<[(f64, f64); 2]> {
        let (stress, error) = (self.max_root_tension_mpa?, self.max_root_tension_estimated_error_percent?);
        Some([(stress[0], error[0]), (stress[1], error[1])])
    }
}

/// How far a motion can be trusted.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // as above
pub(crate) struct MotionCertificate {
    pub ledger_residual_mj: f64,
    pub work_through_pair_mj: f64,
    pub ledger_residual_over_work: f64,
    pub ledger_residual_over_turnover: f64,
    pub least_contact_force_n: Option<f64>,
    pub force_jump_at_tooth_change_n: f64,
    pub period_cycles: Option<usize>,
    pub periodicity: Option<f64>,
    pub shooting_multiplier: Option<f64>,
    pub shooting_periods: Option<usize>,
    pub warm_up_cycles: u64,
    pub contact_losses: u64,
    pub steps_without_contact: u64,
    pub largest_gap_um: f64,
    pub coast_contacts: u64,
    pub steps: u64,
    pub refused_steps: u64,
}

/// Headline numbers from the rows and from what was counted; of a ramp peak to peak and harmonics are the largest of its `passage`.
///
/// # Errors
/// [`StudyError`] when the rows are no whole cycles, or hold a transmission error that is no number.
pub(super) fn headline(
    scene: &Scene,
    words: &MotionScene,
    prepared: &Prepared,
    done: &Finished,
    rows: &Columns,
    passage: Option<&Passage>,
) -> Result<MotionHeadline, StudyError> {
    let cycles = done.course.recorded;
    let dte = rows.series(DTE.name)?;
    let of_dte = cycle_statistics(dte, cycles as usize)?;
    let ste: Vec<f64> = prepared.quasi_static.transmission_error.iter().map(|e| 1e3 * e).collect();
    let of_ste = cycle_statistics(&ste, 1)?;
    let system = &prepared.system;
    let options = system.options();
    let teeth = f64::from([scene.pinion.teeth, scene.wheel.teeth][1 - options.statics.driven()]);
    let driver_rpm = rows.series([PINION_SPEED, WHEEL_SPEED][1 - options.statics.driven()].name)?;
    let speed_rpm = match &options.drive {
        Drive::Speed(_) | Drive::Balanced(_) if words.ramp.is_none() => scene.operation.speed_rpm,
        _ => mean(driver_rpm).abs(),
    };
    let largest = |names: &[String]| {
        // Gears without free coordinates have no columns of bearings.
        let columns: Vec<&[f64]> = names.iter().filter_map(|n| rows.find(n)).collect();
        (0..rows.len())
            .map(|i| columns.iter().map(|c| c.get(i).map_or(0.0, |x| x * x)).sum::<f64>().sqrt())
            .fold(0.0, f64::max)
    };
    let of = |gear: usize, column: Column<MotionRows>| rows.series(&column.name_at(At { gear, pair: 0 }));
    let wheel_force = [of(1, FORCE_X)?, of(1, FORCE_Y)?, of(1, FORCE_Z)?];
    let tilting = [of(0, MOMENT_Y)?, of(1, MOMENT_Y)?];
    let bearing = [0, 1].map(|gear| {
        largest(&[BEARING_FORCE_X, BEARING_FORCE_Y, BEARING_FORCE_Z].map(|c| c.name_at(At { gear, pair: 0 })))
    });
    let [min_force, max_force] = rows.extent(NORMAL_FORCE.name)?;
    let [_, max_coast_force] = rows.extent(COAST_FORCE.name)?;
    let static_force = prepared.quasi_static.normal_force;
    let tension = root_tension(scene, rows)?;
    let ramp = passage.and_then(Passage::headline);
    let (peak_to_peak, harmonics): (f64, Vec<f64>) = match &ramp {
        Some(ramp) => (ramp.peak_to_peak_dte_um.value, ramp.dte_harmonics_um.iter().map(|l| l.value).collect()),
        None => {
            let all = mesh_harmonics(dte, cycles as usize, ORDERS)?;
            (of_dte.peak_to_peak, all.iter().map(|h| h.amplitude).collect())
        }
    };
    let vibration = Vibration {
        mesh_hz: mesh_range_hz(scene, words, Some(driver_rpm)),
        resonance: system.mesh_resonance(),
        peak_to_peak_um: peak_to_peak,
    };
    Ok(MotionHeadline {
        run: words.run,
        speed_rpm,
        mesh_frequency_hz: speed_rpm * teeth / 60.0,
        mesh_resonance_hz: system.mesh_resonance_hz(),
        inertia: InertiaHeadline::of(system),
        elasticity: prepared.elasticity.headline(&vibration),
        rows_per_cycle: words.steps_per_mesh_cycle,
        cycles,
        free_coordinates: system.coordinates().names().iter().map(|&n| n.to_owned()).collect(),
        mean_dte_um: of_dte.mean,
        peak_to_peak_dte_um: peak_to_peak,
        min_dte_um: of_dte.min,
        max_dte_um: of_dte.max,
        dte_harmonics_um: harmonics,
        mean_ste_um: of_ste.mean,
        peak_to_peak_ste_um: of_ste.peak_to_peak,
        mean_mesh_stiffness_n_per_um: 1e-3 * prepared.quasi_static.stiffness,
        mean_contact_line_length_mm: rows.mean(LINE_LENGTH.name)?,
        mean_normal_force_n: rows.mean(NORMAL_FORCE.name)?,
        min_normal_force_n: min_force,
        max_normal_force_n: max_force,
        mean_static_normal_force_n: static_force,
        dynamic_factor: max_force.max(max_coast_force) / static_force,
        max_coast_normal_force_n: max_coast_force,
        mean_wheel_force_n: wheel_force.map(mean),
        peak_to_peak_wheel_axial_force_n: study::peak_to_peak(wheel_force[2]),
        mean_pinion_tilting_moment_nmm: mean(tilting[0]),
        peak_to_peak_pinion_tilting_moment_nmm: study::peak_to_peak(tilting[0]),
        mean_wheel_tilting_moment_nmm: mean(tilting[1]),
        max_bearing_force_n: bearing[0].max(bearing[1]),
        max_pressure_mpa: extent(rows.series(MAX_PRESSURE.name)?)[1],
        max_root_tension_mpa: tension.map(|of| of.map(|(stress, _)| stress)),
        max_root_tension_estimated_error_percent: tension.map(|of| of.map(|(_, error)| error)),
        max_pressure_at: hardest(rows)?,
        tooth_changes: done.motion.system().changes().count,
        ramp,
        critical_speeds: Vec::new(),
        certificate: certificate(done),
    })
}

/// Largest root tension of pinion and wheel over the rows (MPa), and its estimated error (%), when they were asked for.
fn root_tension(scene: &Scene, rows: &Columns) -> Result<Option<[(f64, f64); 2]>, StudyError> {
    if !scene.output.root_stress {
        return Ok(None);
    }
    let largest = |gear: usize| {
        let at = At { gear, pair: 0 };
        let stress = rows.series(&ROOT_TENSION.name_at(at))?.iter();
        let all = stress.zip(rows.series(&ROOT_ERROR.name_at(at))?);
        // NaN where coast flanks press.
        let known = all.filter(|(stress, _)| !stress.is_nan()).map(|(stress, error)| (*stress, *error));
        Ok(known.reduce(|best, now| if now.0 > best.0 { now } else { best }).unwrap_or((f64::NAN, f64::NAN)))
    };
    Ok(Some([largest(0)?, largest(1)?]))
}

/// Where the pressure is largest in any row.
fn hardest(rows: &Columns) -> Result<Option<PressurePlace>, StudyError> {
    let pressure = rows.series(MAX_PRESSURE.name)?;
    let hardest = (0..pressure.len()).reduce(|best, i| if pressure[i] > pressure[best] { i } else { best });
    let Some(row) = hardest else { return Ok(None) };
    let at = |column: Column<MotionRows>| rows.series(column.name).map(|all| all[row]);
    let place = [at(PRESSURE_PLACE)?, at(PRESSURE_Z)?, at(PRESSURE_DIAMETER)?];
    Ok(PressurePlace::of_row(place, at(PINION_ANGLE)?, at(MESH_PHASE)?))
}

fn certificate(done: &Finished) -> MotionCertificate {
    let motion = &done.motion;
    let (counts, extremes, changes) = (motion.counts(), motion.system().extremes(), motion.system().changes());
    let ledger = motion.ledger().copied().unwrap_or_default();
    let settled = done.course.periodicity;
    MotionCertificate {
        ledger_residual_mj: ledger.residual(),
        work_through_pair_mj: counts.throughput,
        ledger_residual_over_work: ledger.residual() / counts.throughput.max(f64::MIN_POSITIVE),
        ledger_residual_over_turnover: ledger.relative_residual(),
        least_contact_force_n: extremes.least_force,
        force_jump_at_tooth_change_n: changes.jump,
        period_cycles: settled.map(|p| p.period),
        periodicity: settled.map(|p| p.residual),
        shooting_multiplier: done.shot.as_ref().map(|s| s.multiplier),
        shooting_periods: done.shot.as_ref().map(|s| s.periods),
        warm_up_cycles: motion.cycle() - done.course.recorded,
        contact_losses: counts.losses,
        steps_without_contact: extremes.steps_apart,
        largest_gap_um: 1e3 * extremes.largest_gap,
        coast_contacts: counts.coast_contacts,
        steps: counts.steps,
        refused_steps: counts.refused,
    }
}
