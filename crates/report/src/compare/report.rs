//! `compare.html`: runs side by side on one page that needs nothing beside itself.

use minijinja::context;

use super::{
    NumberRow, Overlay, ResultFolder, Trace, WordRow,
    table::{letter, number, per_cent},
};
use crate::{
    ReportError,
    charts::{Curve, line_chart, line_picture},
    page,
};

/// A chart of one quantity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CompareChart {
    /// The quantity, with unit.
    pub name: String,
    /// For a page: with zoom and values under the pointer.
    pub figure: String,
    /// As a picture.
    pub svg: String,
}

/// A chart of each quantity. A quantity without a finite value has none.
pub fn compare_charts(overlays: &[Overlay]) -> Vec<CompareChart> {
    let chart = |overlay: &Overlay| {
        let curve = |t: &Trace| Curve { label: t.label.clone(), points: t.points.clone() };
        let curves: Vec<Curve> = overlay.traces.iter().map(curve).collect();
        let name = overlay.name.clone();
        let figure = line_chart(&name, overlay.over, &name, &curves, false)?;
        let svg = line_picture(&name, overlay.over, &name, &curves)?;
        Some(CompareChart { name, figure, svg })
    };
    overlays.iter().filter_map(chart).collect()
}

/// The page.
///
/// # Errors
/// If the template cannot be filled; that would be a fault of this program.
pub fn write_compare_report(
    runs: &[ResultFolder],
    numbers: &[NumberRow],
    inputs: &[WordRow],
    charts: &[CompareChart],
) -> Result<String, ReportError> {
    let name = |run: &ResultFolder| run.summary()["name"].as_str().unwrap_or_default().to_owned();
    let model =
        |run: &ResultFolder| run.summary()["inputs"]["analysis"]["model"].as_str().unwrap_or_default().to_owned();
    let heads: Vec<_> = runs
        .iter()
        .enumerate()
        .map(|(i, run)| {
            let missed: Vec<String> = run.missed().into_iter().map(str::to_owned).collect();
            context! { letter => letter(i), label => run.label(), name => name(run), model => model(run), missed => missed }
        })
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
    let pictures: Vec<String> = charts.iter().map(|c| c.figure.clone()).collect();
    page::render(
        "compare.html",
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
