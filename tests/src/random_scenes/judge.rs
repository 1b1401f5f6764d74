//! What must hold of the files of a result, found from these files alone.

use std::path::Path;

use serde_json::Value as Json;

use super::{
    Csv,
    balance::{equilibrium, ledger, pull, torque},
    case::Case,
};

/// Tables of runs that have no history.
const TABLES: [&str; 5] = ["resonance.csv", "sweep.csv", "branch.csv", "basins.csv", "attractors.csv"];

/// Figures of a headline that have no value in some results: not asked for, of another model, or where nothing is to be
/// measured (`docs/outputs.md`).
const MAY_BE_NULL: [&str; 34] = [
    ".least_scuffing_safety",
    ".mesh_loss_w",
    ".median_95",
    ".quantile_10_95",
    ".quantile_90_95",
    ".attractors.period_cycles",
    ".certificate.lyapunov",
    ".difference_in_time",
    ".broken",
    ".root_stress",
    ".max_root_tension_mpa",
    ".max_root_tension_estimated_error_percent",
    ".max_pressure_at",
    ".tooth_change",
    ".ramp",
    ".kept_modes",
    ".highest_frequency_hz",
    ".max_coast_normal_force_n",
    ".mean_pinion_speed_rpm",
    ".mean_wheel_speed_rpm",
    ".least_slice_force_n",
    ".chaotic",
    ".hysteresis",
    ".again",
    ".largest.lyapunov",
    ".largest.period",
    ".largest.periodicity",
    ".certificate.periodicity",
    ".certificate.period_cycles",
    ".certificate.shooting_periods",
    ".certificate.shooting_multiplier",
    ".certificate.step_error_percent",
    ".mesh_resonance_hz",
    ".ramp.pair_normal_force_n",
];

/// Figures that lumped models fed by a number of their own have no value of, and a pair without a load.
const OF_A_LOADED_MESH: [&str; 2] = [".mean_mesh_stiffness_n_per_um", ".mean_contact_line_length_mm"];

/// Columns that have no value where the motion does not come back or was not asked, or where a start has no motion.
const MAY_BE_NAN: [&str; 7] = [
    "period_cycles",
    "section_period",
    "lyapunov_per_s",
    "lyapunov_error_per_s",
    "periodicity",
    "attractor",
    "warm_up_cycles",
];

/// What was found.
#[derive(Debug, Default)]
pub struct Judged {
    /// Warnings of the result.
    pub remarks: usize,
    /// What does not hold.
    pub wrong: Vec<String>,
}

/// Judges a folder of results.
pub fn judge(folder: &Path) -> Judged {
    let mut judged = Judged::default();
    let summary: Json = match std::fs::read(folder.join("summary.json")).map(|bytes| serde_json::from_slice(&bytes)) {
        Ok(Ok(summary)) => summary,
        other => {
            judged.wrong.push(format!("summary.json cannot be read: {other:?}"));
            return judged;
        }
    };
    judged.remarks = summary["remarks"].as_array().map_or(0, Vec::len);
    if summary["certificate"] == "failed" {
        // Exit status 1, with the reason: it is counted there.
        return judged;
    }
    for name in summary["files"].as_array().into_iter().flatten().filter_map(Json::as_str) {
        if !folder.join(name).exists() {
            judged.wrong.push(format!("{name} is in `files`, and not there"));
        }
    }
    judged.wrong.extend(headline(&summary));
    match summary["kind"].as_str() {
        Some("plan") => {
            judged.wrong.extend(cases(folder, &summary));
            return judged;
        }
        Some("gearbox") if folder.join("positions.csv").exists() => {
            judged.wrong.extend(gearbox(folder, &summary));
            return judged;
        }
        _ => {}
    }
    let Ok(history) = Csv::read(&folder.join("history.csv")) else {
        if !TABLES.iter().any(|name| folder.join(name).exists()) {
            judged.wrong.push("there is neither history.csv nor rows of a sweep, a branch or basins".into());
        }
        judged.wrong.extend(sweep(folder));
        return judged;
    };
    let case = Case { inputs: &summary["inputs"], summary: &summary, history: &history };
    judged.wrong.extend(no_numbers(&case));
    judged.wrong.extend(rows(&case));
    judged.wrong.extend(equilibrium(&case));
    judged.wrong.extend(pull(&case));
    if case.is_static() {
        judged.wrong.extend(torque(&case));
    } else if let Ok(energy) = Csv::read(&folder.join("energy.csv")) {
        judged.wrong.extend(ledger(&case, &energy));
    } else {
        judged.wrong.push("energy.csv is not there".into());
    }
    judged
}

