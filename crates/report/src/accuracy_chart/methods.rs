//! Error of the methods of integration against what they cost: chart and table.

use std::fmt::Write;

use analysis::motion::{MotionPrecision, MotionPrecisionPoint};
use answer::Table;
use serde_json::json;

use super::{Chart, ChartHeadline};
use crate::charts::{Captions, Labelled, log_panels};

/// Errors below this are drawn on the axis, um: what contact itself is known to is no more.
const LEAST_UM: f64 = 1e-6;
/// Errors above this are of methods that do not hold, um.
const MOST_UM: f64 = 100.0;

/// The chart as SVG: errors against steps and against wall time.
fn motion_precision_svg(title: &str, of: &MotionPrecision) -> Result<String, String> {
    let methods = of.methods();
    let curves = |x: fn(&MotionPrecisionPoint) -> f64, labelled: bool| -> Vec<Vec<Labelled>> {
        let of_method = |method: &&str| {
            let points = of.points.iter().filter(|p| p.method == *method);
            let stands = points.filter_map(|p| Some((p, p.error_um.filter(|e| *e < MOST_UM)?)));
            let at = |p: &MotionPrecisionPoint, error: f64| Labelled {
                at: (x(p), error.max(LEAST_UM)),
                label: labelled.then(|| p.steps.to_string()),
                bound: None,
            };
            stands.map(|(p, error)| at(p, error)).collect()
        };
        methods.iter().map(of_method).collect()
    };
    let captions = |title, x| Captions { title, x, y: "largest error of DTE [um]" };
    let by_time = captions("Error against time (steps a mesh cycle)", "wall time of a mesh cycle [s]");
    let panels = [
        (captions("Error against step", "steps a mesh cycle"), curves(|p| f64::from(p.steps), false)),
        (by_time, curves(|p| p.cycle_s, true)),
    ];
    log_panels(title, &methods, &panels)
}

/// Every point; a method that does not come through has its reason in `note`.
pub(super) fn rows(of: &MotionPrecision) -> Table {
    let points = &of.points;
    Table::new("motion_precision")
        .texts("method", "method of integration", points.iter().map(|p| p.method))
        .numbers("steps_per_mesh_cycle", "steps per mesh cycle", points.iter().map(|p| f64::from(p.steps)))
        .numbers(
            "error_dte_um",
            "largest difference of the DTE from the reference",
            points.iter().map(|p| p.error_um.unwrap_or(f64::NAN)),
        )
        .numbers("cycle_s", "wall time of a mesh cycle", points.iter().map(|p| p.cycle_s))
        .texts("note", "reason why the method has no result", points.iter().map(|p| p.note.clone()))
}

/// Errors and wall times as Markdown, a line a method.
fn motion_precision_table(of: &MotionPrecision, command: &str) -> String {
    let MotionPrecision { mesh_over_resonance, reference, cycles, .. } = of;
    let mut t = format!(
        "Made by `{command}`. f_m / f_0 = {mesh_over_resonance:.2}; {cycles} mesh cycles from the quasi-static start; reference: {reference}. Largest error of the DTE, um, and wall \
         time of a mesh cycle, ms.\n\n| method |"
    );
    let counts = of.counts();
    for n in &counts {
        let _ = write!(t, " {n} |");
    }
    t.push_str("\n|---|");
    t.push_str(&"---|".repeat(counts.len()));
    for method in of.methods() {
        let points = || of.points.iter().filter(|p| p.method == method);
        let _ = write!(t, "\n| {method}: error |");
        for p in points() {
            let _ = write!(t, " {} |", p.error_um.map_or("fails".into(), |e| format!("{e:.1e}")));
        }
        let _ = write!(t, "\n| {method}: time |");
        for p in points() {
            let time = if p.cycle_s.is_finite() { format!("{:.1}", 1e3 * p.cycle_s) } else { "-".into() };
            let _ = write!(t, " {time} |");
        }
    }
    t.push('\n');
    t
}

/// Every method of integration of a scene: error against step and wall time.
pub fn methods_chart(name: &str, found: &MotionPrecision, command: &str) -> Chart {
    let known = found.points.iter().filter(|p| p.error_um.is_some()).count();
    Chart {
        subtitle: "methods of integration, accuracy against cost".to_owned(),
        tables: vec![rows(found)],
        headline: json!(ChartHeadline {
            points: known,
            points_not_run: found.points.len() - known,
            mesh_over_resonance: Some(found.mesh_over_resonance),
            ..ChartHeadline::default()
        }),
        pictures: vec![("motion_precision", motion_precision_svg(name, found))],
        markdown: motion_precision_table(found, command),
        command: command.to_owned(),
    }
}
