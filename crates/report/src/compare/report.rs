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
/// Of these the transmission errors, which are drawn without their mean as well: what a gear excites.
const ERRORS: usize = 3;

/// The quantities that matter, each in a chart; of a sweep all. A quantity without a finite value has none.
pub fn compare_charts(overlays: &[Overlay]) -> Vec<CompareChart> {
    let mut charts = Vec::new();
    for (k, &(name, title, axis)) in SHOWN.iter().enumerate() {
        for overlay in overlays.iter().filter(|o| o.name == name && o.over != SPEED) {
            if k < ERRORS {
                let alone = Overlay { traces: overlay.traces.iter().map(without_mean).collect(), ..overlay.clone() };
                let file = format!("{}_without_mean_um", name.trim_end_matches("_um"));
                charts.extend(chart(&alone, file, &format!("{title} without its mean"), axis));
            }
            charts.extend(chart(overlay, name.to_owned(), title, axis));
        }
    }
    let over_speed = overlays.iter().filter(|o| o.over == SPEED);
    charts.extend(over_speed.filter_map(|o| chart(o, o.name.clone(), &o.name.replace('_', " "), &o.name)));
    charts
}

/// Abscissa of sweeps.
const SPEED: &str = "speed_rpm";

fn chart(overlay: &Overlay, name: String, title: &str, axis: &str) -> Option<CompareChart> {
    let over = match overlay.over {
        "mesh_phase" => "mesh phase",
        "time_s" => "time [s]",
        SPEED => "speed of the driver [1/min]",
        other => other,
    };
    let curve = |t: &Trace| Curve { label: t.label.clone(), points: t.points.clone() };
    let curves: Vec<Curve> = overlay.traces.iter().map(curve).collect();
    let figure = line_chart(title, over, axis, &curves, false)?;
    let svg = line_picture(title, over, axis, &curves)?;
    Some(CompareChart { name, figure, svg })
}

/// A curve about its own mean over the points that are drawn.
fn without_mean(trace: &Trace) -> Trace {
    let finite = || trace.points.iter().map(|p| p.1).filter(|v| v.is_finite());
    let mean = finite().sum::<f64>() / finite().count().max(1) as f64;
    let points = trace.points.iter().map(|&(x, value)| (x, value - mean)).collect();
    Trace { label: trace.label.clone(), points }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn overlay(name: &str, over: &'static str) -> Overlay {
        let trace =
            |label: &str, by: f64| Trace { label: label.into(), points: vec![(0.0, 1.0 + by), (0.5, 3.0 + by)] };
        Overlay { name: name.into(), over, traces: vec![trace("a", 0.0), trace("b", 10.0)] }
    }

    /// Two loads with the same variation lie on each other, whatever their means.
    #[test]
    fn errors_are_drawn_without_their_mean_first() {
        let charts = compare_charts(&[overlay("iterations", "mesh_phase"), overlay("ste_um", "mesh_phase")]);
        let names: Vec<&str> = charts.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["ste_without_mean_um", "ste_um"], "what does not matter is not drawn");
        assert!(charts[0].figure.contains("[[0,0.5],[-1,1],[-1,1]]"), "{}", charts[0].figure);
        assert!(charts[0].figure.contains("Static transmission error without its mean"), "in words");
    }

    #[test]
    fn a_sweep_shows_all_its_columns() {
        let charts = compare_charts(&[overlay("rms_dte_um", "speed_rpm")]);
        assert_eq!((charts.len(), charts[0].name.as_str()), (1, "rms_dte_um"));
    }
}
