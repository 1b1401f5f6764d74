//! Models over a range of speeds: chart of error against wall time, the curves themselves, CSV and table.

use std::fmt::Write;

use analysis::accuracy_chart::{ResonanceCurve, ResonancePoint, ResonancePrecision};
use plotters::prelude::*;

use super::tables::seconds;
use crate::{
    ReportError, ResultFiles,
    charts::{Captions, Curve, Failure, Labelled, legend, line_picture, log_panel, write_picture},
    csv::always_quoted,
    page::write_chart_page,
};

const SIZE: (u32, u32) = (1040, 490);
const HEAD: u32 = 104;
/// Errors below this are drawn on the axis: the reference is known no better.
const LEAST: f64 = 1e-5;
/// Name of what the others are compared with.
const REFERENCE: &str = "reference";

/// Models in order.
fn models(of: &ResonancePrecision) -> Vec<&'static str> {
    let mut names: Vec<_> = of.points.iter().map(|p| p.model).collect();
    names.dedup();
    names
}

/// The chart as SVG: errors against the wall time of all and of the motions alone.
///
/// # Errors
/// What the drawing library complains of.
pub fn resonance_precision_svg(title: &str, of: &ResonancePrecision) -> Result<String, String> {
    let mut svg = String::new();
    draw(&mut svg, title, of).map_err(|e| e.to_string())?;
    Ok(svg)
}

fn draw(svg: &mut String, title: &str, of: &ResonancePrecision) -> Result<(), Failure> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    let models = models(of);
    legend(&head, title, &models)?;
    let panels = body.split_evenly((1, 2));
    let curves = |time: fn(&ResonanceCurve) -> f64| -> Vec<Vec<Labelled>> {
        let of_model = |model: &&str| {
            let points = of.points.iter().filter(|p| p.model == *model);
            let stands = points.filter_map(|p| {
                let curve = p.outcome.as_ref().ok()?;
                Some((p.steps, time(curve), curve.error?))
            });
            let labelled = stands.filter(|(_, time, _)| *time > 0.0).map(|(steps, time, error)| Labelled {
                at: (time, 100.0 * error.max(LEAST)),
                label: Some(steps.to_string()),
                bound: None,
            });
            labelled.collect()
        };
        models.iter().map(of_model).collect()
    };
    let captions = |title, x| Captions { title, x, y: "error of peak-to-peak DTE [%]" };
    let all = curves(ResonanceCurve::whole_s);
    log_panel(&panels[0], captions("Everything included (steps a mesh cycle)", "wall time [s]"), &all)?;
    let motions = curves(|curve| curve.sweep_s);
    log_panel(&panels[1], captions("Motions alone (steps a mesh cycle)", "wall time [s]"), &motions)?;
    root.present()?;
    Ok(())
}

/// The curves of every model with its shortest steps, and the reference, as SVG.
pub fn resonance_curves_svg(title: &str, of: &ResonancePrecision) -> Option<String> {
    let line = |label: &str, curve: &ResonanceCurve| {
        let known = curve.speeds.iter().filter_map(|p| Some((p.speed_rpm, p.peak_to_peak_um?)));
        Curve { label: label.to_owned(), points: known.collect() }
    };
    let best = |model: &&str| {
        let points = of.points.iter().filter(|p| p.model == *model);
        points.filter_map(|p| Some(line(p.model, p.outcome.as_ref().ok()?))).next_back()
    };
    let curves: Vec<Curve> = models(of).iter().filter_map(best).chain([line(REFERENCE, &of.reference)]).collect();
    line_picture(title, "speed of the driver [1/min]", "peak-to-peak DTE [um]", &curves)
}

/// Every model with every step, then the reference; one that comes to no curve has its reason in `note`.
pub fn resonance_precision_csv(of: &ResonancePrecision) -> String {
    let mut text = "model,steps_per_mesh_cycle,offline_s,sweep_s,error_peak_to_peak_dte,largest_peak_to_peak_dte_um,\
                    largest_at_rpm,speeds_without_motion,note\n"
        .to_owned();
    for p in &of.points {
        text.push_str(&csv_line(p.model, p.steps, p.outcome.as_ref()));
    }
    text + &csv_line(REFERENCE, of.reference_steps, Ok(&of.reference))
}