/// Forces of bearings that hold shafts of a gearbox in its housing sum to zero, over the largest.
const BALANCE: f64 = 1e-6;

/// Positions of a gearbox are numbers, and the forces of the bearings balance each other where nothing else holds it.
fn gearbox(folder: &Path, summary: &Json) -> Vec<String> {
    let Ok(positions) = Csv::read(&folder.join("positions.csv")) else {
        return vec!["positions.csv cannot be read".into()];
    };
    let mut wrong = Vec::new();
    for name in &positions.names {
        let Some(column) = positions.column(name) else { continue };
        if let Some(row) = column.iter().position(|value| !value.is_finite()) {
            wrong.push(format!("positions.csv: {name} is {} in row {row}", column[row]));
        }
    }
    // Planets turn with their carrier: their bearings stand on shafts, and columns are in the carrier's frame.
    let has_planets = summary["planets"].as_array().is_some_and(|planets| !planets.is_empty());
    let document = std::fs::read_to_string(folder.join("../scene.toml")).unwrap_or_default();
    let bearings = summary["bearings"].as_array().map_or(&[][..], Vec::as_slice);
    // Nor does a bearing between two shafts stand in the ground.
    if has_planets || document.contains("in_shaft") {
        return wrong;
    }
    let forces: Vec<Vec<[f64; 3]>> =
        (1..).map_while(|bearing| positions.vectors(&format!("bearing_{bearing}_force"), "n")).collect();
    if forces.len() < bearings.len() {
        wrong.push(format!("positions.csv: forces of {} bearings, there are {}", forces.len(), bearings.len()));
    }
    for row in 0..positions.rows.len() {
        let sum = [0, 1, 2].map(|i| forces.iter().map(|force| force[row][i]).sum::<f64>());
        let largest = forces.iter().flat_map(|force| force[row]).fold(0.0f64, |most, f| most.max(f.abs()));
        if sum.iter().any(|s| s.abs() > BALANCE * largest) {
            wrong.push(format!(
                "positions.csv, row {row}: forces of the bearings sum to {sum:?} N, the largest is {largest}"
            ));
            break;
        }
    }
    wrong
}

/// A case has all its numbers or a reason why not, and the headline counts them.
fn cases(folder: &Path, summary: &Json) -> Vec<String> {
    let Ok(cases) = Csv::read(&folder.join("cases.csv")) else { return vec!["cases.csv cannot be read".into()] };
    let mut wrong = swept(folder, "cases.csv");
    let at = |name: &str| cases.names.iter().position(|n| n == name);
    let (Some(status), Some(reason)) = (at("status"), at("reason")) else {
        return vec!["cases.csv has no status or no reason".into()];
    };
    let failed = cases.rows.iter().filter(|row| row[status] == "failed");
    if let Some(row) = failed.clone().find(|row| row.get(reason).is_none_or(String::is_empty)) {
        wrong.push(format!("case {} failed, and nobody says why", row[0]));
    }
    for (key, count) in [("cases", cases.rows.len()), ("failed", failed.count())] {
        if summary["headline"][key].as_u64() != Some(count as u64) {
            wrong.push(format!("headline: {key} is {}, in cases.csv {count}", summary["headline"][key]));
        }
    }
    wrong
}

/// As many rows as were asked for, in the order of time.
fn rows(case: &Case<'_>) -> Vec<String> {
    let mut wrong = Vec::new();
    if let Some(time) = case.history.column("time_s")
        && time.windows(2).any(|w| w[1] <= w[0])
    {
        wrong.push("time_s does not grow from row to row".into());
    }
    let analysis = &case.inputs["analysis"];
    let wanted = |of: &Json| Some(of.as_u64()? * analysis["cycles"].as_u64().filter(|c| *c > 0)?);
    let wanted = if case.is_static() {
        wanted(&analysis["positions_per_cycle"])
    } else {
        wanted(&case.inputs["motion"]["steps_per_mesh_cycle"])
    };
    if let Some(wanted) = wanted.filter(|n| *n != case.history.rows.len() as u64) {
        wrong.push(format!("{} rows, {wanted} were asked for", case.history.rows.len()));
    }
    wrong
}

