//! Writes the files of an optimisation.

use analysis::optimum::Optimum;
use serde_json::json;

use super::{OptimumResult, page, tables};
use crate::{ReportError, folder::ResultDirectory};

/// Writes them all; what comes back is the closing table.
///
/// # Errors
/// When the system refuses.
pub fn write_optimum(of: OptimumResult<'_>, results: &ResultDirectory) -> Result<String, ReportError> {
    let OptimumResult { optimum, told, scene, goals, cost, warnings, .. } = of;
    let plan = &optimum.plan;
    results.write("optimum.toml", scene.to_toml().as_bytes())?;
    results.write("steps.csv", tables::steps_csv(&of).as_bytes())?;
    results.write("harris.csv", tables::harris_csv(&of).as_bytes())?;
    results.write("influences.csv", tables::influences_csv(&of).as_bytes())?;
    if !optimum.front.is_empty() {
        results.write("front.csv", tables::front_csv(&of).as_bytes())?;
    }
    page::page(&of)?.write(results)?;
    let summary = json!({
        "program": "ale-gear",
        "version": env!("CARGO_PKG_VERSION"),
        "name": plan.name,
        "scene": plan.scene_file,
        "goal": plan.goal,
        "headline": {
            "goal_start_um": goals.start_um,
            "goal_found_um": goals.found_um,
            "goal_optimum_um": goals.optimum_um,
            "evaluations": optimum.found.steps.len(),
            "stop": optimum.found.stop,
            "over_limits": optimum.evaluation.over_limits(),
            "torques": told.torques,
            "parameters": told.influences,
            "samples": plan.samples(),
        },
        "cost": cost,
        "warnings": warnings,
        "files": results.files()?,
    });
    // Strings and numbers only, all keys are strings: there is nothing that JSON could refuse.
    let text = serde_json::to_string_pretty(&summary).unwrap_or_default() + "\n";
    results.write("summary.json", text.as_bytes())?;
    Ok(tables::closing_table(&of))
}

/// What a user should hear of an optimum.
pub fn optimum_warnings(optimum: &Optimum) -> Vec<String> {
    passed_limits(optimum).into_iter().collect()
}

/// Which limits the optimum passes, and by how much; `None` where it holds them.
pub fn passed_limits(optimum: &Optimum) -> Option<String> {
    let over = optimum.evaluation.over_limits();
    let limits = [(optimum.plan.max_pressure_mpa, ""), (optimum.plan.max_edge_pressure_mpa, " at edges")];
    let limits: Vec<String> =
        limits.iter().filter_map(|(limit, place)| Some(format!("{} MPa{place}", (*limit)?))).collect();
    // Twice a limit and more is a multiple of it.
    let by =
        if over < 1.0 { format!("passed by {:.1} %", 100.0 * over) } else { format!("passed {:.1}-fold", 1.0 + over) };
    let limits = limits.join(" and ");
    (over > HELD).then(|| format!("the limit of the pressure, {limits}, is {by}: no design was found that holds it"))
}

/// Share by which a limit may be passed.
const HELD: f64 = 2e-3;
