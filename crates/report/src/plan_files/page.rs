//! `report.html` of a plan: how outputs are spread, what each axis does to them, and the cases as a table.

use minijinja::{context, value::Serde};
use scene::plan::Plan;
use serde_json::{Value, json};
use study::correlation;

use super::{Column, KnownCases, curves::over_axes, maps::maps};
use crate::{
    ReportError,
    charts::{Curve, line_chart},
    page::Rendered,
    study_files::CASES,
};

/// Cases in the table of the page at most; `cases.csv` has all.
const MOST_ROWS: usize = 2000;

/// What a report of a plan says beside its numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct PageWords<'a> {
    /// The command that makes it again.
    pub again: &'a str,
    /// Cases that have a report of their own, in the folder [`report_folder`].
    pub reports: &'a [usize],
}

/// Folder of the report of a case, below that of the plan.
pub fn report_folder(case: usize) -> String {
    format!("{CASES}/{case}")
}

/// The page; `table` is the closing table.
pub(super) fn page(
    plan: &Plan,
    known: &KnownCases,
    words: PageWords<'_>,
    table: &str,
) -> Result<Rendered, ReportError> {
    let mut charts = Vec::new();
    for output in &known.outputs {
        charts.extend(maps(plan, known, output));
        charts.extend(over_axes(plan, known, output));
        charts.extend(spread(output));
    }
    let together = |axis: &Column| {
        let with: Vec<Option<f64>> = known.outputs.iter().map(|output| pearson(&axis.values, &output.values)).collect();
        json!({ "axis": axis.name, "with": with })
    };
    let names = |columns: &[Column]| columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>();
    let rows = shown(known, words.reports).into_iter().map(|case| row(known, words.reports, case));
    Rendered::new(
        "plan.html",
        context! {
            name => &plan.name,
            version => env!("CARGO_PKG_VERSION"),
            count => known.count(),
            table => table,
            charts => charts,
            outputs => names(&known.outputs),
            axes => names(&known.axes),
            together => Serde(known.axes.iter().map(together).collect::<Value>()),
            rows => Serde(rows.collect::<Value>()),
            reports => words.reports.len(),
            again => words.again,
        },
    )
}

/// Cases of the table: the first ones, and all with a report of their own.
fn shown(known: &KnownCases, reports: &[usize]) -> Vec<usize> {
    let first = known.count().min(MOST_ROWS);
    let mut later: Vec<usize> = reports.iter().copied().filter(|&case| case >= first).collect();
    later.sort_unstable();
    (0..first).chain(later).collect()
}

fn row(known: &KnownCases, reports: &[usize], case: usize) -> Value {
    let numbers = known.axes.iter().chain(&known.outputs).map(|column| column.values[case]);
    let numbers: Vec<Option<f64>> = numbers.map(|v| Some(v).filter(|v| v.is_finite())).collect();
    json!({ "case": case, "numbers": numbers, "reason": known.reasons[case], "report": reports.contains(&case) })
}

/// Share of the cases that have no more than a value.
fn spread(output: &Column) -> Option<String> {
    let (name, sorted) = (&output.name, output.ascending());
    let n = sorted.len() as f64;
    let share = |(i, &case): (usize, &usize)| (output.values[case], 100.0 * (i as f64 + 0.5) / n);
    let curve = Curve { label: String::new(), points: sorted.iter().enumerate().map(share).collect() };
    line_chart(&format!("How {name} is spread"), name, "share of cases with no more [%]", &[curve], true)
}

/// Pearson's coefficient over the cases that have a number; none where one of both does not vary.
fn pearson(at: &[f64], values: &[f64]) -> Option<f64> {
    let both = at.iter().zip(values).filter(|(a, v)| a.is_finite() && v.is_finite());
    let (a, v): (Vec<f64>, Vec<f64>) = both.map(|(a, v)| (*a, *v)).unzip();
    correlation(&a, &v).ok().flatten()
}
