//! All files of a run of a cheaper model, and of a sweep, but the summary and what is made of files.

use analysis::{
    lumped::{BifurcationAnalysis, LumpedResult, SweepOptions},
    motion::speed,
};
use scene::Scene;

use super::{
    BIFURCATION_FILE, LumpedPictures, SECTION_FILE, SWEEP_FILE, SweepPage, bifurcation_csv, bifurcation_picture,
    lumped_campbell_csv, sweep_csv, write_lumped_report, write_lumped_sweep_report,
};
use crate::{
    Cost, ReportError, ResultFiles,
    columns::{energy_columns, lumped_columns},
    columns_to_csv,
    motion_files::{CAMPBELL_FILE, CYCLES_FILE, MotionPictures, SPECTRUM_FILE, cycles_csv, spectrum_csv},
};

/// Rows, section, ledger, spectra, frequencies over speed, and page.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_lumped(
    scene: &Scene,
    result: &LumpedResult,
    cost: &Cost,
    files: &dyn ResultFiles,
) -> Result<(), ReportError> {
    let LumpedResult { facts, spectrum, passage, campbell, headline, warnings, .. } = result;
    let (rows, section) = (lumped_columns(scene, &result.rows), lumped_columns(scene, result.section()));
    let energy = energy_columns(&result.energy);
    let of_model = [
        (CAMPBELL_FILE, campbell.as_ref().map(lumped_campbell_csv)),
        (CYCLES_FILE, passage.as_ref().map(cycles_csv)),
        ("history.csv", Some(columns_to_csv(&rows))),
        ("energy.csv", Some(columns_to_csv(&energy))),
        (SECTION_FILE, Some(columns_to_csv(&section))),
        (SPECTRUM_FILE, Some(spectrum_csv(spectrum))),
    ];
    for (name, text) in of_model {
        text.map_or(Ok(()), |text| files.write(name, text.as_bytes()))?;
    }
    let static_errors: Option<Vec<f64>> = result.static_cycle.as_ref().map(|all| all.iter().map(|p| p.error).collect());
    let motion = MotionPictures {
        rows: &rows,
        energy: &energy,
        spectrum: Some(spectrum),
        waterfall: &[],
        ramp: passage.as_ref().map(|p| (speed(scene), scene.driver_teeth(), p)),
        campbell: None,
        per_cycle: headline.rows_per_cycle as usize,
        quasi_static: static_errors.as_deref(),
        view: None,
    };
    let pictures = LumpedPictures { motion, section: &section, campbell: campbell.as_ref() };
    write_lumped_report(scene, facts, cost, headline, &pictures, warnings)?.write(files)
}

/// Points of a sweep, bifurcation diagram, and page.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_key_sweep(
    options: &SweepOptions,
    found: &BifurcationAnalysis,
    page: &SweepPage<'_>,
    cost: &Cost,
    files: &dyn ResultFiles,
) -> Result<(), ReportError> {
    let BifurcationAnalysis { scene, facts, points, warnings, .. } = found;
    files.write(SWEEP_FILE, sweep_csv(options, points).as_bytes())?;
    files.write(BIFURCATION_FILE, bifurcation_csv(options, points).as_bytes())?;
    if let Some(picture) = bifurcation_picture(&options.key, &options.quantity.name, points) {
        files.write("bifurcation.svg", picture.as_bytes())?;
    }
    write_lumped_sweep_report(scene, facts, cost, page, points, warnings)?.write(files)
}
