//! A gear on rollers that press its bore, from its document on.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::path::{Path, PathBuf};

use analysis::{AnalysisError, Context, NoObserver, gearbox::GearboxResult};
use gearbox::rolling_bearing::ElementLoad;
use scene::gearbox::Gearbox;

/// Shipped.
fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/idler_on_rollers.toml")
}

/// The shipped idler on rollers, with another line for what they press and another way to hold its bore.
fn text(key: &str, coupling: &str) -> String {
    let text = std::fs::read_to_string(file()).unwrap();
    let own = "in_bore_of = \"idler\"                # the bore is the outer race\n";
    let bore = "bore.coupling = \"distributing\"";
    assert!(text.contains(own) && text.contains(bore), "{text}");
    text.replace(own, key).replace(bore, &format!("bore.coupling = \"{coupling}\""))
}

fn solve(key: &str, coupling: &str) -> Result<GearboxResult, AnalysisError> {
    let file = Gearbox::parse(&text(key, coupling), &file()).unwrap_or_else(|e| panic!("{e}"));
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

/// In vibration and in motion rings are rigid: the gear swings on the springs of its rollers.
#[test]
fn a_gear_on_rollers_swings_and_moves() {
    let more = "[vibration]\nfrom_rpm = 500.0\nto_rpm = 1000.0\nspeeds = 2\n[motion]\nspeed_rpm = 1000.0\ncycles = 1\n\
                steps_per_cycle = 20\nmesh = \"spring\"\n";
    let text = text("in_bore_of = \"idler\"\n", "distributing") + more;
    let asked = Gearbox::parse(&text, &file()).unwrap_or_else(|e| panic!("{e}"));
    let found = analysis::solve(&asked, Context::new(&mut NoObserver)).and_then(|own| own.finished());
    let found = found.unwrap_or_else(|e| panic!("{e}"));
    let lowest = found.vibration.as_ref().unwrap().modes[0].modes[0].frequency;
    assert!(lowest > 0.0 && found.motion.is_some(), "{lowest} rad/s");
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
    let springs =
        ["shaft = \"idler\"\nposition_mm = 80.0", "shaft = \"idler\"\nin_bore_of = \"idler\"\nposition_mm = 80.0"];
    assert!(refused("", springs).contains("`in_bore_of` is of a rolling bearing"));
}
