//! Runs of cheaper models, and their files.

use analysis::lumped::{BifurcationAnalysis, KeySweep, LumpedAnalysis, LumpedResult, NoLumpedSink, SweepOptions};
use report::{
    columns::{energy_columns, lumped_columns, lumped_history::DTE, lumped_quantity},
    columns_to_csv,
    lumped_files::{
        BIFURCATION_FILE, SECTION_FILE, SWEEP_FILE, SweepPage, bifurcation_csv, lumped_campbell_csv, sweep_csv,
    },
    motion_files::{CAMPBELL_FILE, CYCLES_FILE, SPECTRUM_FILE, cycles_csv, spectrum_csv},
};

use crate::{
    cache::Cache,
    certificate::Written,
    error::CommandError,
    facts::Cost,
    motion::{ENERGY_FILE, HISTORY, speed},
    output::{
        LumpedPictures, MotionPictures, ResultDirectory, bifurcation_picture, lumped_sweep_table, lumped_table,
        write_columnar, write_lumped_report, write_lumped_sweep_report, write_summary,
    },
    phases::Phases,
    scene::{MotionScene, Scene},
};

/// Runs the model of a scene and writes all files of the result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    motion: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Written, CommandError> {
    if let Some(speeds) = &motion.sweep {
        let dte = quantity(scene, DTE.name)?;
        let (scenes, options) = SweepOptions::over_speed(scene, speeds, dte);
        let table = sweep_key(&scenes, &options, None, phases, results, cache)?;
        return Ok(Written { table, verdict: Ok(()) });
    }
    let result = LumpedAnalysis::new(scene).with_cache(cache).solve_into(phases, &mut NoLumpedSink)?;
    let table = write(scene, motion, &result, phases, results)?;
    Ok(Written { table, verdict: result.certificate().verdict(scene).map_err(CommandError::from) })
}

/// The column of that name of a scene's rows.
///
/// # Errors
/// Exit status 2 for a column that the model does not write.
pub(crate) fn quantity(scene: &Scene, name: &str) -> Result<analysis::lumped::LumpedQuantity, CommandError> {
    lumped_quantity(scene, name).ok_or_else(|| {
        let whose = format!("{}: the model writes no column `{name}`", scene.file.display());
        let names = report::columns::LumpedLayout::of(scene).sheet().names();
        CommandError::input(whose, Some(format!("it writes {}", names.join(", "))))
    })
}

/// All files of a run; the text is the closing table.
fn write(
    scene: &Scene,
    motion: &MotionScene,
    result: &LumpedResult,
    phases: &Phases,
    results: &ResultDirectory,
) -> Result<String, CommandError> {
    let LumpedResult { facts, spectrum, passage, campbell, headline, warnings, .. } = result;
    let (rows, section) = (lumped_columns(scene, &result.rows), lumped_columns(scene, result.section()));
    let energy = energy_columns(&result.energy);
    let of_model = [
        (CAMPBELL_FILE, campbell.as_ref().map(lumped_campbell_csv)),
        (CYCLES_FILE, passage.as_ref().map(cycles_csv)),
        (HISTORY, Some(columns_to_csv(&rows))),
        (ENERGY_FILE, Some(columns_to_csv(&energy))),
        (SECTION_FILE, Some(columns_to_csv(&section))),
        (SPECTRUM_FILE, Some(spectrum_csv(spectrum))),
    ];
    for (name, text) in of_model {
        text.map_or(Ok(()), |text| results.write(name, text.as_bytes()))?;
    }
    let cost = Cost::of(phases);
    let static_errors: Option<Vec<f64>> = result.static_cycle.as_ref().map(|all| all.iter().map(|p| p.error).collect());
    let pictures = MotionPictures {
        rows: &rows,
        energy: &energy,
        spectrum: Some(spectrum),
        waterfall: &[],
        ramp: passage.as_ref().map(|p| (speed(scene), scene.driver_teeth(), p)),
        campbell: None,
        per_cycle: motion.steps_per_mesh_cycle as usize,
        quasi_static: static_errors.as_deref(),
        view: None,
    };
    let drawn = LumpedPictures { motion: pictures, section: &section, campbell: campbell.as_ref() };
    write_lumped_report(scene, facts, &cost, headline, &drawn, warnings)?.write(results)?;
    write_columnar(scene, results)?;
    let files = results.files()?;
    let summary = write_summary(scene, facts, &cost, headline, warnings, &files);
    results.write("summary.json", summary.as_bytes())?;
    Ok(lumped_table(scene, facts, &cost, headline, warnings))
}

/// Runs the model of a scene at each value, way by way; writes all files of the result, the text is the closing table.
///
/// `scenes` in ascending order of the value; `again`: words of `ale-gear sweep` that make it again.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out at any value: one value without a motion has its reason in its row.
pub(crate) fn sweep_key(
    scenes: &[(f64, Scene)],
    options: &SweepOptions,
    again: Option<&str>,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<String, CommandError> {
    let found = KeySweep::new(scenes, options).with_cache(cache).solve_with(phases)?;
    let BifurcationAnalysis { scene, facts, points, headline, warnings } = &found;
    results.write(SWEEP_FILE, sweep_csv(options, points).as_bytes())?;
    results.write(BIFURCATION_FILE, bifurcation_csv(options, points).as_bytes())?;
    if let Some(picture) = bifurcation_picture(&options.key, &options.quantity.name, points) {
        results.write("bifurcation.svg", picture.as_bytes())?;
    }
    let cost = Cost::of(phases);
    let page = SweepPage { headline, again };
    write_lumped_sweep_report(scene, facts, &cost, &page, points, warnings)?.write(results)?;
    let files = results.files()?;
    results.write("summary.json", write_summary(scene, facts, &cost, &page, warnings, &files).as_bytes())?;
    Ok(lumped_sweep_table(scene, facts, &cost, headline, warnings))
}
