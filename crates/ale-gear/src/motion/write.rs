//! Files of a result.

use analysis::motion::{CampbellDiagram, MotionSpectrum, Passage, waterfall};
use dynamics::SweepOutcome;
use report::{
    columns::motion_history::{PINION_SPEED, WHEEL_SPEED},
    motion_files::{
        CAMPBELL_FILE, CYCLES_FILE, ORDER_CUTS_FILE, SPECTRUM_FILE, WATERFALL_FILE, campbell_csv, cycles_csv,
        motion_series, order_cuts_csv, spectrum_csv, waterfall_csv,
    },
};
use study::{StudyError, Window};

use super::{
    MotionHeadline,
    course::Finished,
    doubts,
    elasticity::{Vibration, mesh_range_hz},
    headline,
    prepare::Prepared,
    price::{Asked, Pace},
    read_columns, rows, speed, sweep,
};
use crate::{
    certificate::Written,
    error::CommandError,
    facts::{Cost, Facts},
    output::{
        MotionPictures, ResultDirectory, SweepPictures, motion_table, root_stress_warnings, sweep_table,
        write_columnar, write_motion_report, write_patterns, write_summary, write_sweep_report,
    },
    phases::Phases,
    scene::{Driver, MotionScene, Scene, SweepScene},
};

pub(super) fn no_statistics(e: StudyError) -> CommandError {
    CommandError::failed(&e, e.hint())
}

/// All files of a motion.
pub(super) fn write_motion(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    prepared: &Prepared,
    done: &Finished,
) -> Result<Written, CommandError> {
    let rows = read_columns(&results.path(rows::HISTORY))?;
    let per_cycle = words.steps_per_mesh_cycle as usize;
    let teeth = scene.driver_teeth();
    let series = motion_series(&rows).map_err(no_statistics)?;
    let mut lines = Vec::new();
    let mut over_speed = None;
    if let Some(ramp) = words.ramp {
        lines =
            waterfall(&series, per_cycle, ramp.waterfall_cycles as usize, scene.pinion.teeth).map_err(no_statistics)?;
        let (law, force) = (speed(scene), prepared.quasi_static.normal_force);
        over_speed = Some(Passage::of(&series, per_cycle, (law, teeth), force, &lines).map_err(no_statistics)?);
    }
    let mut headline =
        headline::headline(scene, words, prepared, done, &rows, over_speed.as_ref()).map_err(no_statistics)?;
    let facts =
        Facts { certificate: prepared.facts.certificate.clone().and(headline.checks()), ..prepared.facts.clone() };
    let mut warnings = prepared.warnings.clone();
    warnings.extend(doubts::of_motion(words, prepared, &headline));
    let driver = usize::from(scene.operation.driver == Driver::Wheel);
    let driver_rpm = rows.series([PINION_SPEED, WHEEL_SPEED][driver].name).map_err(no_statistics)?;
    let mesh_hz = mesh_range_hz(scene, words, Some(driver_rpm));
    let vibration = Vibration {
        mesh_hz,
        resonance: prepared.system.mesh_resonance(),
        peak_to_peak_um: headline.peak_to_peak_dte_um,
    };
    let cycles = (headline.cycles + headline.certificate.warm_up_cycles) as f64;
    let asked = Asked::new(scene, words, cycles, mesh_hz);
    let pace = pace(phases, &["settle", "solve"], headline.certificate.steps as f64);
    warnings.extend(prepared.elasticity.warning(&vibration, &asked, pace));
    warnings.extend(headline.root_tensions().into_iter().flat_map(root_stress_warnings));
    let (mut spectrum, mut campbell) = (None, None);
    match &over_speed {
        Some(passage) => {
            results.write(WATERFALL_FILE, waterfall_csv(&lines, per_cycle).as_bytes())?;
            results.write(CYCLES_FILE, cycles_csv(passage).as_bytes())?;
            results.write(ORDER_CUTS_FILE, order_cuts_csv(passage).as_bytes())?;
            let of = campbell_diagram(prepared, teeth, mesh_hz[1])?;
            results.write(CAMPBELL_FILE, campbell_csv(&of).as_bytes())?;
            headline.critical_speeds = of.critical_speeds();
            campbell = Some(of);
        }
        None => {
            let window = window(words, &headline);
            let of = MotionSpectrum::of(&series, headline.cycles, headline.mesh_frequency_hz, window)
                .map_err(no_statistics)?;
            results.write(SPECTRUM_FILE, spectrum_csv(&of).as_bytes())?;
            spectrum = Some(of);
        }
    }
    let energy = read_columns(&results.path(rows::ENERGY_FILE))?;
    let cost = Cost::of(phases);
    let pictures = MotionPictures {
        rows: &rows,
        energy: &energy,
        spectrum: spectrum.as_ref(),
        waterfall: &lines,
        ramp: over_speed.as_ref().map(|passage| (speed(scene), teeth, passage)),
        campbell: campbell.as_ref(),
        per_cycle,
        quasi_static: Some(&prepared.quasi_static.transmission_error),
        view: prepared.view.as_ref(),
    };
    let pattern = write_patterns(scene, &done.patterns, results)?;
    let report = write_motion_report(scene, &facts, &cost, &headline, &pictures, pattern, &warnings)?;
    report.write(results)?;
    write_columnar(scene, results)?;
    let files = results.files()?;
    let summary = write_summary(scene, &facts, &cost, &headline, &warnings, &files);
    results.write("summary.json", summary.as_bytes())?;
    let table = motion_table(scene, &facts, &cost, &headline, &warnings);
    Ok(Written { table, verdict: facts.certificate.verdict(scene).map_err(CommandError::from) })
}

