//! Models over a range of speeds: chart of error against wall time, the curves themselves, CSV and table.

use std::fmt::Write;

use analysis::accuracy_chart::{ResonanceCurve, ResonancePoint, ResonancePrecision};
use answer::Table;
use serde_json::json;

use super::{Chart, ChartHeadline, tables::seconds};
use crate::charts::{Captions, Curve, Labelled, line_picture, log_panels};

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
fn resonance_precision_svg(title: &str, of: &ResonancePrecision) -> Result<String, String> {
    let models = models(of);
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
    let captions = |title| Captions { title, x: "wall time [s]", y: "error of peak-to-peak DTE [%]" };
    let panels = [
        (captions("Everything included (steps a mesh cycle)"), curves(ResonanceCurve::whole_s)),
        (captions("Motions alone (steps a mesh cycle)"), curves(|curve| curve.sweep_s)),
    ];
    log_panels(title, &models, &panels)
}

/// The curves of every model with its shortest steps, and the reference, as SVG.
fn resonance_curves_svg(title: &str, of: &ResonancePrecision) -> Option<String> {
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
fn precision_rows(of: &ResonancePrecision) -> Table {
    let reference = ResonancePoint { model: REFERENCE, steps: of.reference_steps, outcome: Ok(of.reference.clone()) };
    let points: Vec<&ResonancePoint> = of.points.iter().chain([&reference]).collect();
    let number = |pick: fn(&ResonanceCurve) -> Option<f64>| {
        points.iter().map(move |p| p.outcome.as_ref().ok().and_then(pick).unwrap_or(f64::NAN))
    };
    let notes = points.iter().map(|p| p.outcome.as_ref().err().cloned().unwrap_or_default());
    Table::new("resonance_precision")
        .texts("model", "model of the pair; the last rows are the reference", points.iter().map(|p| p.model))
        .numbers("steps_per_mesh_cycle", "steps per mesh cycle", points.iter().map(|p| f64::from(p.steps)))
        .numbers("offline_s", "wall time of everything before the first motion", number(|c| Some(c.offline_s)))
        .numbers("sweep_s", "wall time of all motions", number(|c| Some(c.sweep_s)))
        .numbers(
            "error_peak_to_peak_dte",
            "root mean square over all motions of the peak-to-peak DTE minus that of the reference, over that of the reference",
            number(|c| c.error),
        )
        .numbers("largest_peak_to_peak_dte_um", "largest peak-to-peak DTE", number(|c| Some(c.largest()?.1)))
        .numbers("largest_at_rpm", "speed of the driver at which it is largest", number(|c| Some(c.largest()?.0.speed_rpm)))
        .numbers("speeds_without_motion", "speeds without a motion", number(|c| Some(c.missing() as f64)))
        .texts("note", "reason why a model has no curve", notes)
}

/// Motion by motion; NaN without a value.
fn curve_rows(of: &ResonancePrecision) -> Table {
    let known = of.points.iter().filter_map(|p| Some((p.model, p.steps, p.outcome.as_ref().ok()?)));
    let all = known.chain([(REFERENCE, of.reference_steps, &of.reference)]);
    let rows: Vec<_> =
        all.flat_map(|(model, steps, curve)| curve.speeds.iter().map(move |p| (model, steps, p))).collect();
    Table::new("resonance_curves")
        .texts("model", "model of the pair; the last rows are the reference", rows.iter().map(|r| r.0))
        .numbers("steps_per_mesh_cycle", "steps per mesh cycle", rows.iter().map(|r| f64::from(r.1)))
        .texts("way", "direction: `up` or `down`", rows.iter().map(|r| r.2.way.word()))
        .numbers("speed_rpm", "speed of the driver", rows.iter().map(|r| r.2.speed_rpm))
        .numbers(
            "peak_to_peak_dte_um",
            "peak to peak of the DTE",
            rows.iter().map(|r| r.2.peak_to_peak_um.unwrap_or(f64::NAN)),
        )
}

/// Tables of a chart over speed.
pub(super) fn documented(of: &ResonancePrecision) -> [Table; 2] {
    [precision_rows(of), curve_rows(of)]
}

/// Errors and wall times as Markdown.
fn resonance_precision_table(of: &ResonancePrecision, command: &str) -> String {
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

/// Every model over the speeds of a scene: error of the resonance curve against wall time.
pub fn resonance_chart(name: &str, found: &ResonancePrecision, command: &str) -> Chart {
    let curves = resonance_curves_svg(name, found).ok_or_else(|| "no model has a curve".to_owned());
    let known = found.points.iter().filter(|p| p.outcome.is_ok()).count();
    Chart {
        subtitle: format!("accuracy against cost over {} speeds", found.sweep.speeds),
        tables: vec![precision_rows(found), curve_rows(found)],
        headline: json!(ChartHeadline {
            points: known,
            points_not_run: found.points.len() - known,
            reference_largest_peak_to_peak_dte_um: found.reference.largest().map(|(_, um)| um),
            ..ChartHeadline::default()
        }),
        pictures: vec![("resonance_curves", curves), ("resonance_precision", resonance_precision_svg(name, found))],
        markdown: resonance_precision_table(found, command),
        command: command.to_owned(),
    }
}
