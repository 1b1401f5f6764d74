//! The part of `report.html` about a gearbox that swings.

use analysis::{gearbox_at_rest::GearboxSwings, motion::RPM};
use minijinja::{Value, context, value::Serde};
use scene::gearbox::{Gearbox, GearboxVibration};
use serde_json::json;

use super::swing_words::{Peak, bearing_peaks, first_modes, holders, mesh_peaks};
use crate::charts::{Curve, campbell_chart, line_chart};

/// Orders that are drawn as lines of a Campbell diagram at the most.
const DRAWN: usize = 8;

/// What the template fills in: modes, charts, largest forces.
pub(super) fn vibration(file: &Gearbox, asked: &GearboxVibration, swings: &GearboxSwings) -> Value {
    let charts = [campbell(swings), meshes(file, swings), bearings(file, swings)];
    let charts: Vec<String> = charts.into_iter().flatten().collect();
    let modes = first_modes(swings).iter().enumerate().map(|(i, mode)| {
        json!({
            "number": i + 1,
            "frequency_hz": mode.frequency / std::f64::consts::TAU,
            "strain": holders(file, &mode.energy.strain),
            "kinetic": holders(file, &mode.energy.kinetic),
        })
    });
    let row = |peak: Peak| json!({ "name": peak.name, "force": peak.force_n, "at_rpm": peak.input_rpm });
    let meshes = mesh_peaks(file, swings).into_iter().zip(&swings.mesh_stiffness).map(|(peak, stiffness)| {
        let mut own = row(peak);
        own["stiffness"] = json!(1e-3 * stiffness);
        own
    });
    let bearings = bearing_peaks(file, swings).into_iter().map(row);
    context! {
        input_rpm => swings.campbell.speeds.first().map(|s| 60.0 * s),
        damping_ratio => asked.damping_ratio,
        charts => charts,
        modes => Serde(modes.collect::<serde_json::Value>()),
        meshes => Serde(meshes.collect::<serde_json::Value>()),
        bearings => Serde(bearings.collect::<serde_json::Value>()),
    }
}

/// Natural frequencies over speed with the lowest orders of every mesh.
fn campbell(swings: &GearboxSwings) -> Option<String> {
    let mut diagram = swings.campbell.clone();
    let first = swings.lines.iter().enumerate().filter(|(_, l)| l.name.ends_with("_order_1"));
    let rest =
        swings.lines.iter().enumerate().filter(|(_, l)| !l.name.ends_with("_order_1") && l.name.contains("order"));
    let (numbers, names): (Vec<usize>, Vec<String>) =
        first.chain(rest).take(DRAWN).map(|(i, l)| (i, l.name.replace('_', " "))).unzip();
    diagram.orders = numbers.iter().map(|i| swings.campbell.orders[*i]).collect();
    let modes: Vec<String> = (1..=diagram.frequencies.len()).map(|m| format!("natural mode {m}")).collect();
    campbell_chart(&diagram, &names, &modes)
}

/// A root mean square over the speed of the input.
fn over_speed(swings: &GearboxSwings, label: &str, of: impl Fn(usize) -> f64) -> Curve {
    let points = swings.speeds.iter().enumerate().map(|(s, speed)| (speed / RPM, of(s)));
    Curve { label: label.to_owned(), points: points.collect() }
}

const SPEED: &str = "speed of the input [1/min]";

fn meshes(file: &Gearbox, swings: &GearboxSwings) -> Option<String> {
    let of = |(i, mesh): (usize, &scene::gearbox::GearboxMesh)| {
        over_speed(swings, &mesh.name, |s| swings.rms[s].mesh_forces[i])
    };
    let curves: Vec<Curve> = file.meshes.iter().enumerate().map(of).collect();
    line_chart("Dynamic normal force of the meshes", SPEED, "root mean square [N]", &curves, true)
}

fn bearings(file: &Gearbox, swings: &GearboxSwings) -> Option<String> {
    let of = |(i, bearing): (usize, &scene::gearbox::GearboxBearing)| {
        over_speed(swings, &bearing.name, |s| swings.rms[s].bearing_forces[i])
    };
    let curves: Vec<Curve> = file.bearings.iter().enumerate().map(of).collect();
    line_chart("Forces of the bearings on the housing", SPEED, "root mean square [N]", &curves, true)
}
