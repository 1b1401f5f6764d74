//! A gear on rollers that press its bore, from its document on.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::path::Path;

use analysis::{AnalysisError, Context, NoObserver, gearbox::GearboxResult};
use gearbox::rolling_bearing::ElementLoad;
use scene::gearbox::Gearbox;

/// The idler of the scenes, on one bearing of rollers of 7 mm in a bore of 70 mm, beside one that holds it along its axis.
fn text(key: &str, coupling: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/idler.toml");
    let mut text = std::fs::read_to_string(file).unwrap();
    let rollers = format!(
        "{key}position_mm = 45.0\ntype = \"cylindrical-roller\"\nelements = 16\nelement_diameter_mm = 7.0\n\
         element_length_mm = 16.0\npitch_diameter_mm = 63.0\nradial_clearance_um = 10.0"
    );
    let bore = format!("bore.coupling = \"{coupling}\"\nmesher.order = 1\nmesher.elements_face = 4\n");
    for (old, new) in [
        ("position_mm = 10.0\nstiffness_n_per_mm = [5.0e5, 5.0e5, 1.5e5]", rollers.as_str()),
        ("stiffness_n_per_mm = [5.0e5, 5.0e5, 0.0]", "stiffness_n_per_mm = [0.0, 0.0, 1.5e5]"),
        ("root_stress = true", "root_stress = false"),
        ("bore_diameter_mm = 50.0", "bore_diameter_mm = 70.0"),
        ("teeth = 31\n", &format!("teeth = 31\n{bore}")),
    ] {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    text
}

fn solve(key: &str, coupling: &str) -> Result<GearboxResult, AnalysisError> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/idler.toml");
    let file = Gearbox::parse(&text(key, coupling), &file).unwrap_or_else(|e| panic!("{e}"));
    Ok(analysis::solve(&file, Context::new(&mut NoObserver))?.finished().unwrap_or_else(|e| panic!("{e}")))
}

/// In an elastic bore no fewer rollers carry than between rigid rings, and the most loaded one carries less; the zone in the
/// results is that of the bore. Another bore than one held by its means is refused with what cures it.
#[test]
fn a_document_puts_a_gear_on_rollers_in_its_bore() {
    let [soft, rigid] = ["in_bore_of = \"idler\"\n", ""].map(|key| {
        let found = solve(key, "distributing").unwrap_or_else(|e| panic!("{e}"));
        let own = found.bearings.iter().find(|own| own.name == "idler a").unwrap();
        own.rolling.clone().unwrap()
    });
    let sum =
        |zone: &[ElementLoad], of: fn(f64) -> f64| -> f64 { zone.iter().map(|own| own.force * of(own.angle)).sum() };
    let force = |zone: &[ElementLoad]| sum(zone, f64::cos).hypot(sum(zone, f64::sin));
    let (a, b) = (force(&soft.zone), force(&rigid.zone));
    assert!((a / b - 1.0).abs() < 0.02, "the meshes press with {a} and {b} N");
    let zones = [&soft.zone, &rigid.zone].map(|zone| ElementLoad::zone(zone));
    println!("zones {zones:.2?} rad, {:.0} and {:.0} N", soft.element_force, rigid.element_force);
    assert!(zones[0] >= zones[1], "{zones:?} rad");
    assert!(soft.element_force < 0.9 * rigid.element_force, "{} beside {} N", soft.element_force, rigid.element_force);
    let refused = solve("in_bore_of = \"idler\"\n", "kinematic").unwrap_err();
    let hint = refused.hint().unwrap_or_default();
    assert!(
        refused.to_string().contains("`kinematic`") && hint.contains("coupling = \"distributing\""),
        "{refused}: {hint}"
    );
}

/// What cannot be in a bore is told where it is written.
#[test]
fn bearings_that_are_in_no_bore_are_refused() {
    let file = Path::new("idler.toml");
    let refused = |key: &str, change: [&str; 2]| {
        let text = text(key, "distributing").replace(change[0], change[1]);
        Gearbox::parse(&text, file).unwrap_err().to_string()
    };
    let none = ["", ""];
    assert!(refused("in_bore_of = \"wheel\"\n", none).contains("not on its shaft"));
    assert!(refused("in_bore_of = \"idle\"\n", none).contains("in_bore_of"));
    let balls = ["\"cylindrical-roller\"\nelements", "\"deep-groove-ball\"\nelements"];
    assert!(refused("in_bore_of = \"idler\"\n", balls).contains("has no"));
    let springs = ["name = \"idler b\"\n", "name = \"idler b\"\nin_bore_of = \"idler\"\n"];
    assert!(refused("", springs).contains("`in_bore_of` is of a rolling bearing"));
}
