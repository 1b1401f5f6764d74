//! `compare.html`: runs side by side on one page that needs nothing beside itself.

use minijinja::context;

use super::charts::{Curve, line_chart};
use super::compare_table::{letter, number, per_cent};
use super::page;
use crate::compare::{NumberRow, Overlay, ResultFolder, WordRow};
use crate::error::CommandError;

const TEMPLATE: &str = include_str!("compare.html");

/// A chart of each quantity: its name and the picture as SVG. A quantity without a finite value has none.
pub fn compare_charts(overlays: &[Overlay]) -> Vec<(String, String)> {
    let chart = |overlay: &Overlay| {
        let curve = |t: &crate::compare::Trace| Curve { label: t.label.clone(), points: t.points.clone() };
        let curves: Vec<Curve> = overlay.traces.iter().map(curve).collect();
        let svg = line_chart(&overlay.name, overlay.over, &overlay.name, &curves, false)?;
        Some((overlay.name.clone(), svg))
    };
    overlays.iter().filter_map(chart).collect()
}

/// The page.
///
/// # Errors
/// Exit status 1 if the template cannot be filled; that would be a fault of this program.
pub fn write_compare_report(
    runs: &[ResultFolder],
    numbers: &[NumberRow],
    inputs: &[WordRow],
    charts: &[(String, String)],
) -> Result<String, CommandError> {
    let name = |run: &ResultFolder| run.summary()["name"].as_str().unwrap_or_default().to_owned();
    let model =
        |run: &ResultFolder| run.summary()["inputs"]["analysis"]["model"].as_str().unwrap_or_default().to_owned();
    let heads: Vec<_> = runs
        .iter()
        .enumerate()
        .map(|(i, run)| context! { letter => letter(i), label => run.label(), name => name(run), model => model(run) })
        .collect();
    let rows: Vec<_> = numbers
        .iter()
        .map(|row| {
            let mut cells = vec![number(row.values[0])];
            for (value, difference) in row.values.iter().skip(1).zip(&row.differences) {
                cells.extend([number(*value), number(difference.map(|d| d.absolute)), per_cent(*difference)]);
            }
            context! { key => &row.key, cells => cells }
        })
        .collect();
    let words: Vec<_> = inputs
        .iter()
        .map(|row| {
            let cells: Vec<String> = row.values.iter().map(|v| v.clone().unwrap_or_else(|| "-".into())).collect();
            context! { key => &row.key, cells => cells }
        })
        .collect();
    let pictures: Vec<String> = charts.iter().map(|(_, svg)| svg.clone()).collect();
    page::render(
        "compare.html",
        TEMPLATE,
        context! {
            name => format!("{} runs side by side", runs.len()),
            version => env!("CARGO_PKG_VERSION"),
            runs => heads,
            rows => rows,
            words => words,
            charts => pictures,
        },
    )
}
