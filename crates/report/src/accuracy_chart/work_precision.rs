//! The work-precision chart: errors against wall times, one panel a quantity and a kind of work; strokes are what the
//! points say of their errors themselves.

use serde_json::json;
use study::{AnswerError, Work};

use super::{Chart, ChartHeadline, rows::rows, tables::chart_tables};
use crate::{
    charts::{Captions, Labelled, log_panels},
    page::counted,
};
use analysis::accuracy_chart::{Outcome, OwnBound, OwnBounds, WorkPrecision};

/// Errors below this are drawn on the axis: round-off and luck are no accuracy.
const LEAST: f64 = 1e-5;

/// One error of an answer, where it is known, and what the answer says of it itself.
struct Quantity {
    name: &'static str,
    of: fn(&AnswerError) -> Option<f64>,
    own: fn(&OwnBounds) -> Option<OwnBound>,
}

/// One wall time.
struct Effort {
    name: &'static str,
    of: fn(&Work) -> f64,
}

const QUANTITIES: [Quantity; 3] = [
    Quantity { name: "mean STE", of: |e| Some(e.mean_ste), own: |b| Some(b.mean_ste) },
    Quantity { name: "peak-to-peak STE", of: |e| e.peak_to_peak_ste, own: |b| b.peak_to_peak_ste },
    Quantity { name: "mean contact-line length", of: |e| e.mean_line_length, own: |_| None },
];
const EFFORTS: [Effort; 2] = [
    Effort { name: "first cycle, everything before it included [s]", of: Work::first_cycle_s },
    Effort { name: "one more position [s]", of: Work::position_s },
];

/// The chart as SVG.
fn work_precision_svg(title: &str, chart: &WorkPrecision) -> Result<String, String> {
    let names = series(chart);
    let titles = QUANTITIES.map(|q| format!("Error of {}", q.name));
    let panels = QUANTITIES.iter().zip(&titles).flat_map(|(q, title)| {
        EFFORTS.iter().map(|e| {
            let all = names.iter().map(|name| points(chart, name, q, e)).collect();
            (Captions { title, x: e.name, y: "error [%]" }, all)
        })
    });
    log_panels(title, &names, &panels.collect::<Vec<_>>())
}

/// Names of the ways that have a point, in the order of the table.
fn series(chart: &WorkPrecision) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = Vec::new();
    for row in &chart.rows {
        if matches!(row.outcome, Outcome::Measured { .. }) && !names.contains(&row.way) {
            names.push(row.way);
        }
    }
    names
}

/// Points (s, error in %) of a way in one panel, with the elements along the profile.
fn points(chart: &WorkPrecision, way: &str, q: &Quantity, e: &Effort) -> Vec<Labelled> {
    let rows = chart.rows.iter().filter(|r| r.way == way);
    rows.filter_map(|r| match &r.outcome {
        Outcome::Measured { work, error, bounds, .. } => {
            let error = (q.of)(error)?;
            let (x, y) = ((e.of)(work), error.abs().max(LEAST));
            let own = bounds.as_deref().ok().and_then(q.own);
            let bound = own.map(|own| 100.0 * on_side_of(error, own).max(LEAST));
            let label = r.density.filter(|d| d.profile > 0).map(|d| d.profile.to_string());
            (x > 0.0 && x.is_finite() && y.is_finite()).then_some(Labelled { at: (x, 100.0 * y), label, bound })
        }
        Outcome::Skipped(_) => None,
    })
    .collect()
}

/// The bound of an error on the side where it lies, relative.
fn on_side_of(error: f64, own: OwnBound) -> f64 {
    if error < 0.0 { -own.least } else { own.most }
}

/// Every model of a pair: error against wall time.
pub fn work_precision_chart(name: &str, points: &WorkPrecision, command: &str, threads: usize) -> Chart {
    let measured = points.rows.iter().filter(|row| matches!(row.outcome, Outcome::Measured { .. })).count();
    Chart {
        subtitle: format!("accuracy against cost, {}", counted(measured, "point")),
        tables: vec![rows(points)],
        headline: json!(ChartHeadline {
            points: measured,
            points_not_run: points.rows.len() - measured,
            reference_mean_ste_um: Some(study::mean(&points.reference.ste_um)),
            ..ChartHeadline::default()
        }),
        pictures: vec![("work_precision", work_precision_svg(name, points))],
        markdown: chart_tables(points, command, threads),
        command: command.to_owned(),
    }
}
