//! Files of a result.

use dynamics::pair_motion::SweepPoint;
use study::{StudyError, Window};

use super::{Columns, MotionHeadline, course::Finished, doubts, headline, prepare::Prepared, rows, spectra, sweep};
use crate::{
    error::CommandError,
    facts::Cost,
    output::{
        MotionPictures, ResultDirectory, motion_table, root_stress_warnings, sweep_table, write_columnar,
        write_motion_report, write_patterns, write_summary, write_sweep_report,
    },
    phases::Phases,
    scene::{MotionScene, Scene, SweepScene},
};

pub(super) fn no_statistics(e: StudyError) -> CommandError {
    CommandError::failed(&e, e.hint())
}

/// All files of a motion; the text is the closing table.
pub(super) fn write_motion(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    prepared: &Prepared,
    done: &Finished,
) -> Result<String, CommandError> {
    let rows = Columns::read(&results.path(rows::HISTORY))?;
    let headline = headline::headline(scene, words, prepared, done, &rows).map_err(no_statistics)?;
    let mut warnings = prepared.warnings.clone();
    warnings.extend(doubts::of_motion(words, prepared, &headline));
    warnings.extend(prepared.elasticity.warning(headline.elasticity.highest_mesh_frequency_hz));
    warnings.extend(headline.root_tensions().into_iter().flat_map(root_stress_warnings));
    let (mut spectrum, mut waterfall) = (None, Vec::new());
    let per_cycle = words.steps_per_mesh_cycle as usize;
    match words.ramp {
        Some(ramp) => {
            waterfall = spectra::waterfall(&rows, per_cycle, ramp.waterfall_cycles as usize, scene.pinion.teeth)
                .map_err(no_statistics)?;
            results.write("waterfall.csv", spectra::write_waterfall(&waterfall, per_cycle).as_bytes())?;
        }
        None => {
            let window = window(words, &headline);
            let of =
                spectra::spectrum(&rows, headline.cycles, headline.mesh_frequency_hz, window).map_err(no_statistics)?;
            results.write("spectrum.csv", spectra::write_spectrum(&of).as_bytes())?;
            spectrum = Some(of);
        }
    }
    let energy = Columns::read(&results.path(rows::ENERGY_FILE))?;
    let cost = Cost::of(phases);
    let pictures = MotionPictures {
        rows: &rows,
        energy: &energy,
        spectrum: spectrum.as_ref(),
        waterfall: &waterfall,
        per_cycle,
        quasi_static: Some(&prepared.quasi_static.transmission_error),
        view: prepared.view.as_ref(),
    };
    let pattern = write_patterns(scene, &done.patterns, results)?;
    let report = write_motion_report(scene, &prepared.facts, &cost, &headline, &pictures, pattern, &warnings)?;
    report.write(results)?;
    write_columnar(scene, results)?;
    let files = results.files()?;
    let summary = write_summary(scene, &prepared.facts, &cost, &headline, &warnings, &files);
    results.write("summary.json", summary.as_bytes())?;
    Ok(motion_table(scene, &prepared.facts, &cost, &headline, &warnings))
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
    points: &[SweepPoint],
) -> Result<String, CommandError> {
    let rows = sweep::rows(scene, &prepared.quasi_static, points).map_err(no_statistics)?;
    let driver = [scene.pinion.teeth, scene.wheel.teeth][1 - prepared.system.options().contact.driven()];
    let headline = sweep::headline(scene, words, prepared, &rows, driver);
    let mut warnings = prepared.warnings.clone();
    warnings.extend(prepared.elasticity.warning(headline.elasticity.highest_mesh_frequency_hz));
    warnings.extend(doubts::of_sweep(&headline, rows.len()));
    results.write("resonance.csv", sweep::write(&rows).as_bytes())?;
    let cost = Cost::of(phases);
    let report =
        write_sweep_report(scene, &prepared.facts, &cost, &headline, (&rows, prepared.view.as_ref()), &warnings)?;
    report.write(results)?;
    let files = results.files()?;
    let summary = write_summary(scene, &prepared.facts, &cost, &headline, &warnings, &files);
    results.write("summary.json", summary.as_bytes())?;
    Ok(sweep_table(scene, &prepared.facts, &cost, &headline, &warnings))
}
