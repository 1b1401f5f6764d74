//! `report.html` of a run at rest.

use analysis::{accuracy::Quantity, facts::Facts, results::StaticHeadline};
use ltca::StaticHistory;
use scene::Scene;

use super::{Rendered, RunPage};
use crate::{
    Cost, ReportError,
    charts::{Curve, banded_chart, line_chart},
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

fn charts(scene: &Scene, history: &StaticHistory, facts: &Facts) -> Vec<String> {
    let curves = StaticCurves::new(scene, history);
    let forces = [("x", FORCE_X), ("y", FORCE_Y), ("z", FORCE_Z)]
        .map(|(axis, column)| curves.at(axis, column, At { gear: 1, pair: 0 }));
    let length = [curves.of("under load", LINE_LENGTH), curves.of("unloaded, analytic", GEOMETRIC_LENGTH)];
    let stiffness = [curves.of("secant", SECANT_STIFFNESS), curves.of("tangent", TANGENT_STIFFNESS)];
    // A pair's bending on either gear: the tension below the loaded flank of its teeth.
    let bending = |gear| curves.by_pair(TOOTH_TENSION, gear);
    let angle = "pinion angle [deg]";
    [
        transmission_error(curves.of("STE", STE), angle, facts),
        line_chart("Load sharing", angle, "normal force [N]", &curves.by_pair(PAIR_FORCE, 0), true),
        line_chart("Total contact-line length", angle, "length [mm]", &length, false),
        line_chart("Mesh stiffness", angle, "stiffness [N/um]", &stiffness, false),
        line_chart("Mesh force on the wheel", angle, "force [N]", &forces, true),
        line_chart("Largest principal root stress, pinion", angle, "stress [MPa]", &bending(0), true),
        line_chart("Largest principal root stress, wheel", angle, "stress [MPa]", &bending(1), true),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// STE over the angle; where its bounds are known, in the band of those of its mean.
fn transmission_error(curve: Curve, angle: &str, facts: &Facts) -> Option<String> {
    let (title, ste) = ("Static transmission error", "STE [um]");
    let bounds = facts.accuracy.as_ref().map(|accuracy| &accuracy.bounds[..]).unwrap_or_default();
    match bounds.iter().find(|b| b.quantity == Quantity::MeanSte) {
        Some(mean) => banded_chart(title, angle, ste, curve, "within the bounds of the mean", [mean.below, mean.above]),
        None => line_chart(title, angle, ste, &[curve], false),
    }
}