/// Mesh orders through the mesh resonance and the gears' elastic frequencies, those with the bores held, at rest.
fn campbell_diagram(prepared: &Prepared, teeth: u32, highest_mesh_hz: f64) -> Result<CampbellDiagram, CommandError> {
    let resonance = (prepared.system.mesh_resonance_hz(), "mesh resonance".to_owned());
    let all = std::iter::once(resonance).chain(prepared.elasticity.frequencies_hz());
    CampbellDiagram::of(all, teeth, highest_mesh_hz).map_err(no_statistics)
}

/// Wall time of a step in these phases, as far as they took so many.
fn pace(phases: &Phases, names: &[&str], steps: f64) -> Pace {
    let wall: f64 = phases.rows().iter().filter(|p| names.contains(&p.name.as_str())).map(|p| p.wall_s).sum();
    Pace { step_s: (steps > 0.0 && wall > 0.0).then(|| wall / steps) }
}

/// None for a record that repeats itself, where every line stands in one bin.
fn window(words: &MotionScene, headline: &MotionHeadline) -> Window {
    let tolerance = words.periodic_tolerance.unwrap_or(1e-6);
    let whole = headline.certificate.period_cycles.is_some_and(|p| headline.cycles.is_multiple_of(p as u64));
    let periodic = headline.certificate.periodicity.is_some_and(|r| r <= 10.0 * tolerance);
    if periodic && whole { Window::Rectangular } else { Window::Hann }
}

/// All files of a sweep; the text is the closing table.
pub(super) fn write_sweep(
    scene: &Scene,
    words: (&MotionScene, &SweepScene),
    phases: &mut Phases,
    results: &ResultDirectory,
    prepared: &Prepared,
    outcomes: &[SweepOutcome],
) -> Result<Written, CommandError> {
    let rows = sweep::rows(scene, words.0, &prepared.quasi_static, outcomes);
    let teeth = scene.driver_teeth();
    let mesh_hz = mesh_range_hz(scene, words.0, None);
    let campbell = campbell_diagram(prepared, teeth, mesh_hz[1])?;
    let resonance = prepared.system.mesh_resonance();
    let vibration = Vibration { mesh_hz, resonance, peak_to_peak_um: sweep::largest(&rows) };
    let headline = sweep::headline(words, prepared, (&rows, &vibration), campbell.critical_speeds(), teeth);
    let mut warnings = prepared.warnings.clone();
    let waited: u64 = rows.iter().map(|r| r.warm_up_cycles + u64::from(scene.analysis.cycles)).sum();
    let cycles = waited as f64 / rows.len().max(1) as f64;
    // Steps are as long as rows ask for, or the resonance, at the mean speed.
    let own_steps = f64::from(words.0.steps_per_mesh_cycle)
        .max(f64::from(words.0.steps_per_resonance) * headline.mesh_resonance_hz / (0.5 * (mesh_hz[0] + mesh_hz[1])));
    let pace = pace(phases, &["sweep"], waited as f64 * own_steps);
    warnings.extend(prepared.elasticity.warning(&vibration, &Asked::new(scene, words.0, cycles, mesh_hz), pace));
    warnings.extend(doubts::of_sweep(&headline, rows.len()));
    results.write("resonance.csv", sweep::write(&rows).as_bytes())?;
    results.write(CAMPBELL_FILE, campbell_csv(&campbell).as_bytes())?;
    let cost = Cost::of(phases);
    let pictures = SweepPictures { rows: &rows, campbell: &campbell, teeth, view: prepared.view.as_ref() };
    let report = write_sweep_report(scene, &prepared.facts, &cost, &headline, pictures, &warnings)?;
    report.write(results)?;
    let files = results.files()?;
    let summary = write_summary(scene, &prepared.facts, &cost, &headline, &warnings, &files);
    results.write("summary.json", summary.as_bytes())?;
    let table = sweep_table(scene, &prepared.facts, &cost, &headline, &warnings);
    let verdict = prepared
        .facts
        .certificate
        .verdict(scene)
        .map_err(CommandError::from)
        .and_then(|()| sweep::verdict(scene, &rows));
    Ok(Written { table, verdict })
}
