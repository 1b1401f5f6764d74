//! Runs side by side: answer, charts and page.

use std::collections::BTreeMap;

use analysis::remark;
use answer::{Answer, label_of};
use serde::Serialize;
use serde_json::{Value, json};

use super::{
    Difference, NumberRow, Overlay, ResultFolder, Trace, WordRow,
    rows::{self, letter},
};
use crate::{
    answer_files::Object,
    charts::{Curve, line_chart, line_picture},
    page::{Cell, Grid, Page, Part},
    plan_files::plain,
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

/// What a reader wants to see of rows over a mesh cycle or over time: column, in words, axis. All columns stand in
/// `compare_curves.csv`.
const SHOWN: [(&str, &str, &str); 11] = [
    ("te_um", "Transmission error", "TE [um]"),
    ("ste_um", "Static transmission error", "STE [um]"),
    ("dte_um", "Dynamic transmission error", "DTE [um]"),
    ("mesh_stiffness_n_per_um", "Mesh stiffness, secant", "stiffness [N/um]"),
    ("normal_force_n", "Sum of the normal forces", "force [N]"),
    ("contact_line_length_mm", "Total contact-line length", "length [mm]"),
    ("pairs_in_contact", "Tooth pairs in contact", "pairs"),
    ("max_pressure_mpa", "Largest pressure", "pressure [MPa]"),
    ("pinion_root_stress_max_principal_mpa", "Largest principal root stress, pinion", "stress [MPa]"),
    ("wheel_root_stress_max_principal_mpa", "Largest principal root stress, wheel", "stress [MPa]"),
    ("wheel_force_z_n", "Axial force on the wheel", "force [N]"),
];
/// Number of transmission errors among these, which are drawn without their mean as well: what a gear excites.
const ERRORS: usize = 3;

/// Columns of a table beside the rows of a pair that are drawn; all stand in `compare_curves.csv`.
const MOST_CHARTS: usize = 40;

/// The quantities that matter, each in a chart; of tables beside the rows of a pair the first ones. A quantity without a
/// finite value has none.
pub fn compare_charts(overlays: &[Overlay]) -> Vec<CompareChart> {
    let of_pair = |o: &&Overlay| o.table == HISTORY && o.over != SPEED;
    let mut charts = Vec::new();
    for (k, &(name, title, axis)) in SHOWN.iter().enumerate() {
        for overlay in overlays.iter().filter(of_pair).filter(|o| o.name == name) {
            if k < ERRORS {
                let alone = Overlay { traces: overlay.traces.iter().map(without_mean).collect(), ..overlay.clone() };
                let file = format!("{}_without_mean_um", name.trim_end_matches("_um"));
                charts.extend(chart(&alone, file, &format!("{title} without its mean"), axis));
            }
            charts.extend(chart(overlay, name.to_owned(), title, axis));
        }
    }
    let mut drawn: BTreeMap<&str, usize> = BTreeMap::new();
    // A pattern over a flank is a field over two coordinates, not a curve.
    for o in overlays.iter().filter(|o| !of_pair(o) && o.over != ROLL_ANGLE) {
        let count = drawn.entry(&o.table).or_default();
        *count += 1;
        if *count <= MOST_CHARTS {
            let label = label_of(&o.name);
            let title = format!("{}, {}", plain(&label), o.table.replace('_', " "));
            charts.extend(chart(o, format!("{}_{}", o.table, o.name.replace('.', "_")), &title, &label));
        }
    }
    charts
}

/// Abscissa of sweeps.
const SPEED: &str = "speed_rpm";
/// First coordinate of contact patterns.
const ROLL_ANGLE: &str = "roll_angle_deg";
/// Rows of a pair over phase or time.
const HISTORY: &str = "history";

fn chart(overlay: &Overlay, name: String, title: &str, axis: &str) -> Option<CompareChart> {
    let over = match overlay.over.as_str() {
        "mesh_phase" => "mesh phase",
        "time_s" => "time [s]",
        SPEED => "speed of the driver [1/min]",
        other => &label_of(other),
    };
    let common = common_folder(&overlay.traces);
    let curve = |t: &Trace| Curve { label: t.label[common..].to_owned(), points: t.points.clone() };
    let curves: Vec<Curve> = overlay.traces.iter().map(curve).collect();
    let figure = line_chart(title, over, axis, &curves, false)?;
    let svg = line_picture(title, over, axis, &curves)?;
    Some(CompareChart { name, figure, svg })
}

/// Length of the folder that all labels begin with: legends go without it. 0 if nothing would be left of a label.
fn common_folder(traces: &[Trace]) -> usize {
    let Some((first, rest)) = traces.split_first() else { return 0 };
    let ends = first.label.match_indices('/').map(|(at, _)| at + 1).rev();
    let is_common = |&end: &usize| {
        let folder = &first.label[..end];
        end < first.label.len() && rest.iter().all(|t| t.label.len() > end && t.label.starts_with(folder))
    };
    if rest.is_empty() { 0 } else { ends.into_iter().find(is_common).unwrap_or(0) }
}

/// A curve about its own mean over the points that are drawn.
fn without_mean(trace: &Trace) -> Trace {
    let finite = || trace.points.iter().map(|p| p.1).filter(|v| v.is_finite());
    let mean = finite().sum::<f64>() / finite().count().max(1) as f64;
    let points = trace.points.iter().map(|&(x, value)| (x, value - mean)).collect();
    Trace { label: trace.label.clone(), points }
}

described::described! {
    /// Headline of a comparison.
    #[derive(Serialize)]
    struct ComparisonHeadline {
        /// number of runs
        runs: usize,
        /// headline numbers that are compared
        numbers: usize,
        /// inputs that differ
        inputs_that_differ: usize,
    }
}

/// The headline with its keys.
pub(crate) const OBJECT: Object = ("headline, a comparison", ComparisonHeadline::KEYS);

/// Runs side by side as an answer: the tables `compare` and `compare_curves`.
pub fn compare_answer(runs: &[ResultFolder], numbers: &[NumberRow], inputs: &[WordRow], curves: &[Overlay]) -> Answer {
    let labels: Vec<String> = runs.iter().map(ResultFolder::label).collect();
    let missed = runs.iter().enumerate().flat_map(|(i, run)| {
        run.missed().into_iter().map(move |words| remark::result_failed(letter(i), words)).collect::<Vec<_>>()
    });
    Answer {
        kind: "comparison",
        name: format!("{} runs side by side", runs.len()),
        inputs: json!({ "runs": labels }),
        tables: vec![rows::numbers(runs.len(), numbers), rows::curves(curves)],
        headline: json!(ComparisonHeadline {
            runs: runs.len(),
            numbers: numbers.len(),
            inputs_that_differ: inputs.len()
        }),
        remarks: missed.collect(),
        ..Answer::default()
    }
}

/// A key of a headline in words; entries of its lists count from 1 on: `peak_to_peak_ste_um[0]` is `peak to peak STE 1 [µm]`.
fn name_of(key: &str) -> String {
    let part = |part: &str| match part.split_once('[') {
        Some((name, rest)) => {
            let indices = rest.trim_end_matches(']').split("][");
            let counted = indices.map(|i| i.parse::<usize>().map_or_else(|_| i.to_owned(), |i| (i + 1).to_string()));
            std::iter::once(name.to_owned()).chain(counted).collect::<Vec<_>>().join(".")
        }
        None => part.to_owned(),
    };
    label_of(&key.split('.').map(part).collect::<Vec<_>>().join("."))
}

/// The page.
pub fn compare_page(
    answer: &Answer,
    runs: &[ResultFolder],
    (numbers, inputs): (&[NumberRow], &[WordRow]),
    charts: &[CompareChart],
) -> Page {
    let mut page = Page::of(answer, "differences are against run A".to_owned());
    let names = runs.iter().enumerate().map(|(i, run)| {
        let word =
            |pointer: &str| run.summary().pointer(pointer).and_then(Value::as_str).unwrap_or_default().to_owned();
        [letter(i), run.label(), word("/name"), word("/inputs/analysis/model")].map(Cell::text).to_vec()
    });
    page.push(Part::more().closing().grid(Grid::new(["", "folder", "name", "model"]).rows(names)));
    let figures = Part::new("Curves").figures(charts.iter().map(|c| c.figure.clone()));
    let none = "These runs have no column of rows in common.";
    page.push(if charts.is_empty() { figures.words(none) } else { figures });
    let letters = || (0..runs.len()).map(letter);
    let words = inputs.iter().map(|row| {
        let values = row.values.iter().map(|v| Cell::text(v.as_deref().unwrap_or("-")));
        std::iter::once(Cell::text(&row.key)).chain(values).collect()
    });
    let head = std::iter::once("input".to_owned()).chain(letters());
    page.push(Part::new("Inputs that differ").closing().grid(Grid::new(head).rows(words)));
    let cell = |text: String| Cell { is_number: true, ..Cell::text(text) };
    let rows = numbers.iter().map(|row| {
        let mut cells = vec![Cell::text(name_of(&row.key)), cell(number(row.values[0]))];
        for (value, difference) in row.values.iter().skip(1).zip(&row.differences) {
            let absolute = number(difference.map(|d| d.absolute));
            cells.extend([number(*value), absolute, per_cent(*difference)].map(cell));
        }
        cells
    });
    let heads = letters()
        .enumerate()
        .flat_map(|(i, own)| if i == 0 { vec![own] } else { vec![own.clone(), format!("{own} - A"), "%".to_owned()] });
    let head = std::iter::once("number".to_owned()).chain(heads);
    page.push(Part::new("Headline numbers").closing().grid(Grid::new(head).rows(rows)));
    page
}

/// Six digits; `-` where there is no number.
pub(super) fn number(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(v) if !v.is_finite() => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(v) if v == v.trunc() && v.abs() < 1e9 => format!("{v:.0}"),
        Some(v) if (1e-3..1e7).contains(&v.abs()) => {
            let places = (5.0 - v.abs().log10().floor()).clamp(0.0, 8.0) as usize;
            format!("{v:.places$}")
        }
        Some(v) => format!("{v:.4e}"),
    }
}

