//! `report.html` of a plan: how outputs are spread, what each axis does to them, and the cases as a table.

use minijinja::{context, value::Serde};
use scene::plan::{Plan, PlanAxis, PlanOutput};
use serde_json::{Value, json};
use study::correlation;

use crate::{
    ReportError,
    charts::{Curve, dot_chart, line_chart},
    page::Rendered,
};

/// Cases in the table of the page at most; `cases.csv` has all.
const MOST_ROWS: usize = 2000;

/// The page; `columns` are those of `cases.parquet`, `reasons` one a case, `table` the closing table.
pub(super) fn page(
    plan: &Plan,
    columns: &[Vec<f64>],
    reasons: &[String],
    table: &str,
) -> Result<Rendered, ReportError> {
    let axes: Vec<(&str, &[f64])> =
        plan.axes.iter().map(PlanAxis::name).zip(columns[1..].iter().map(Vec::as_slice)).collect();
    let names: Vec<String> = plan.outputs.iter().map(PlanOutput::name).collect();
    let outputs: Vec<(&str, &[f64])> =
        names.iter().map(String::as_str).zip(columns[1 + axes.len()..].iter().map(Vec::as_slice)).collect();
    let mut charts = Vec::new();
    for (name, values) in &outputs {
        charts.extend(spread(name, values));
        for (axis, at) in &axes {
            let points = at.iter().zip(*values).map(|(a, v)| (*a, *v)).collect();
            let curve = Curve { label: String::new(), points };
            charts.extend(dot_chart(&format!("{name} over {axis}"), axis, name, &[curve]));
        }
    }
    let together: Vec<Value> = axes
        .iter()
        .map(
            |(axis, at)| json!({ "axis": axis, "with": outputs.iter().map(|(_, v)| known(at, v)).collect::<Vec<_>>() }),
        )
        .collect();
    let row = |case: usize| {
        let numbers: Vec<Option<f64>> =
            columns[1..].iter().map(|column| Some(column[case]).filter(|v| v.is_finite())).collect();
        json!({ "case": case, "numbers": numbers, "reason": reasons.get(case) })
    };
    let count = columns.first().map_or(0, Vec::len);
    Rendered::new(
        "plan.html",
        context! {
            name => &plan.name,
            version => env!("CARGO_PKG_VERSION"),
            count => count,
            table => table,
            charts => charts,
            outputs => names.clone(),
            axes => axes.iter().map(|(axis, _)| (*axis).to_owned()).collect::<Vec<_>>(),
            together => Serde(Value::from(together)),
            rows => Serde((0..count.min(MOST_ROWS)).map(row).collect::<Value>()),
            file => plan.file.display().to_string(),
        },
    )
}

/// Share of the cases that have no more than a value.
fn spread(name: &str, values: &[f64]) -> Option<String> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let points = sorted.iter().enumerate().map(|(i, v)| (*v, 100.0 * (i as f64 + 0.5) / n)).collect();
    let curve = Curve { label: String::new(), points };
    line_chart(&format!("How {name} is spread"), name, "share of cases with no more [%]", &[curve], true)
}

/// Pearson's coefficient over the cases that have a number; none where one of both does not vary.
fn known(at: &[f64], values: &[f64]) -> Option<f64> {
    let both: Vec<(f64, f64)> =
        at.iter().zip(values).filter(|(a, v)| a.is_finite() && v.is_finite()).map(|(a, v)| (*a, *v)).collect();
    let (a, v): (Vec<f64>, Vec<f64>) = both.into_iter().unzip();
    correlation(&a, &v).ok().flatten()
}