fn csv_line(model: &str, steps: u32, outcome: Result<&ResonanceCurve, &String>) -> String {
    let model = always_quoted(model);
    match outcome {
        Err(why) => format!("{model},{steps},,,,,,,{}\n", always_quoted(why)),
        Ok(c) => {
            let error = c.error.map_or_else(String::new, |e| e.to_string());
            let largest = c.largest().map_or_else(|| ",".to_owned(), |(p, um)| format!("{um},{}", p.speed_rpm));
            format!("{model},{steps},{},{},{error},{largest},{},\"\"\n", c.offline_s, c.sweep_s, c.missing())
        }
    }
}

/// Motion by motion; a field without a value is empty.
pub fn resonance_curves_csv(of: &ResonancePrecision) -> String {
    let mut text = "model,steps_per_mesh_cycle,way,speed_rpm,peak_to_peak_dte_um\n".to_owned();
    let known = of.points.iter().filter_map(|p| Some((p.model, p.steps, p.outcome.as_ref().ok()?)));
    for (model, steps, curve) in known.chain([(REFERENCE, of.reference_steps, &of.reference)]) {
        for p in &curve.speeds {
            let um = p.peak_to_peak_um.map_or_else(String::new, |x| x.to_string());
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{},{steps},{},{},{um}", always_quoted(model), p.way.word(), p.speed_rpm);
        }
    }
    text
}

/// Errors and wall times as Markdown.
pub fn resonance_precision_table(of: &ResonancePrecision, command: &str) -> String {
    let sweep = &of.sweep;
    let mut t = format!(
        "Made by `{command}`. {} speeds of the driver from {} to {}/min; driver at constant speed, axes held or as stiff as makes no \
         difference. Error: root mean square over all motions of the peak-to-peak DTE minus that of the reference, over that \
         of the reference (reduced+modes, {} steps a mesh cycle, {} s).\n\n\
         | model | steps a mesh cycle | before the first motion, s | all motions, s | error, % | largest, um | at, 1/min |\n\
         |---|---|---|---|---|---|---|\n",
        sweep.speeds,
        sweep.from_rpm,
        sweep.to_rpm,
        of.reference_steps,
        seconds(of.reference.whole_s())
    );
    let reference = ResonancePoint { model: REFERENCE, steps: of.reference_steps, outcome: Ok(of.reference.clone()) };
    for p in of.points.iter().chain([&reference]) {
        // Writing to a String cannot fail.
        let _ = match &p.outcome {
            Err(why) => writeln!(t, "| {} | {} | - | - | - | - | not run: {why} |", p.model, p.steps),
            Ok(c) => {
                let error = c.error.map_or_else(|| "-".to_owned(), |e| format!("{:.2}", 100.0 * e));
                let (um, at) = c.largest().map_or_else(
                    || ("-".to_owned(), "-".to_owned()),
                    |(p, um)| (format!("{um:.3}"), format!("{:.0}", p.speed_rpm)),
                );
                let (before, motions) = (seconds(c.offline_s), seconds(c.sweep_s));
                writeln!(t, "| {} | {} | {before} | {motions} | {error} | {um} | {at} |", p.model, p.steps)
            }
        };
    }
    t
}

/// `resonance_precision.csv`, `.svg` and `.md`, `resonance_curves.csv` and `.svg`; what comes back is the table.
///
/// # Errors
/// When the system refuses, or a picture cannot be drawn.
pub fn write_resonance_precision(
    name: &str,
    found: &ResonancePrecision,
    command: &str,
    results: &dyn ResultFiles,
) -> Result<String, ReportError> {
    let table = resonance_precision_table(found, command);
    results.write("resonance_precision.csv", resonance_precision_csv(found).as_bytes())?;
    results.write("resonance_curves.csv", resonance_curves_csv(found).as_bytes())?;
    let errors = write_picture("resonance_precision", resonance_precision_svg(name, found), results)?;
    let curves = resonance_curves_svg(name, found).ok_or_else(|| "no model has a curve".to_owned());
    let curves = write_picture("resonance_curves", curves, results)?;
    results.write("resonance_precision.md", format!("# {name}\n\n{table}").as_bytes())?;
    write_chart_page(name, &[curves, errors], &table, results)?;
    Ok(table)
}
