//! All files of a motion or a sweep but its rows, its summary and what is made of files.

use analysis::motion::{MotionResult, RampResult, SweepResult, speed};
use scene::Scene;

use super::{
    CAMPBELL_FILE, CYCLES_FILE, MotionPictures, ORDER_CUTS_FILE, RESONANCE_FILE, SPECTRUM_FILE, SweepPictures,
    WATERFALL_FILE, campbell_csv, cycles_csv, order_cuts_csv, resonance_csv, spectrum_csv, waterfall_csv,
};
use crate::{
    Cost, ReportError, ResultFiles,
    columns::{ENERGY, MOTION_HISTORY},
    contact_files::write_patterns,
    page::{write_motion_report, write_sweep_report},
    view::View,
};

/// Spectra or what a ramp shows over speed, contact pattern and page; `view`: the gears in space.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_motion(
    scene: &Scene,
    result: &MotionResult,
    cost: &Cost,
    view: Option<&View>,
    files: &dyn ResultFiles,
) -> Result<(), ReportError> {
    let per_cycle = result.headline.rows_per_cycle as usize;
    let MotionResult { rows, layout, headline, spectrum, ramp, patterns, facts, warnings, .. } = result;
    if let Some(ramp) = ramp {
        write_ramp(ramp, per_cycle, files)?;
    }
    if let Some(spectrum) = spectrum {
        files.write(SPECTRUM_FILE, spectrum_csv(spectrum).as_bytes())?;
    }
    let pairs: Vec<i64> = layout.pairs().collect();
    let history = MOTION_HISTORY.sheet(layout, &pairs).columns(layout, rows);
    let energy = ENERGY.sheet(&(), &[]).columns(&(), rows.iter().map(|r| &r.energy));
    let pictures = MotionPictures {
        rows: &history,
        energy: &energy,
        spectrum: spectrum.as_ref(),
        waterfall: ramp.as_ref().map_or(&[], |r| &r.waterfall),
        ramp: ramp.as_ref().map(|r| (speed(scene), scene.driver_teeth(), &r.passage)),
        campbell: ramp.as_ref().map(|r| &r.campbell),
        per_cycle,
        quasi_static: Some(&result.quasi_static.transmission_error),
        view,
    };
    let pattern = write_patterns(scene, patterns, files)?;
    write_motion_report(scene, facts, cost, headline, &pictures, pattern, warnings)?.write(files)
}

/// What a run-up or run-down shows over speed.
fn write_ramp(ramp: &RampResult, per_cycle: usize, files: &dyn ResultFiles) -> Result<(), ReportError> {
    files.write(WATERFALL_FILE, waterfall_csv(&ramp.waterfall, per_cycle).as_bytes())?;
    files.write(CYCLES_FILE, cycles_csv(&ramp.passage).as_bytes())?;
    files.write(ORDER_CUTS_FILE, order_cuts_csv(&ramp.passage).as_bytes())?;
    files.write(CAMPBELL_FILE, campbell_csv(&ramp.campbell).as_bytes())
}

/// Answers over speed, frequencies over speed, and page; `view`: the gears in space.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_sweep(
    scene: &Scene,
    result: &SweepResult,
    cost: &Cost,
    view: Option<&View>,
    files: &dyn ResultFiles,
) -> Result<(), ReportError> {
    let SweepResult { rows, headline, campbell, facts, warnings, .. } = result;
    files.write(RESONANCE_FILE, resonance_csv(rows).as_bytes())?;
    files.write(CAMPBELL_FILE, campbell_csv(campbell).as_bytes())?;
    let pictures = SweepPictures { rows, campbell, teeth: scene.driver_teeth(), view };
    write_sweep_report(scene, facts, cost, headline, pictures, warnings)?.write(files)
}
