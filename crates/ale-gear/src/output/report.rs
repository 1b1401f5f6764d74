//! `report.html`: one page that needs nothing beside itself.

use std::f64::consts::PI;

use ltca::{StaticHistory, StaticPosition};

use report::{
    charts::{Curve, line_chart},
    page::Rendered,
    results::{MAX_PRINCIPAL, pairs},
    view::View,
};

use super::{Headline, page::Page};
use crate::{
    error::CommandError,
    facts::{Cost, Facts},
    scene::Scene,
};

/// The report as HTML with all that it shows inside; `pattern` is the contact pattern as a part of the page, `view` the gears in space, where
/// there are such.
///
/// # Errors
/// Exit status 1 if the template cannot be filled; that would be a fault of this program.
pub fn write_report(
    scene: &Scene,
    history: &StaticHistory,
    facts: &Facts,
    cost: &Cost,
    headline: &Headline,
    pattern: Option<&str>,
    view: Option<&View>,
) -> Result<Rendered, CommandError> {
    let page = Page {
        scene,
        facts,
        cost,
        headline,
        charts: charts(scene, history),
        pattern,
        view,
        warnings: &history.warnings,
    };
    page.render("report.html")
}

fn charts(scene: &Scene, history: &StaticHistory) -> Vec<String> {
    let curve = |label: &str, f: &dyn Fn(&StaticPosition) -> f64| Curve {
        label: label.to_owned(),
        points: history.positions.iter().map(|p| (p.pinion_angle.to_degrees(), f(p))).collect(),
    };
    let pitch = 2.0 * PI / f64::from(scene.pinion.teeth);
    let sharing: Vec<Curve> = pairs::columns(history, pitch)
        .into_iter()
        .map(|k| curve(&format!("pair {k}"), &|p| pairs::force(p, k, pitch)))
        .collect();
    let forces: Vec<Curve> =
        ["x", "y", "z"].iter().enumerate().map(|(k, axis)| curve(axis, &|p| p.wrench[1].force[k])).collect();
    let length =
        [curve("under load", &|p| p.contact_line_length), curve("unloaded, analytic", &|p| p.geometric_line_length)];
    let stiffness =
        [curve("secant", &|p| p.secant_stiffness * 1e-3), curve("tangent", &|p| p.tangent_stiffness * 1e-3)];
    // A pair's bending on either gear: the tension below the loaded flank of its teeth.
    let bending = |gear: usize| -> Vec<Curve> {
        let asked = if scene.output.root_stress { pairs::columns(history, pitch) } else { Vec::new() };
        asked
            .into_iter()
            .map(|k| {
                curve(&format!("pair {k}"), &|p| {
                    pairs::teeth(p, k, pitch)
                        .map_or(f64::NAN, |teeth| MAX_PRINCIPAL.stress(&p.root_stress[gear], Some(teeth[gear])))
                })
            })
            .collect()
    };
    let angle = "pinion angle [deg]";
    let ste = [curve("STE", &|p| p.transmission_error * 1e3)];
    [
        line_chart("Static transmission error", angle, "STE [um]", &ste, false),
        line_chart("Load sharing", angle, "normal force [N]", &sharing, true),
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
