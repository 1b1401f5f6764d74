//! The answer about a plan.

use analysis::remark;
use answer::{Answer, Check, Checks, Cost, Table};
use scene::plan::{Plan, PlanAxis};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::{PageWords, page, spread::Spread};
use crate::{ReportError, Written, write_result};
use plan::{CaseRow, Column, DoneCases, KnownCases};
use store::folder::ResultDirectory;

/// The answer about a plan whose cases are done: the table `cases`.
fn answer(plan: &Plan, rows: &[CaseRow], known: &KnownCases, reports: &[usize], cost: Cost) -> Answer {
    let mut table =
        Table::new("cases").numbers("case", "number of the case, from 0", rows.iter().map(|row| row.case as f64));
    for axis in &known.axes {
        table.push_numbers(axis.name.clone(), "value of this key in the case", axis.values.iter().copied());
    }
    for output in &known.outputs {
        let meaning = "the number that was asked for; NaN without a result";
        table.push_numbers(output.name.clone(), meaning, output.values.iter().copied());
    }
    let table = table
        .texts("status", "`solved`, or `failed` where the case has no result", rows.iter().map(CaseRow::status))
        .texts("reason", "why it has none", known.reasons.iter().cloned());
    let told = |column: &Column| {
        let spread = Spread::of(column.values.iter().copied()).json(column.ascending().first().copied());
        (column.name.clone(), spread)
    };
    Answer {
        kind: "plan",
        name: plan.name.clone(),
        inputs: json!({ "plan": {
            "scene": plan.scene_file(),
            "axes": plan.axes.iter().map(|axis| &axis.keys).collect::<Vec<_>>(),
            "values": plan.axes.iter().zip(plan.cases.axes()).map(|(axis, of)| values_of(axis, of)).collect::<Vec<_>>(),
            "sampling": plan.sampling,
        } }),
        tables: vec![table],
        headline: json!({
            "cases": plan.cases.count(),
            "failed": known.failed,
            "outputs": known.outputs.iter().map(told).collect::<Map<_, _>>(),
        }),
        checks: Checks::new([Check::cases_without_result(
            known.failed,
            known.count(),
            "`reason` in cases.csv says of each case why",
        )]),
        remarks: (known.failed > 0).then(|| remark::cases_unsolved(known.failed, rows.len())).into_iter().collect(),
        info: Map::from_iter([("reports".to_owned(), json!(reports))]),
        cost,
    }
}

/// Writes the files of a plan whose cases are done; what comes back is the closing table.
///
/// # Errors
/// When the system refuses.
pub fn write_cases(
    (plan, done): (&Plan, &DoneCases),
    words: PageWords<'_>,
    cost: Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let rows = done.all();
    let known = KnownCases::of(plan, &rows);
    let answer = answer(plan, &rows, &known, words.reports, cost);
    let page = page::page(plan, &known, words, &answer);
    write_result(answer, &page, true, results)
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
