//! The answer about a plan.

use std::collections::BTreeMap;

use analysis::remark;
use answer::{Answer, Check, Checks, Cost, Table, keyed};
use described::Key;
use scene::plan::{Plan, PlanAxis};
use serde::Serialize;
use serde_json::{Value, json};

use super::{
    PageWords, page,
    spread::{Spread, SpreadSummary},
};
use crate::{ReportError, Written, write_result};
use plan::{CaseRow, Column, DoneCases, KnownCases};
use store::folder::ResultDirectory;

described::described! {
    /// Headline of a plan.
    #[derive(Serialize)]
    struct PlanHeadline {
        /// number of cases
        cases: usize,
        /// cases without a result
        failed: usize,
        /// spread of each output by its name, over the cases that have it
        outputs: BTreeMap<String, SpreadSummary>,
    }

    /// Facts of a plan.
    #[derive(Serialize)]
    struct PlanInfo<'a> {
        /// cases with a report of their own
        reports: &'a [usize],
    }

    /// What a plan varies.
    #[derive(Serialize)]
    struct PlanInputs {
        /// scene or gearbox that is varied
        scene: Value,
        /// keys of each axis
        axes: Vec<Value>,
        /// values of each axis: `each` of a list; or `drawn`: `uniform` or `log_uniform` with `from` and `to`, `normal` with `mean`, `deviation`, `least`, `largest`; or `pitch-errors` of a gear with its tolerances `single_pitch_um` and `total_pitch_um`
        values: Vec<Value>,
        /// `design`, `samples` and `seed` of drawn values
        sampling: Value,
    }
}

/// Objects of the summary with their keys.
pub(crate) const OBJECTS: [(&str, &[Key]); 4] = [
    ("headline, a plan", PlanHeadline::KEYS),
    ("outputs, a plan", SpreadSummary::KEYS),
    ("the summary of a plan", PlanInfo::KEYS),
    ("inputs, a plan", PlanInputs::KEYS),
];

/// The answer about a plan whose cases are done: the table `cases`.
fn answer(plan: &Plan, rows: &[CaseRow], known: &KnownCases, reports: &[usize], cost: Cost) -> Answer {
    let told = |column: &Column| {
        let spread = Spread::of(column.values.iter().copied()).summary(column.ascending().first().copied());
        (column.name.clone(), spread)
    };
    Answer {
        kind: "plan",
        name: plan.name.clone(),
        inputs: json!({ "plan": PlanInputs {
            scene: json!(plan.scene_file()),
            axes: plan.axes.iter().map(|axis| json!(axis.keys)).collect(),
            values: plan.axes.iter().zip(plan.cases.axes()).map(|(axis, of)| values_of(axis, of)).collect(),
            sampling: json!(plan.sampling),
        } }),
        tables: vec![table(known, &rows.iter().map(|row| (row.case, row.status())).collect::<Vec<_>>())],
        headline: json!(PlanHeadline {
            cases: plan.cases.count(),
            failed: known.failed,
            outputs: known.outputs.iter().map(told).collect(),
        }),
        checks: Checks::new([Check::cases_without_result(
            known.failed,
            known.count(),
            "`reason` in cases.csv says of each case why",
        )]),
        remarks: (known.failed > 0).then(|| remark::cases_unsolved(known.failed, rows.len())).into_iter().collect(),
        info: keyed(&PlanInfo { reports }),
        cost,
    }
}

/// The table `cases`, a row a case; `cases`: number and status of each.
fn table(known: &KnownCases, cases: &[(usize, &str)]) -> Table {
    let mut table =
        Table::new("cases").numbers("case", "number of the case, from 0", cases.iter().map(|row| row.0 as f64));
    for axis in &known.axes {
        table.push_numbers(axis.name.clone(), "value of a varied key in the case", axis.values.iter().copied());
    }
    for output in &known.outputs {
        let meaning = "output of the plan: a number of the headline, or `mean_`, `peak_to_peak_`, `least_`, `largest_`, `harmonic_<h>_` of a column; `NaN` without a result";
        table.push_numbers(output.name.clone(), meaning, output.values.iter().copied());
    }
    table
        .texts("status", "status: `solved`, or `failed` where the case has no result", cases.iter().map(|row| row.1))
        .texts("reason", "reason why the case has no result; empty where it has one", known.reasons.iter().cloned())
}

/// The table `cases` without rows, for `docs/outputs.md`.
pub(crate) fn documented() -> Table {
    let column = |name: &str| Column { name: name.to_owned(), values: Vec::new() };
    let (axes, outputs) = (vec![column("<key>")], vec![column("<output>")]);
    table(&KnownCases { axes, outputs, reasons: Vec::new(), failed: 0 }, &[])
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
        || if axis.words.is_empty() { json!(of) } else { json!(axis.words) },
        |pitch| {
            let [single_pitch_um, total_pitch_um] = pitch.limits_um();
            json!({ "pitch-errors": { "single_pitch_um": single_pitch_um, "total_pitch_um": total_pitch_um } })
        },
    )
}
