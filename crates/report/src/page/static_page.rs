//! `report.html` of a run at rest.

use analysis::{accuracy::Quantity, facts::Facts, results::StaticHeadline};
use ltca::StaticHistory;
use scene::Scene;

use super::{Rendered, RunPage};
use crate::{
    Cost, ReportError,
    charts::{LineChart, banded_chart},
    columns::{
        At, StaticCurves,
        static_history::{
            FORCE_X, FORCE_Y, FORCE_Z, GEOMETRIC_LENGTH, LINE_LENGTH, PAIR_FORCE, SECANT_STIFFNESS, STE,
            TANGENT_STIFFNESS, TOOTH_TENSION,
        },
    },
    view::View,
};

/// The report as HTML with all that it shows inside; `pattern` is the contact pattern as a part of the page, `view` the
/// gears in space, where
/// there are such.
///
/// # Errors
/// [`ReportError`] if the template cannot be filled; that would be a fault of this program.
pub fn write_report(
    scene: &Scene,
    history: &StaticHistory,
    facts: &Facts,
    cost: &Cost,
    headline: &StaticHeadline,
    pattern: Option<&str>,
    view: Option<&View>,
) -> Result<Rendered, ReportError> {
    let page = RunPage {
        scene,
        facts,
        cost,
        headline,
        charts: charts(scene, history, facts),
        pattern,
        view,
        warnings: &history.warnings,
    };
    page.render("report.html")
}

const ANGLE: &str = "pinion angle [deg]";

/// What is drawn of positions at rest over the pinion angle: static transmission error and load sharing first.
pub fn static_charts(scene: &Scene, history: &StaticHistory) -> Vec<LineChart> {
    let curves = StaticCurves::new(scene, history);
    let forces = [("x", FORCE_X), ("y", FORCE_Y), ("z", FORCE_Z)]
        .map(|(axis, column)| curves.at(axis, column, At { gear: 1, pair: 0 }));
    let length = [curves.of("under load", LINE_LENGTH), curves.of("unloaded, analytic", GEOMETRIC_LENGTH)];
    let stiffness = [curves.of("secant", SECANT_STIFFNESS), curves.of("tangent", TANGENT_STIFFNESS)];
    // A pair's bending on either gear: the tension below the loaded flank of its teeth.
    let bending = |gear| curves.by_pair(TOOTH_TENSION, gear);
    let chart = |title, y, curves: &[_], from_zero| LineChart::new(title, [ANGLE, y], curves, from_zero);
    [
        chart("Static transmission error", "STE [um]", &[curves.of("STE", STE)], false),
        chart("Load sharing", "normal force [N]", &curves.by_pair(PAIR_FORCE, 0), true),
        chart("Total contact-line length", "length [mm]", &length, false),
        chart("Mesh stiffness", "stiffness [N/um]", &stiffness, false),
        chart("Mesh force on the wheel", "force [N]", &forces, true),
        chart("Largest principal root stress, pinion", "stress [MPa]", &bending(0), true),
        chart("Largest principal root stress, wheel", "stress [MPa]", &bending(1), true),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn charts(scene: &Scene, history: &StaticHistory, facts: &Facts) -> Vec<String> {
    let all = static_charts(scene, history);
    all.iter()
        .enumerate()
        .filter_map(|(k, chart)| if k == 0 { in_its_bounds(chart, facts) } else { chart.figure() })
        .collect()
}

/// The transmission error; where its bounds are known, in the band of those of its mean.
fn in_its_bounds(chart: &LineChart, facts: &Facts) -> Option<String> {
    let bounds = facts.accuracy.as_ref().map(|accuracy| &accuracy.bounds[..]).unwrap_or_default();
    match bounds.iter().find(|b| b.quantity == Quantity::MeanSte) {
        Some(mean) => {
            let (name, [x, y]) = ("within the bounds of the mean", chart.axes);
            banded_chart(chart.title, x, y, chart.curves[0].clone(), name, [mean.below, mean.above])
        }
        None => chart.figure(),
    }
}