/// Per cent with sign; `-` where there is none.
pub(super) fn per_cent(difference: Option<Difference>) -> String {
    match difference.and_then(|d| d.per_cent) {
        None => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(p) if p.abs() < 1e-3 || p.abs() >= 1e6 => format!("{p:+.1e}"),
        Some(p) => format!("{p:+.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn overlay(table: &str, name: &str, over: &str) -> Overlay {
        let trace =
            |label: &str, by: f64| Trace { label: label.into(), points: vec![(0.0, 1.0 + by), (0.5, 3.0 + by)] };
        Overlay {
            table: table.into(),
            name: name.into(),
            over: over.into(),
            traces: vec![trace("a", 0.0), trace("b", 10.0)],
        }
    }

    /// Legends name folders without the path that they have in common.
    #[test]
    fn legends_go_without_the_common_folder() {
        let length = |labels: &[&str]| {
            let traces: Vec<Trace> = labels.iter().map(|l| Trace { label: (*l).into(), points: Vec::new() }).collect();
            common_folder(&traces)
        };
        assert_eq!(length(&["out/a", "out/b"]), 4);
        assert_eq!(length(&["/x/out/a (up)", "/x/out/a (down)", "/x/b"]), 3);
        assert_eq!([length(&["out/a", "b"]), length(&["out/", "out/b"]), length(&["out/a"])], [0, 0, 0]);
    }

    /// Two loads with the same variation lie on each other, whatever their means.
    #[test]
    fn errors_are_drawn_without_their_mean_first() {
        let charts = compare_charts(&[
            overlay("history", "iterations", "mesh_phase"),
            overlay("history", "ste_um", "mesh_phase"),
        ]);
        let names: Vec<&str> = charts.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["ste_without_mean_um", "ste_um"], "what does not matter is not drawn");
        assert!(charts[0].figure.contains("[[0,0.5],[-1,1],[-1,1]]"), "{}", charts[0].figure);
        assert!(charts[0].figure.contains("Static transmission error without its mean"), "in words");
    }

    #[test]
    fn a_sweep_shows_all_its_columns() {
        let charts = compare_charts(&[overlay("resonance", "rms_dte_um", "speed_rpm")]);
        assert_eq!((charts.len(), charts[0].name.as_str()), (1, "resonance_rms_dte_um"));
    }

    #[test]
    fn numbers_keep_six_digits_and_a_sign_where_it_matters() {
        let shown = [12.3456789, -0.00123456789, 1e-7, 86_000.0, 0.0, 1234.5678].map(|v| number(Some(v)));
        assert_eq!(shown, ["12.3457", "-0.00123457", "1.0000e-7", "86000", "0", "1234.57"]);
        assert_eq!((number(None), number(Some(f64::NAN))), ("-".into(), "-".into()));
        let d = |absolute, per_cent| per_cent_of(absolute, per_cent);
        assert_eq!([d(1.0, Some(5.0)), d(1.0, None), d(-1.0, Some(-2e-6))], ["+5.000", "-", "-2.0e-6"]);
        assert_eq!([letter(0), letter(25), letter(26)], ["A", "Z", "26"]);
    }

    fn per_cent_of(absolute: f64, per_cent_of_first: Option<f64>) -> String {
        per_cent(Some(Difference { absolute, per_cent: per_cent_of_first }))
    }
}
