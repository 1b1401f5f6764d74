//! `cases.csv`, `cases.parquet`, `summary.json` and the closing table of a plan.

use std::fmt::Write;

use answer::{Table, parquet_bytes};
use scene::plan::{Plan, PlanAxis};
use serde::Serialize;
use serde_json::{Value, json};

use super::{CaseTable, Column, DoneCases, KnownCases, PageWords, page, spread::Spread};
use crate::{Cost, ReportError, checkpoint::InputDigests, folder::ResultDirectory};

/// What says that two plans have the same cases: scene, files that it names, axes, samples, outputs, program.
///
/// # Errors
/// When a file that the scene names cannot be read.
pub fn plan_digest(plan: &Plan) -> Result<String, ReportError> {
    let mut hasher = blake3::Hasher::new();
    let mut take = |text: &str| {
        hasher.update(text.as_bytes());
        hasher.update(&[0]);
    };
    take(env!("CARGO_PKG_VERSION"));
    take(&plan.scene_text);
    plan.settings.iter().for_each(|setting| take(&setting.word()));
    take(&format!("{:?} {:?} {:?} {:?}", plan.axes, plan.cases.axes(), plan.sampling, plan.outputs));
    // Files of a case may be varied as little as their names: those of the first stand for all.
    if let Ok(scene) = plan.scene(0) {
        take(&format!(
            "{:?}",
            InputDigests::of(&scene).map_err(|e| ReportError::NoResult {
                file: plan.scene_file.clone(),
                what: e.to_string(),
                hint: "is a file that the scene names still there?"
            })?
        ));
    }
    Ok(hasher.finalize().to_hex().to_string())
}

/// Writes the files of a plan whose cases are done; what comes back is the closing table.
///
/// # Errors
/// When the system refuses.
pub fn write_cases(
    (plan, done): (&Plan, &DoneCases),
    words: PageWords<'_>,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    let header = CaseTable::of(plan).header().to_owned();
    results.write("cases.csv", (header + &done.text()).as_bytes())?;
    let known = KnownCases::of(plan, done);
    let numbers = (0..known.count()).map(|case| case as f64);
    let mut rows = Table::new("cases").numbers("case", "number of the case", numbers);
    for column in known.axes.iter().chain(&known.outputs) {
        rows.push_numbers(column.name.clone(), "", column.values.iter().copied());
    }
    results.write("cases.parquet", &parquet_bytes(&rows)?)?;
    let told = |column: &Column| {
        Spread::of(column.values.iter().copied()).json(&column.name, column.ascending().first().copied())
    };
    let table = table(plan, &known, cost);
    page::page(plan, &known, words, &table)?.write(results)?;
    let summary = json!({
        "name": plan.name,
        "program": "ale-gear",
        "version": env!("CARGO_PKG_VERSION"),
        "plan": {
            "scene": plan.scene_file,
            "axes": plan.axes.iter().map(|axis| &axis.keys).collect::<Vec<_>>(),
            "values": plan.axes.iter().zip(plan.cases.axes()).map(|(axis, of)| values_of(axis, of)).collect::<Vec<_>>(),
            "sampling": plan.sampling,
        },
        "headline": {
            "cases": plan.cases.count(),
            "failed": known.failed,
            "outputs": known.outputs.iter().map(told).collect::<Vec<_>>(),
        },
        "reports": words.reports,
        "wall_time_s": cost.wall_s,
        "files": results.files()?,
    });
    let text = serde_json::to_string_pretty(&summary).unwrap_or_default() + "\n";
    results.write("summary.json", text.as_bytes())?;
    Ok(table)
}

/// What an axis goes through, or is drawn from.
fn values_of(axis: &PlanAxis, of: impl Serialize) -> Value {
    axis.pitch.as_ref().map_or_else(
        || json!(of),
        |pitch| {
            let [single_pitch_um, total_pitch_um] = pitch.limits_um();
            json!({ "pitch-errors": { "single_pitch_um": single_pitch_um, "total_pitch_um": total_pitch_um } })
        },
    )
}

fn table(plan: &Plan, known: &KnownCases, cost: &Cost) -> String {
    let axes: Vec<&str> = plan.axes.iter().map(PlanAxis::name).collect();
    let mut t = format!("{} ({} cases over {})\n\n", plan.name, plan.cases.count(), axes.join(", "));
    // Writing to a String cannot fail.
    let heads = ["least", "in case", "median", "90 %", "largest"].map(|head| format!(" {head:>12}")).concat();
    let _ = writeln!(t, "  {:<36}{heads}", "");
    for output in &known.outputs {
        let spread = Spread::of(output.values.iter().copied());
        let at = |share: f64| spread.quantile(share).map_or_else(|| "-".to_owned(), |x| format!("{x:.4}"));
        let [least, median, ninety, largest] = [0.0, 0.5, 0.9, 1.0].map(at);
        let case = output.ascending().first().map_or_else(|| "-".to_owned(), usize::to_string);
        let _ = writeln!(t, "  {:<36} {least:>12} {case:>12} {median:>12} {ninety:>12} {largest:>12}", output.name);
    }
    if known.failed > 0 {
        let _ = writeln!(t, "\n  cases without a result: {}; `reason` in cases.csv says why", known.failed);
    }
    let _ = writeln!(t, "\n  wall time {:.2} s", cost.wall_s);
    t
}
