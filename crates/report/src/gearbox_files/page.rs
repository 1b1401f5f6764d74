//! `report.html` of a gearbox: in space, tables by stage, charts.

use std::borrow::Cow;

use analysis::gearbox_at_rest::GearboxResult;
use gearbox::{GearboxPosition, ShaftLine, line_load};
use minijinja::{context, value::Serde};
use scene::gearbox::Gearbox;
use serde_json::json;

use super::{motion_page::motion, space::BoxInSpace, summary, vibration_page::vibration};
use crate::{
    Cost, ReportError,
    charts::{Curve, embedded, line_chart},
    page::Rendered,
};

/// The page; `failed` says why the result does not hold, where it does not.
///
/// # Errors
/// [`ReportError::Page`] if it cannot be filled; that would be a fault of this program.
pub(super) fn gearbox_page(
    file: &Gearbox,
    result: &GearboxResult,
    cost: &Cost,
    failed: Option<&str>,
) -> Result<Rendered, ReportError> {
    let strongest = result.positions.iter().flat_map(|p| &p.bearings).map(|b| norm(b.force)).fold(0.0, f64::max);
    Rendered::new(
        "gearbox.html",
        context! {
            name => &file.name,
            version => env!("CARGO_PKG_VERSION"),
            file => file.file.display().to_string(),
            set => &file.set,
            failed => failed,
            warnings => &result.warnings,
            view => embedded("gearbox", &BoxInSpace::new(file, result)),
            strongest => format!("{strongest:.0} N"),
            positions => result.positions.len(),
            meshes => Serde(meshes(file, result)),
            shafts => Serde(shafts(file, result)),
            bearings => Serde(bearings(file, result)),
            rolls => result.bearings.iter().any(|b| b.rolling.is_some()),
            charts => charts(file, result),
            vibration => file.vibration.as_ref().zip(result.vibration.as_ref()).map(|(v, s)| vibration(file, v, s)),
            motion => result.motion.as_ref().map(|own| motion(file, result, own)),
            certificate => result.certificate,
            cost => Serde(serde_json::to_value(cost).unwrap_or_default()),
        },
    )
}

pub(super) fn norm(force: [f64; 3]) -> f64 {
    force[0].hypot(force[1]).hypot(force[2])
}

fn meshes(file: &Gearbox, result: &GearboxResult) -> serde_json::Value {
    let one = |(i, m): (usize, &analysis::gearbox_at_rest::MeshResult)| {
        let shaft = |gear: usize| &file.shafts[file.gears[gear].shaft].name;
        let pair = &result.pairs[i];
        let mut row = summary::mesh(m, pair);
        row["shafts"] = json!(file.meshes[i].gears.map(shaft));
        row["teeth"] = json!([pair.pinion.teeth(), pair.wheel.teeth()]);
        row
    };
    result.meshes.iter().enumerate().map(one).collect()
}

fn shafts(file: &Gearbox, result: &GearboxResult) -> serde_json::Value {
    let one = |(i, s): (usize, &scene::gearbox::GearboxShaft)| {
        let lines = || result.positions.iter().map(move |p| &p.shafts[i]);
        let nodes = || lines().flat_map(|line| &line.displacements);
        let bending = nodes().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
        json!({
            "name": s.name,
            "ratio": result.ratios[i],
            "bending_um": 1e3 * bending,
            "twist_urad": 1e6 * lines().map(twist).fold(0.0, f64::max),
        })
    };
    file.shafts.iter().enumerate().map(one).collect()
}

/// Turn about its axis of one end of a shaft against the other, at most over all nodes, rad.
fn twist(line: &ShaftLine) -> f64 {
    let turns = || line.displacements.iter().map(|u| u[5]);
    turns().fold(f64::NEG_INFINITY, f64::max) - turns().fold(f64::INFINITY, f64::min)
}

fn bearings(file: &Gearbox, result: &GearboxResult) -> serde_json::Value {
    let one = |(i, b): (usize, &analysis::gearbox_at_rest::BearingLoad)| {
        json!({
            "name": b.name,
            "shaft": file.shafts[file.bearings[i].shaft].name,
            "force_n": b.force,
            "radial_n": b.force[0].hypot(b.force[1]),
            "tilt_mrad": 1e3 * b.tilt,
            "rolling": b.rolling.as_ref().map(super::summary::rolling),
        })
    };
    result.bearings.iter().enumerate().map(one).collect()
}

/// Transmission errors, bearing forces and lags over the input's angle, line loads over the width, lines of shafts.
fn charts(file: &Gearbox, result: &GearboxResult) -> Vec<String> {
    let over = |label: &str, of: &dyn Fn(&GearboxPosition) -> f64| Curve {
        label: label.to_owned(),
        points: result.positions.iter().map(|p| (p.input_angle.to_degrees(), of(p))).collect(),
    };
    let angle = "angle of the input [deg]";
    let ste = (result.meshes.iter().enumerate())
        .map(|(i, m)| over(&m.name, &|p| 1e3 * (p.meshes[i].transmission_error - m.transmission_error[0])));
    let forces = (result.bearings.iter().enumerate()).map(|(i, b)| over(&b.name, &|p| norm(p.bearings[i].force)));
    let lags = (result.outputs.iter().enumerate())
        .map(|(i, o)| over(&output(file, i), &|p| 1e6 * (p.output_lags[i] - o.mean)));
    let loads = (result.meshes.iter().enumerate())
        .map(|(i, m)| Curve { label: m.name.clone(), points: line_load(&result.positions, i) });
    let lines = (file.shafts.iter().enumerate()).map(|(i, s)| Curve { label: s.name.clone(), points: bent(result, i) });
    let all = [
        (
            "Transmission error of each mesh less its mean",
            angle,
            "STE less its mean [um]",
            ste.collect::<Vec<_>>(),
            false,
        ),
        ("From input to output", angle, "lag less its mean [urad]", lags.collect(), false),
        ("Line load over the width", "height on gear 1 [mm]", "largest line load [N/mm]", loads.collect(), true),
        ("Bearings", angle, "force [N]", forces.collect(), true),
        ("Bending of the shafts, first position", "along the shaft [mm]", "off its axis [um]", lines.collect(), true),
    ];
    all.into_iter().filter_map(|(title, x, y, curves, zero)| line_chart(title, x, y, &curves, zero)).collect()
}

fn output<'a>(file: &'a Gearbox, i: usize) -> Cow<'a, str> {
    let shaft = &file.shafts[file.torques[i].shaft].name;
    if file.torques.len() == 1 { Cow::Borrowed(shaft) } else { format!("{}: {shaft}", i + 1).into() }
}

fn bent(result: &GearboxResult, shaft: usize) -> Vec<(f64, f64)> {
    let Some(first) = result.positions.first() else { return Vec::new() };
    let line = &first.shafts[shaft];
    line.positions.iter().zip(&line.displacements).map(|(z, u)| (*z, 1e3 * u[0].hypot(u[1]))).collect()
}