/// Columns that have no value in some rows, as `docs/outputs.md` says, and the column that tells which.
fn has_no_value(case: &Case<'_>, column: &str, row: usize) -> bool {
    let is = |name: &str, value: f64| case.history.column(name).is_some_and(|c| c[row] == value);
    let coast = || case.history.column("coast_normal_force_n").is_some_and(|c| c[row] > 0.0);
    match column {
        "max_pressure_z_mm" | "max_pressure_pinion_diameter_mm" => is("max_pressure_place", 0.0),
        c if c.contains("_root_stress_") && c.contains("_pair_") => true,
        c if c.contains("_root_stress_") => coast(),
        "mesh_stiffness_n_per_um" => case.inputs["operation"]["torque_nm"] == 0.0,
        _ => false,
    }
}

/// Every number is one, but where there is no value.
fn no_numbers(case: &Case<'_>) -> Vec<String> {
    let mut wrong = Vec::new();
    for name in &case.history.names {
        let Some(column) = case.history.column(name) else { continue };
        let bad = |(row, value): &(usize, &f64)| !value.is_finite() && !has_no_value(case, name, *row);
        if let Some((row, value)) = column.iter().enumerate().find(bad) {
            wrong.push(format!("history.csv: {name} is {value} in row {row}"));
        }
    }
    wrong
}

/// Values and speeds that have a result have numbers.
fn sweep(folder: &Path) -> Vec<String> {
    TABLES.iter().flat_map(|name| swept(folder, name)).collect()
}

fn swept(folder: &Path, file: &str) -> Vec<String> {
    let Ok(table) = Csv::read(&folder.join(file)) else { return Vec::new() };
    let status = table.names.iter().position(|n| n == "status");
    let mut wrong = Vec::new();
    for row in &table.rows {
        let failed = status.and_then(|at| row.get(at)).is_some_and(|s| s == "failed");
        for (name, cell) in table.names.iter().zip(row) {
            if !failed && !MAY_BE_NAN.contains(&name.as_str()) && matches!(cell.as_str(), "NaN" | "inf" | "-inf") {
                wrong.push(format!("{file}: {name} is {cell} where nothing has failed"));
            }
        }
    }
    wrong.truncate(3);
    wrong
}

/// Figures of the headline that are none, beside those that `docs/outputs.md` lets be `null`.
fn headline(summary: &Json) -> Vec<String> {
    let mut found = Vec::new();
    nulls("headline", &summary["headline"], &mut found);
    let inputs = &summary["inputs"];
    let meshed = inputs["analysis"]["model"].as_str().is_some_and(|m| m.starts_with("reduced") || m == "full");
    let loaded = inputs["operation"]["torque_nm"].as_f64().is_some_and(|torque| torque > 0.0);
    let none = |names: &[&str], path: &str| names.iter().any(|name| path.ends_with(name));
    // Flanks that never touch have no least force.
    let certificate = &summary["headline"]["certificate"];
    let apart = certificate["steps_without_contact"].as_u64() == certificate["steps"].as_u64();
    found.retain(|path| !apart || !path.ends_with(".least_contact_force_n"));
    found.retain(|path| !none(&MAY_BE_NULL, path) && ((meshed && loaded) || !none(&OF_A_LOADED_MESH, path)));
    found.dedup();
    found.into_iter().map(|path| format!("summary.json: {path} is null")).collect()
}

/// Paths of the numbers that are none.
fn nulls(path: &str, value: &Json, found: &mut Vec<String>) {
    match value {
        Json::Null => found.push(path.to_owned()),
        Json::Object(of) => of.iter().for_each(|(key, v)| nulls(&format!("{path}.{key}"), v, found)),
        Json::Array(of) => of.iter().for_each(|v| nulls(path, v, found)),
        _ => {}
    }
}
